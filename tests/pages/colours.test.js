"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { colours } = require("./scripts.js").load("colours");

const at = (share, divisor = 1) => {
  const target = [7, 7, 7, 7, 7];
  colours.write(target, 1, share, divisor);
  assert.deepEqual([target[0], target[4]], [7, 7]);
  return target.slice(1, 4);
};

test("the given colours stand at equal distances on the scale", () => {
  const last = colours.viridis.length - 1;
  colours.viridis.forEach((colour, k) => at(k / last).forEach((v, c) => assert.ok(Math.abs(v - colour[c]) < 1e-9)));
});

test("between two colours the scale is linear", () => {
  const last = colours.viridis.length - 1, [a, b] = colours.viridis;
  at(0.25 / last).forEach((v, c) => assert.ok(Math.abs(v - (0.75 * a[c] + 0.25 * b[c])) < 1e-9));
});

test("colours can be fractions of one", () => {
  at(1, 255).forEach((v, c) => assert.equal(v, colours.viridis.at(-1)[c] / 255));
});

test("the scale gets brighter everywhere, so that it can be read without colours", () => {
  const luminance = (rgb) => rgb.map((c) => c / 255).map((c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
    .reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
  for (let k = 0; k < 100; ++k) assert.ok(luminance(at(k / 100)) < luminance(at((k + 1) / 100)));
});

test("the texture begins and ends with the ends of the scale and is opaque", () => {
  const pixels = colours.texture();
  assert.equal(pixels.length, 4 * 256);
  assert.deepEqual([...pixels.slice(0, 3)], colours.viridis[0]);
  assert.deepEqual([...pixels.slice(-4, -1)], colours.viridis.at(-1));
  for (let k = 0; k < 256; ++k) assert.equal(pixels[4 * k + 3], 255);
});

test("no two curves of a chart have the same colour", () => {
  assert.equal(new Set(colours.curveColours).size, colours.curveColours.length);
});
