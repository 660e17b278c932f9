// From radiance and errors to colours, as judge/display.py does it.
(() => {
  "use strict";
  function srgb(x) {
    if (!(x > 0)) return 0;
    if (x >= 1) return 255;
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
  }

  // NaN and infinities are magenta, which no tone curve makes by itself.
  RBV.paintPicture = (image, values, gain) => {
    const out = image.data;
    for (let i = 0, j = 0; i < values.length; i += 3, j += 4) {
      const r = values[i], g = values[i + 1], b = values[i + 2];
      const valid = Number.isFinite(r) && Number.isFinite(g) && Number.isFinite(b);
      out[j] = valid ? srgb(r * gain) : 255;
      out[j + 1] = valid ? srgb(g * gain) : 0;
      out[j + 2] = valid ? srgb(b * gain) : 255;
      out[j + 3] = 255;
    }
  };

  // The colours' ends move with the exposure: one stop more shows errors half as large.
  RBV.paintMap = (image, map, gain) => {
    const out = image.data, low = map.low / gain, high = map.high / gain;
    const steps = map.colours.map((c) => [0, 2, 4].map((i) => parseInt(c.slice(i, i + 2), 16)));
    for (let i = 0; i < map.values.length; i++) {
      const share = Math.min(Math.max((map.values[i] - low) / (high - low) || 0, 0), 1);
      const place = share * (steps.length - 1), k = Math.min(Math.floor(place), steps.length - 2);
      for (let c = 0; c < 3; c++) {
        out[4 * i + c] = steps[k][c] + (steps[k + 1][c] - steps[k][c]) * (place - k);
      }
      out[4 * i + 3] = 255;
    }
  };
})();
