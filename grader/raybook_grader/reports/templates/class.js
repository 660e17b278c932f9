// The grid of students and modules: sorted, filtered, and walked with the arrow keys.
document.addEventListener("DOMContentLoaded", () => {
  "use strict";
  const table = document.querySelector("[data-grid]"), body = table.tBodies[0], heads = [...table.tHead.rows[0].cells];
  const find = (selector) => document.querySelector(selector);
  const rows = [...body.rows].map((tr, at) => ({
    tr, at, id: tr.dataset.id, name: tr.dataset.id.toLowerCase(), total: number(tr.dataset.total),
    cells: [...tr.querySelectorAll(".cell")].map((a) => ({ word: a.getAttribute("aria-label").split(",")[0], score: number(a.dataset.score) })),
  }));
  let order = rows;

  // What has no number comes before zero: it is what to look at first.
  function number(text) {
    return text ? Number(text) : -1;
  }

  const collator = new Intl.Collator("en", { numeric: true });
  function compare(key) {
    if (key === "id") return (a, b) => collator.compare(a.id, b.id);
    if (key === "total") return (a, b) => a.total - b.total;
    return (a, b) => a.cells[key].score - b.cells[key].score || (a.cells[key].word < b.cells[key].word ? -1 : 1);
  }

  function sortBy(head, key) {
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const by = compare(key);
    order = [...rows].sort((a, b) => (down ? by(b, a) : by(a, b)) || a.at - b.at);
    body.replaceChildren(...order.map((row) => row.tr));
    home();
  }

  function filter() {
    const text = find("[data-search]").value.trim().toLowerCase();
    const word = find("[data-verdict]").value, module = find("[data-module]").value;
    let shown = 0;
    for (const row of rows) {
      const cells = module === "" ? row.cells : [row.cells[module]];
      const fits = row.name.includes(text) && (word === "" || cells.some((cell) => cell.word === word));
      row.tr.hidden = !fits;
      shown += fits;
    }
    find("[data-shown]").textContent = `${shown} of ${rows.length} shown`;
    home();
  }

  // One stop of the Tab key for the whole grid; from there the arrow keys go on.
  const linksOf = (row) => [...row.tr.querySelectorAll("a")];
  let current = null;
  function stop(link) {
    if (current) current.tabIndex = -1;
    current = link;
    if (current) current.tabIndex = 0;
  }
  function home() {
    const first = order.find((row) => !row.tr.hidden);
    stop(first ? linksOf(first)[0] : null);
  }
  body.addEventListener("focusin", (event) => { if (event.target.matches("a")) stop(event.target); });
  body.addEventListener("keydown", (event) => {
    if (!event.target.matches("a") || event.altKey || event.metaKey) return;
    const seen = order.filter((row) => !row.tr.hidden), y = seen.findIndex((row) => row.tr.contains(event.target));
    const links = linksOf(seen[y]), x = links.indexOf(event.target), last = links.length - 1, end = seen.length - 1;
    const to = {
      ArrowLeft: [x - 1, y], ArrowRight: [x + 1, y], ArrowUp: [x, y - 1], ArrowDown: [x, y + 1],
      Home: [0, event.ctrlKey ? 0 : y], End: [last, event.ctrlKey ? end : y], PageUp: [x, y - 15], PageDown: [x, y + 15],
    }[event.key];
    if (!to) return;
    event.preventDefault();
    const within = (value, most) => Math.min(Math.max(value, 0), most);
    const link = linksOf(seen[within(to[1], end)])[within(to[0], last)];
    link.focus();
    link.scrollIntoView({ block: "nearest", inline: "nearest" });
  });

  table.setAttribute("role", "grid");
  body.querySelectorAll("a").forEach((link) => { link.tabIndex = -1; });
  heads.forEach((head) => {
    const label = head.querySelector("[data-sort]"), button = document.createElement("button");
    button.type = "button";
    button.append(...label.childNodes);
    button.addEventListener("click", () => sortBy(head, label.dataset.sort));
    label.replaceWith(button);
  });
  const form = find("[data-filters]");
  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("reset", () => setTimeout(filter));
  form.hidden = find("[data-help]").hidden = false;
  filter();
});
