// Makes one page ready for paper: stubs open, a table of contents behind the title. Where a name
// is used stays folded: paper has the index.
// `pages` maps the ids of headings to page numbers, once they are known.
(pages) => {
  document.querySelectorAll("details.rb-stub").forEach((part) => { part.open = true; });
  document.querySelector("nav.rb-contents")?.remove();
  const contents = document.createElement("nav");
  contents.className = "rb-contents";
  const title = document.createElement("p");
  title.className = "rb-contents-title";
  title.textContent = "Contents";
  contents.append(title);
  const article = document.querySelector("article");
  // The book's title is the only h1; chapters are h2, their sections h3.
  const headings = article.querySelectorAll(".toctree-wrapper > section > h2, .toctree-wrapper > section > section > h3");
  let number = 0;
  for (const heading of headings) {
    const target = `print-${number += 1}`;
    let place = heading.querySelector(":scope > .rb-print-target");
    if (!place) {
      // An empty element, or the heading itself, may count to the page before.
      place = document.createElement("span");
      place.className = "rb-print-target";
      place.append(...heading.childNodes);
      heading.append(place);
    }
    place.id = target;
    const row = document.createElement("a");
    row.href = `#${target}`;
    row.className = `rb-row rb-${heading.tagName.toLowerCase()}`;
    const words = document.createElement("span");
    words.textContent = heading.textContent.replace("¶", "").trim();
    const page = document.createElement("span");
    page.className = "rb-page";
    page.textContent = pages[target] ?? "0";
    row.append(words, page);
    contents.append(row);
  }
  // Behind what the first page says: the next heading is a chapter's.
  headings[0]?.closest(".toctree-wrapper").before(contents);
}
