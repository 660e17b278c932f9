// Makes one page ready for paper: stubs open, a table of contents behind the title. Where a name
// is used stays folded: paper has the index.
// `pages` maps the ids of all that is linked to, to page numbers, once they are known.
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
  // Who reads on paper cannot follow a link.
  for (const link of article.querySelectorAll("ul.rb-index > li > a:first-child, a.reference.internal:has(> .std-ref, > .std-doc)")) {
    let at = link.nextElementSibling;
    if (!at?.classList.contains("rb-at")) {
      at = document.createElement("span");
      at.className = "rb-at";
      link.after(at);
    }
    // A page of the web begins with an empty mark, which may count to the page before; its heading does not.
    const target = decodeURIComponent(link.hash.slice(1));
    const mark = target.startsWith("document-") && document.getElementById(target);
    const heading = mark && mark.nextElementSibling?.querySelector(".rb-print-target");
    const page = pages[heading ? heading.id : target] ?? "0";
    at.textContent = link.closest("ul.rb-index") ? ` ${page}` : ` (p. ${page})`;
  }
  // Behind what the first page says: the next heading is a chapter's.
  headings[0]?.closest(".toctree-wrapper").before(contents);
}
