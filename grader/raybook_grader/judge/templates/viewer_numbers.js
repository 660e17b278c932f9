// The pictures' own numbers: float32, exact, as judge/numbers.py packs them.
const RBV = {};
(() => {
  "use strict";
  async function inflated(text) {
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // The first bytes of all numbers, then their second bytes, and so on: that packs better.
  RBV.numbers = async (text) => {
    const planes = await inflated(text), count = planes.length / 4;
    const bytes = new Uint8Array(planes.length);
    for (let plane = 0; plane < 4; plane++) {
      for (let i = 0; i < count; i++) bytes[4 * i + plane] = planes[plane * count + i];
    }
    const view = new DataView(bytes.buffer);
    return Float32Array.from({ length: count }, (_, i) => view.getFloat32(4 * i, true));
  };

  // Few digits for the eye ...
  RBV.figures = (x, digits = 6) => {
    if (!Number.isFinite(x) || x === 0) return String(x);
    const size = Math.abs(x);
    if (size < 1e-4 || size >= 1e7) return x.toExponential(digits - 1);
    return size >= 10 ** (digits - 1) ? x.toFixed(0) : x.toPrecision(digits);
  };

  // ... and as many as tell this float32 from every other.
  RBV.exact = (x) => {
    for (let digits = 1; digits < 9; digits++) {
      if (Math.fround(Number(x.toPrecision(digits))) === x) return String(Number(x.toPrecision(digits)));
    }
    return Number.isFinite(x) ? String(Number(x.toPrecision(9))) : String(x);
  };
})();
