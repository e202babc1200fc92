"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { grounds } = require("./scripts.js").load("grounds");

// A step up with a steep face, between flat parts; and a drum, which ends.
const kerb = [[-2, -1], [0.1, -1], [0.1, -0.9], [0.11, -0.8], [2, -0.8]];
const drum = Array.from({ length: 41 }, (_, k) => {
  const x = -0.5 + k / 40;
  return [x, Math.sqrt(0.25 - x * x) - 1.5];
});

test("without an outline the ground is flat and below the wheel", () => {
  const outline = grounds.outlineOf({}, 0.3, 2);
  for (const along of [-2, -0.1, 0, 2]) assert.equal(grounds.heightAt(outline, along), -0.3);
  assert.equal(grounds.outlineOf({ ground_m: kerb }, 0.3, 2), kerb);
  assert.deepEqual(grounds.outlineOf({ ground_m: [] }, 0.3, 2), []);
});

test("the height is that of the straight line between two places, and there is none beyond the ends", () => {
  assert.equal(grounds.heightAt(kerb, -1), -1);
  assert.equal(grounds.heightAt(kerb, 0.5), -0.8);
  assert.ok(Math.abs(grounds.heightAt(kerb, 0.105) + 0.85) < 1e-12);
  for (const [x, y] of drum) assert.equal(grounds.heightAt(drum, x), y);
  for (const along of [-0.51, 0.51]) assert.equal(grounds.heightAt(drum, along), -Infinity);
  assert.equal(grounds.heightAt([], 0), -Infinity);
});

test("feet of hatches stand on the outline at equal intervals, as far as there is ground in the picture", () => {
  const feet = grounds.feet(kerb, 0.3, 1.6);
  assert.deepEqual(feet.map(([x]) => Math.round(x * 10)), [0, 3, 6, 9, 12, 15]);
  for (const [x, y] of feet) assert.equal(y, grounds.heightAt(kerb, x));
  assert.ok(grounds.feet(drum, 0.1, 5).every(([x]) => x >= 0 && x <= 0.5));
  assert.deepEqual(grounds.feet([], 0.1, 5), []);
  assert.deepEqual(grounds.feet([[7, 0], [9, 1]], 0.1, 5), []);
});

test("the surface has the outline on both sides, the area of its length by its width, and a border around it", () => {
  for (const outline of [kerb, drum]) {
    const { places, corners, border } = grounds.surface(outline, 0.2), at = (v) => places.subarray(3 * v, 3 * v + 3);
    outline.forEach(([x, y], k) => [0.2, -0.2].forEach((z, side) =>
      [x, y, z].forEach((value, d) => assert.equal(at(2 * k + side)[d], Math.fround(value)))));
    const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d], minus = (a, b) => a.map((v, d) => v - b[d]);
    let area = 0;
    for (let t = 0; t < corners.length; t += 3) {
      const [a, b, c] = [...corners.subarray(t, t + 3)].map((v) => [...at(v)]), normal = cross(minus(b, a), minus(c, a));
      area += Math.hypot(...normal) / 2;
    }
    const lengthOf = outline.slice(1).reduce((sum, [x, y], k) => sum + Math.hypot(x - outline[k][0], y - outline[k][1]), 0);
    assert.ok(Math.abs(area - 0.4 * lengthOf) < 1e-6);
    // Two edges meet at every vertex, and their length is that around the surface.
    const uses = new Map();
    let around = 0;
    for (let e = 0; e < border.length; e += 2) {
      const [v, w] = border.subarray(e, e + 2);
      for (const end of [v, w]) uses.set(end, (uses.get(end) ?? 0) + 1);
      around += Math.hypot(...minus([...at(v)], [...at(w)]));
    }
    assert.equal(uses.size, 2 * outline.length);
    for (const count of uses.values()) assert.equal(count, 2);
    assert.ok(Math.abs(around - 2 * lengthOf - 0.8) < 1e-5);
  }
  assert.equal(grounds.surface([], 0.2).corners.length, 0);
});
