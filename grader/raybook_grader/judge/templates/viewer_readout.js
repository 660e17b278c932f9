// What is under the cursor: a close look at each picture, and the numbers.
(() => {
  "use strict";
  const ACROSS = 11, SIZE = 6; // pixels across a loupe (odd: one is in the middle), and how large
  const LUMINANCE = [0.2126, 0.7152, 0.0722];
  const HELP = "Point at a picture to read its pixels. Click to keep one, and again to let it go. "
    + "On the keyboard: arrows move it (with Shift by ten), + and \u2212 zoom, 0 shows all.";

  function element(name, text = "", parts = []) {
    const made = document.createElement(name);
    made.textContent = text;
    made.append(...parts);
    return made;
  }

  function row(name, columns) {
    const head = element("th", name), cells = columns.map((text) => element("td", text));
    head.scope = "row";
    return { tr: element("tr", "", [head, ...cells]), head, cells };
  }

  function put(cell, value, text = RBV.figures(value)) {
    cell.textContent = text;
    cell.title = RBV.exact(value);
  }

  RBV.readout = (box, data) => {
    const none = ["", "", "", ""];
    const place = row("", ["red", "green", "blue", "luminance"]);
    const pictures = data.pictures.map((picture) => row(picture.name, none));
    const difference = row("difference", none);
    const maps = data.maps.map((map) => row(map.name, [""]));
    const loupes = [0, 1, 2].map(() => {
      const canvas = document.createElement("canvas");
      canvas.width = canvas.height = ACROSS * SIZE;
      canvas.setAttribute("aria-hidden", "true");
      return canvas;
    });
    const values = element("table", "", [
      element("thead", "", [place.tr]),
      element("tbody", "", [...pictures.map((r) => r.tr), difference.tr]),
    ]);
    const errors = element("table", "", [element("tbody", "", maps.map((r) => r.tr))]);
    const frames = [element("div", "", loupes), element("div", "", [values]), element("div", "", [errors])];
    frames[0].className = "rbv-loupes";
    frames[1].className = frames[2].className = "rbv-values";
    box.replaceChildren(...frames, element("p", HELP));

    function magnify(canvas, image, x, y) {
      const source = document.createElement("canvas"), middle = (ACROSS - 1) / 2;
      source.width = source.height = ACROSS;
      source.getContext("2d").putImageData(image, middle - x, middle - y);
      const pen = canvas.getContext("2d");
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.imageSmoothingEnabled = false;
      pen.drawImage(source, 0, 0, canvas.width, canvas.height);
      pen.strokeStyle = "#fff";
      pen.strokeRect(SIZE * middle - 0.5, SIZE * middle - 0.5, SIZE + 1, SIZE + 1);
    }

    // Shows the pixel, and returns it in a sentence.
    return ([x, y], images) => {
      const at = y * data.width + x;
      place.head.textContent = `x = ${x}, y = ${y}`;
      const full = data.pictures.map(({ values }) => {
        const rgb = [0, 1, 2].map((c) => values[3 * at + c]);
        return [...rgb, Math.fround(rgb.reduce((sum, v, c) => sum + v * LUMINANCE[c], 0))];
      });
      full.forEach((numbers, i) => numbers.forEach((v, c) => put(pictures[i].cells[c], v)));
      difference.cells.forEach((cell, c) => {
        const ratio = full[0][c] > 0 ? 100 * (full[1][c] / full[0][c] - 1) : NaN;
        cell.textContent = Number.isFinite(ratio) ? `${ratio > 0 ? "+" : ""}${ratio.toFixed(1).replace("-", "\u2212")} %` : "\u2013";
      });
      data.maps.forEach((map, i) => {
        const value = map.values[at], sign = map.low < 0 && value > 0 ? "+" : "";
        put(maps[i].cells[0], value, sign + RBV.figures(value, 3) + (map.unit ? " " + map.unit : ""));
      });
      loupes.forEach((canvas, i) => magnify(canvas, images[i], x, y));
      const told = full.map((v, i) => `${data.pictures[i].name} ${v.slice(0, 3).map((x) => RBV.figures(x, 3)).join(", ")}`);
      return `x ${x}, y ${y}: ${told.join("; ")}`;
    };
  };
})();
