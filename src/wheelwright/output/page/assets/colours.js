"use strict";
// The colours of fields and curves.
const colours = (() => {
  const curveColours = ["#1f77b4", "#d1495b", "#2e8b57", "#b8860b", "#9565c4", "#008b8b", "#c2549d", "#737a88"];

  const viridis = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137],
    [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37]];
  const gradient = `linear-gradient(90deg, ${viridis.map((c) => `rgb(${c})`).join(", ")})`;

  // Writes red, green and blue at a share in [0, 1] of the scale: from 0 to 255, divided by `divisor`.
  function write(target, offset, share, divisor) {
    const at = share * (viridis.length - 1), low = Math.min(Math.floor(at), viridis.length - 2);
    for (let c = 0; c < 3; ++c)
      target[offset + c] = (viridis[low][c] + (at - low) * (viridis[low + 1][c] - viridis[low][c])) / divisor;
  }

  // The scale as a texture: red, green, blue and opacity of 256 pixels.
  function texture() {
    const pixels = new Uint8Array(4 * 256).fill(255);
    for (let k = 0; k < 256; ++k) write(pixels, 4 * k, k / 255, 1);
    return pixels;
  }

  return { curveColours, viridis, gradient, write, texture };
})();
