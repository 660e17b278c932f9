(() => {
  "use strict";
  const LOUPE = 11; // pixels across; odd, so that one is in the middle
  const LUMINANCE = [0.2126, 0.7152, 0.0722];

  function bytes(text) {
    return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  }

  // IEEE 754 binary16
  function half(bits) {
    const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    if (exponent === 31) return mantissa ? NaN : sign * Infinity;
    if (exponent === 0) return sign * mantissa * 2 ** -24;
    return sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
  }

  function numbers(item) {
    const buffer = bytes(item.data).buffer;
    if (item.format === "f4") return new Float32Array(buffer);
    return Float32Array.from(new Uint16Array(buffer), half);
  }

  function srgb(x) {
    if (!(x > 0)) return 0;
    if (x >= 1) return 255;
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
  }

  function paintPicture(image, values, gain) {
    const out = image.data;
    for (let i = 0, j = 0; i < values.length; i += 3, j += 4) {
      const r = values[i], g = values[i + 1], b = values[i + 2];
      const valid = Number.isFinite(r + g + b);
      out[j] = valid ? srgb(r * gain) : 255;
      out[j + 1] = valid ? srgb(g * gain) : 0;
      out[j + 2] = valid ? srgb(b * gain) : 255;
      out[j + 3] = 255;
    }
  }

  function paintMap(image, map) {
    const steps = map.colours.map((c) => [0, 2, 4].map((i) => parseInt(c.slice(i, i + 2), 16)));
    for (let i = 0; i < map.values.length; i++) {
      const share = (map.values[i] - map.low) / (map.high - map.low);
      const place = Math.min(Math.max(share || 0, 0), 1) * (steps.length - 1);
      const k = Math.min(Math.floor(place), steps.length - 2), f = place - k;
      for (let c = 0; c < 3; c++) {
        image.data[4 * i + c] = steps[k][c] + (steps[k + 1][c] - steps[k][c]) * f;
      }
      image.data[4 * i + 3] = 255;
    }
  }

  function figures(x) {
    if (!Number.isFinite(x)) return String(x);
    const size = Math.abs(x);
    return size !== 0 && (size < 1e-3 || size >= 1e4) ? x.toExponential(2) : x.toPrecision(3);
  }

  function canvasIn(frame, width, height, label) {
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    frame.replaceChildren(canvas);
    return canvas;
  }

  function mount(root) {
    root.dataset.on = "1";
    const data = JSON.parse(root.querySelector("[data-numbers]").textContent);
    const { width, height } = data;
    const find = (selector) => root.querySelector(selector);
    const all = (selector) => [...root.querySelectorAll(selector)];
    const state = { exposure: 0, layout: "side", map: 0, seam: 0.5, pixel: null };
    for (const item of [...data.pictures, ...data.maps]) item.values = numbers(item);

    const images = [...data.pictures, ...data.maps].map(() => new ImageData(width, height));
    const [reference, test] = data.pictures;
    const frames = [0, 1].map((i) => find(`[data-pane="${i}"] .rbv-frame`));
    const mapFrames = data.maps.map((_, i) => find(`[data-error="${i}"] .rbv-frame`));
    const names = [...data.pictures, ...data.maps].map((item) => item.name);
    const canvases = [...frames, ...mapFrames].map((f, i) => canvasIn(f, width, height, names[i]));
    const splitFrame = find('[data-pane="split"] .rbv-frame');
    const split = canvasIn(splitFrame, width, height, names[0] + " and " + names[1]);
    const seam = document.createElement("div");
    seam.className = "rbv-seam";
    splitFrame.append(seam);
    data.maps.forEach((map, i) => {
      paintMap(images[2 + i], map);
      canvases[2 + i].getContext("2d").putImageData(images[2 + i], 0, 0);
    });

    function drawPictures() {
      const gain = 2 ** state.exposure / data.white;
      data.pictures.forEach((picture, i) => {
        paintPicture(images[i], picture.values, gain);
        canvases[i].getContext("2d").putImageData(images[i], 0, 0);
      });
      drawSplit();
      drawReadout();
    }

    function drawSplit() {
      const column = Math.round(state.seam * width), pen = split.getContext("2d");
      pen.drawImage(canvases[0], 0, 0);
      pen.drawImage(canvases[1], column, 0, width - column, height, column, 0, width - column, height);
      seam.style.left = (100 * column) / width + "%";
    }

    function show() {
      const divided = state.layout === "split";
      all("[data-layout]").forEach((b) => b.setAttribute("aria-pressed", b.dataset.layout === state.layout));
      all("[data-map]").forEach((b) => b.setAttribute("aria-pressed", Number(b.dataset.map) === state.map));
      all("[data-error]").forEach((pane) => { pane.hidden = Number(pane.dataset.error) !== state.map; });
      all('[data-pane="0"], [data-pane="1"]').forEach((pane) => { pane.hidden = divided; });
      find('[data-pane="split"]').hidden = !divided;
      find(".rbv-panes").classList.toggle("rbv-two", divided);
    }

    function row(name, cells) {
      const tr = document.createElement("tr"), head = document.createElement("th");
      head.scope = "row";
      head.textContent = name;
      tr.append(head, ...cells.map((text) => Object.assign(document.createElement("td"), { textContent: text })));
      return tr;
    }

    function loupe(image, x, y) {
      const canvas = document.createElement("canvas"), pen = canvas.getContext("2d");
      canvas.width = canvas.height = 7 * LOUPE;
      const source = document.createElement("canvas");
      source.width = source.height = LOUPE;
      const middle = (LOUPE - 1) / 2;
      source.getContext("2d").putImageData(image, middle - x, middle - y);
      pen.imageSmoothingEnabled = false;
      pen.drawImage(source, 0, 0, 7 * LOUPE, 7 * LOUPE);
      pen.strokeStyle = "#fff";
      pen.strokeRect(7 * middle - 0.5, 7 * middle - 0.5, 8, 8);
      return canvas;
    }

    function drawReadout() {
      const box = find("[data-readout]");
      const [x, y] = state.pixel, at = y * width + x;
      const rgb = (picture) => [0, 1, 2].map((c) => picture.values[3 * at + c]);
      const full = (v) => [...v, v[0] * LUMINANCE[0] + v[1] * LUMINANCE[1] + v[2] * LUMINANCE[2]];
      const a = full(rgb(reference)), b = full(rgb(test));
      const ratio = a.map((v, i) => (v > 0 ? 100 * (b[i] / v - 1) : NaN));
      const table = document.createElement("table");
      const heads = document.createElement("thead");
      heads.append(row(`x = ${x}, y = ${y}`, ["red", "green", "blue", "luminance"]));
      heads.querySelectorAll("td").forEach((cell) => { cell.style.color = "var(--rbv-soft)"; });
      const body = document.createElement("tbody");
      body.append(row(names[0], a.map(figures)), row(names[1], b.map(figures)));
      body.append(row("difference", ratio.map((v) => (Number.isFinite(v) ? `${v > 0 ? "+" : ""}${v.toFixed(1)} %` : "\u2013"))));
      table.append(heads, body);
      const errors = document.createElement("table");
      errors.append(...data.maps.map((m) => row(m.name, [(m.low < 0 && m.values[at] > 0 ? "+" : "") + figures(m.values[at]) + (m.unit ? " " + m.unit : "")])));
      const loupes = document.createElement("div");
      loupes.className = "rbv-loupes";
      loupes.append(...[0, 1, 2 + state.map].map((i) => loupe(images[i], x, y)));
      const help = Object.assign(document.createElement("p"), {
        textContent: "Point at a picture to read its pixels. Click to keep one, and again to let it go; arrow keys move it.",
      });
      box.replaceChildren(loupes, table, errors, help);
    }

    function mark() {
      all(".rbv-cross").forEach((cross) => cross.remove());
      for (const canvas of [...canvases, split]) {
        const cross = document.createElement("div");
        cross.className = "rbv-cross";
        cross.style.left = (100 * (state.pixel[0] + 0.5)) / width + "%";
        cross.style.top = (100 * (state.pixel[1] + 0.5)) / height + "%";
        canvas.parentElement.append(cross);
      }
    }

    const rest = data.start; // shown until a pixel is pointed at
    let kept = false;
    function point(pixel) {
      state.pixel = pixel;
      mark();
      drawReadout();
    }
    function under(event) {
      const box = event.currentTarget.getBoundingClientRect();
      const place = (at, from, size, count) => Math.min(Math.max(Math.floor(((at - from) / size) * count), 0), count - 1);
      return [place(event.clientX, box.left, box.width, width), place(event.clientY, box.top, box.height, height)];
    }
    for (const canvas of [...canvases, split]) {
      canvas.tabIndex = 0;
      canvas.addEventListener("pointermove", (event) => { if (!kept) point(under(event)); });
      canvas.addEventListener("pointerleave", () => { if (!kept) point(rest); });
      canvas.addEventListener("click", (event) => { kept = !kept; point(under(event)); });
      canvas.addEventListener("keydown", (event) => {
        const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        if (!step) return;
        event.preventDefault();
        kept = true;
        const [x, y] = state.pixel;
        point([Math.min(Math.max(x + step[0], 0), width - 1), Math.min(Math.max(y + step[1], 0), height - 1)]);
      });
    }
    function expose(stops) {
      state.exposure = stops;
      find("[data-exposure]").value = stops;
      find("[data-stops]").textContent = (stops > 0 ? "+" : "") + stops.toFixed(1);
      drawPictures();
    }
    find("[data-exposure]").addEventListener("input", (event) => expose(Number(event.target.value)));
    find("[data-reset]").addEventListener("click", () => expose(0));
    find("[data-split]").addEventListener("input", (event) => {
      state.seam = Number(event.target.value) / 100;
      drawSplit();
    });
    all("[data-layout]").forEach((b) => b.addEventListener("click", () => { state.layout = b.dataset.layout; show(); }));
    all("[data-map]").forEach((b) => b.addEventListener("click", () => {
      state.map = Number(b.dataset.map);
      show();
      drawReadout();
    }));
    all(".rbv-bar, [data-readout]").forEach((part) => { part.hidden = false; });
    state.pixel = rest;
    show();
    expose(0);
    mark();
  }

  function start() {
    document.querySelectorAll(".rbv:not([data-on])").forEach(mount);
  }
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
  else start();
})();
