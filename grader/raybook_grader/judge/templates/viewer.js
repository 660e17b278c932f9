// One viewer a figure: exposure, split, zoom, error maps and the pixel under the cursor.
(() => {
  "use strict";
  const MOST = 32; // times; then a pixel of a 128-pixel picture is a third of its frame
  const between = (x, low, high) => Math.min(Math.max(x, low), high);

  function canvasIn(frame, width, height, label) {
    const canvas = document.createElement("canvas");
    Object.assign(canvas, { width, height, tabIndex: 0 });
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    frame.querySelector(".rbv-stage").replaceChildren(canvas);
    return canvas;
  }

  function partOf(frame, name) {
    const part = document.createElement("div");
    part.className = name;
    frame.append(part);
    return part;
  }

  async function mount(root) {
    const find = (selector) => root.querySelector(selector);
    const all = (selector) => [...root.querySelectorAll(selector)];
    const data = JSON.parse(find("[data-numbers]").textContent);
    const { width, height } = data, items = [...data.pictures, ...data.maps];
    for (const item of items) item.values = await RBV.numbers(item.data);

    const rest = data.start; // the pixel shown until another is pointed at
    const state = { exposure: 0, layout: "side", map: 0, seam: 0.5, zoom: 1, left: 0, top: 0, pixel: rest, kept: false };
    const images = items.map(() => new ImageData(width, height));
    const splitFrame = find('[data-pane="split"] .rbv-frame');
    const frames = [...all('[data-pane="0"] .rbv-frame, [data-pane="1"] .rbv-frame, [data-error] .rbv-frame'), splitFrame];
    const labels = [...items.map((item) => item.name), data.pictures.map((item) => item.name).join(" and ")];
    const canvases = frames.map((frame, i) => canvasIn(frame, width, height, `${labels[i]}; arrow keys read its pixels`));
    const crosses = frames.map((frame) => partOf(frame, "rbv-cross"));
    const split = canvases[canvases.length - 1], seam = partOf(splitFrame, "rbv-seam");
    const tell = RBV.readout(find("[data-readout]"), data);

    function paint() {
      const gain = 2 ** state.exposure;
      items.forEach((item, i) => {
        if (i < 2) RBV.paintPicture(images[i], item.values, gain / data.white);
        else if (i === 2 + state.map) RBV.paintMap(images[i], item, gain);
        canvases[i].getContext("2d").putImageData(images[i], 0, 0);
      });
      paintSplit();
      read();
    }

    function paintSplit() {
      const column = Math.round(state.seam * width), pen = split.getContext("2d");
      pen.drawImage(canvases[0], 0, 0);
      if (column < width) pen.drawImage(canvases[1], column, 0, width - column, height, column, 0, width - column, height);
      seam.style.left = 100 * state.zoom * (column / width - state.left) + "%";
    }

    const read = () => tell(state.pixel, [images[0], images[1], images[2 + state.map]]);

    function place() {
      const { zoom, left, top } = state, [x, y] = state.pixel;
      root.classList.toggle("rbv-zoomed", zoom > 1);
      canvases.forEach((canvas, i) => {
        canvas.parentElement.style.transform = zoom === 1 ? "" : `scale(${zoom}) translate(${-100 * left}%, ${-100 * top}%)`;
        crosses[i].style.left = 100 * zoom * ((x + 0.5) / width - left) + "%";
        crosses[i].style.top = 100 * zoom * ((y + 0.5) / height - top) + "%";
      });
      paintSplit();
    }

    function legend() {
      data.maps.forEach((map, i) => {
        const pane = find(`[data-error="${i}"]`), gain = 2 ** state.exposure;
        const say = (end) => (end > 0 && map.low < 0 ? "+" : "") + Number((end / gain).toPrecision(2)) + map.unit;
        pane.querySelector("[data-low]").textContent = say(map.low);
        pane.querySelector("[data-high]").textContent = say(map.high);
      });
    }

    function show() {
      const divided = state.layout === "split";
      all("[data-layout]").forEach((b) => b.setAttribute("aria-pressed", String(b.dataset.layout === state.layout)));
      all("[data-map]").forEach((b) => b.setAttribute("aria-pressed", String(Number(b.dataset.map) === state.map)));
      all("[data-error]").forEach((pane) => { pane.hidden = Number(pane.dataset.error) !== state.map; });
      all('[data-pane="0"], [data-pane="1"]').forEach((pane) => { pane.hidden = divided; });
      find('[data-pane="split"]').hidden = !divided;
      find(".rbv-panes").classList.toggle("rbv-two", divided);
    }

    function point(pixel, aloud = false) {
      state.pixel = [between(pixel[0], 0, width - 1), between(pixel[1], 0, height - 1)];
      const told = read();
      if (aloud) find("[data-told]").textContent = told;
      place();
    }

    // The picture's point (x, y), from 0 to 1, keeps its place in the frame.
    function zoomTo(zoom, [x, y] = [(state.pixel[0] + 0.5) / width, (state.pixel[1] + 0.5) / height]) {
      const shrink = state.zoom / between(zoom, 1, MOST);
      look(between(zoom, 1, MOST), x - (x - state.left) * shrink, y - (y - state.top) * shrink);
    }

    function look(zoom, left, top) {
      const most = 1 - 1 / zoom;
      Object.assign(state, { zoom, left: between(left, 0, most), top: between(top, 0, most) });
      find("[data-scale]").textContent = `${Number(zoom.toFixed(1))}\u00d7`;
      find('[data-zoom="out"]').disabled = zoom <= 1;
      find('[data-zoom="in"]').disabled = zoom >= MOST;
      place();
    }

    function follow() {
      const seen = 1 / state.zoom, [x, y] = [(state.pixel[0] + 0.5) / width, (state.pixel[1] + 0.5) / height];
      look(state.zoom, between(state.left, x - 0.9 * seen, x - 0.1 * seen), between(state.top, y - 0.9 * seen, y - 0.1 * seen));
    }

    function expose(stops) {
      state.exposure = stops;
      find("[data-exposure]").value = stops;
      find("[data-stops]").textContent = (stops > 0 ? "+" : "") + stops.toFixed(1);
      legend();
      paint();
    }

    function divide(share) {
      state.seam = between(share, 0, 1);
      find("[data-split]").value = 100 * state.seam;
      paintSplit();
    }

    const share = (event, canvas) => {
      const box = canvas.getBoundingClientRect();
      return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    };
    const pixelAt = ([x, y]) => [Math.floor(x * width), Math.floor(y * height)];

    function onKey(event) {
      const far = event.shiftKey ? 10 : 1, [x, y] = state.pixel;
      const moves = { ArrowLeft: [-far, 0], ArrowRight: [far, 0], ArrowUp: [0, -far], ArrowDown: [0, far] };
      const move = moves[event.key];
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (move) {
        state.kept = true;
        point([x + move[0], y + move[1]], true);
        follow();
      } else if (event.key === "+" || event.key === "=") zoomTo(2 * state.zoom);
      else if (event.key === "-") zoomTo(state.zoom / 2);
      else if (event.key === "0") zoomTo(1);
      else return;
      event.preventDefault();
    }

    canvases.forEach((canvas) => {
      let drag = null;
      canvas.addEventListener("keydown", onKey);
      canvas.addEventListener("pointerdown", (event) => {
        drag = { x: event.clientX, y: event.clientY, left: state.left, top: state.top, moved: false };
      });
      canvas.addEventListener("pointermove", (event) => {
        if (drag && event.buttons && state.zoom > 1) {
          const box = canvas.getBoundingClientRect();
          const dx = event.clientX - drag.x, dy = event.clientY - drag.y;
          if (!drag.moved && Math.hypot(dx, dy) > 4) {
            drag.moved = true;
            canvas.setPointerCapture(event.pointerId);
          }
          if (drag.moved) look(state.zoom, drag.left - dx / box.width, drag.top - dy / box.height);
        } else if (!state.kept) point(pixelAt(share(event, canvas)));
      });
      canvas.addEventListener("pointerleave", () => { if (!state.kept) point(rest); });
      canvas.addEventListener("click", (event) => {
        if (drag && drag.moved) return;
        state.kept = !state.kept;
        point(pixelAt(share(event, canvas)));
      });
      canvas.addEventListener("wheel", (event) => {
        if (!event.ctrlKey) return; // otherwise the page is scrolled
        event.preventDefault();
        zoomTo(state.zoom * 2 ** (-event.deltaY / 100), share(event, canvas));
      }, { passive: false });
    });
    seam.addEventListener("pointerdown", (event) => seam.setPointerCapture(event.pointerId));
    seam.addEventListener("pointermove", (event) => { if (event.buttons) divide(share(event, split)[0]); });

    let waiting = false;
    find("[data-exposure]").addEventListener("input", (event) => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        expose(Number(event.target.value));
      });
    });
    find("[data-reset]").addEventListener("click", () => {
      expose(0);
      divide(0.5);
      zoomTo(1);
    });
    find("[data-split]").addEventListener("input", (event) => divide(Number(event.target.value) / 100));
    all("[data-zoom]").forEach((b) => b.addEventListener("click", () => zoomTo(state.zoom * (b.dataset.zoom === "in" ? 2 : 0.5))));
    all("[data-layout]").forEach((b) => b.addEventListener("click", () => {
      state.layout = b.dataset.layout;
      show();
    }));
    all("[data-map]").forEach((b) => b.addEventListener("click", () => {
      state.map = Number(b.dataset.map);
      show();
      paint();
    }));
    all(".rbv-bar, [data-readout]").forEach((part) => { part.hidden = false; });
    show();
    expose(0);
    zoomTo(1);
    root.dataset.on = "ready";
  }

  // A page may hold many: each is unpacked when it comes into sight.
  document.addEventListener("DOMContentLoaded", () => {
    const seen = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        if (!entry.isIntersecting) continue;
        seen.unobserve(entry.target);
        mount(entry.target);
      }
    }, { rootMargin: "300px" });
    document.querySelectorAll("[data-viewer]").forEach((figure) => seen.observe(figure));
  });
})();
