"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { planeView } = require("./scripts.js").load("plane_view");

const near = (a, b, tolerance = 1e-9) => a.forEach((v, d) => assert.ok(Math.abs(v - b[d]) <= tolerance, `${a} instead of ${b}`));
const outer = 0.3;

function view({ hasGround = true, width = 900, height = 700 } = {}) {
  const made = planeView.make(outer, hasGround);
  made.resize(width, height);
  return made;
}

test("turning is counterclockwise and keeps lengths", () => {
  near(planeView.turned([2, 0], Math.PI / 2), [0, 2]);
  near(planeView.turned(planeView.turned([0.3, -0.7], 1.1), -1.1), [0.3, -0.7]);
});

test("copies of points stand at equal angles, the original first", () => {
  const copies = planeView.copiesOf([[1, 0], [2, 0]], 4);
  [[1, 0], [0, 1], [-1, 0], [0, -1]].forEach((point, k) => near(copies[k][0], point));
  near(copies[3][1], [0, -2]);
});

test("polylines come in micrometres", () => {
  near(planeView.pointsOf([1e6, -2e6, 3, 4]).flat(), [1, -2, 3e-6, 4e-6], 1e-15);
});

test("the fitted view contains the whole wheel, and the ground where there is one", () => {
  for (const hasGround of [true, false])
    for (const [width, height] of [[900, 700], [300, 900], [2000, 200]]) {
      const { toPixel } = view({ hasGround, width, height });
      for (const point of [[outer, 0], [-outer, 0], [0, outer], [0, -outer]]) {
        const [x, y] = toPixel(point);
        assert.ok(x > 0 && x < width && y > 0 && y < height);
      }
      const [[left], [right]] = [toPixel([-outer, 0]), toPixel([outer, 0])], up = toPixel([0, outer])[1], down = toPixel([0, -outer])[1];
      assert.ok(right - left > 0.9 * width || down - up > 0.85 * height);  // no smaller than necessary
      if (hasGround) assert.ok(toPixel([0, -1.1 * outer])[1] < height);
    }
});

test("pixels lie to the right and down, on the same scale in both directions", () => {
  const { toPixel, scale } = view(), [x, y] = toPixel([0.1, 0.05]);
  near(toPixel([0.2, 0.05]), [x + 0.1 * scale(), y]);
  near(toPixel([0.1, 0.15]), [x, y - 0.1 * scale()]);
});

test("from a pixel back to the same pixel, after any move", () => {
  const one = view();
  for (const move of [() => {}, () => one.pan(40, -7), () => one.zoomBy(3, [100, 50]), () => one.resize(500, 800), () => one.fit()]) {
    move();
    near(one.toPixel(one.fromPixel([123, 456])), [123, 456]);
    near(one.toPixel([0, 0]), one.toPixel(one.fromPixel(one.toPixel([0, 0]))));
  }
});

test("zooming keeps the point below the pixel", () => {
  const one = view(), pixel = [200, 300], before = one.fromPixel(pixel);
  for (const factor of [2, 0.3, 7]) one.zoomBy(factor, pixel);
  near(one.fromPixel(pixel), before);
  assert.ok(Math.abs(one.zoom - 2 * 0.3 * 7) < 1e-12);
});

test("without a pixel it zooms about the contact, or about the middle where the contact is not visible", () => {
  const one = view(), contact = one.toPixel([0, -outer]);
  one.zoomBy(10);
  near(one.toPixel([0, -outer]), contact);
  one.pan(0, -2000);
  const middle = one.fromPixel([450, 350]);
  one.zoomBy(2);
  near(one.fromPixel([450, 350]), middle);
});

test("the picture follows the pointer", () => {
  const one = view();
  one.zoomBy(5, [10, 10]);
  const [x, y] = one.toPixel([0.1, 0.2]);
  one.pan(30, -20);
  near(one.toPixel([0.1, 0.2]), [x + 30, y - 20]);
});

test("the zoom has limits, and fit() returns to the beginning", () => {
  const one = view(), before = [one.toPixel([0, 0]), one.toPixel([0.1, 0.1])];
  one.zoomBy(1e9, [0, 0]);
  assert.equal(one.zoom, 200);
  one.zoomBy(1e-9, [900, 0]);
  assert.equal(one.zoom, 0.5);
  one.fit();
  [[0, 0], [0.1, 0.1]].forEach((point, k) => near(one.toPixel(point), before[k]));
});

// Pseudorandom numbers in [0, 1), the same in every run.
function random(seed) {
  let state = seed;
  return () => (state = (1103515245 * state + 12345) % 2 ** 31) / 2 ** 31;
}

function verticesOfSector(sectors, n) {
  const next = random(7), places = new Float32Array(2 * n);
  for (let k = 0; k < n; ++k) {
    const r = 0.2 + 0.1 * next(), azimuth = 2 * Math.PI / sectors * next();
    places.set([r * Math.cos(azimuth), r * Math.sin(azimuth)], 2 * k);
  }
  return places;
}

test("the nearest vertex found by bins is, at these distances, the nearest of all", () => {
  const sectors = 6, n = 3000, places = verticesOfSector(sectors, n), nearest = planeView.nearestVertices(places, sectors);
  const next = random(11);
  for (let trial = 0; trial < 200; ++trial) {
    const r = 0.2 + 0.1 * next(), azimuth = 2 * Math.PI / sectors * next(), x = r * Math.cos(azimuth), y = r * Math.sin(azimuth);
    const distance = (k) => Math.hypot(places[2 * k] - x, places[2 * k + 1] - y);
    const best = Math.min(...Array.from({ length: n }, (_, k) => distance(k)));
    assert.equal(distance(nearest(x, y)), best);
  }
});

test("a vertex is found even where all others are far away", () => {
  const places = Float32Array.from([0.25, 0]), nearest = planeView.nearestVertices(places, 4);
  assert.equal(nearest(0, 0.25), 0);
});

test("a vertex of the wheel is one of the sector that contains the point", () => {
  const sectors = 5, n = 800, places = verticesOfSector(sectors, n), nearest = planeView.nearestInWheel(places, sectors);
  for (let s = 0; s < sectors; ++s)
    for (const k of [0, 17, 799])
      assert.equal(nearest(planeView.turned([places[2 * k], places[2 * k + 1]], 2 * Math.PI * s / sectors)), s * n + k);
});

// Vertices of a wheel with holes across the faces of sectors, at the given radius.
function verticesAroundHoles(sectors, middle, holeRadius) {
  const places = [];
  for (let r = 0.2; r <= 0.3001; r += 0.004)
    for (let k = 0; k <= 20; ++k) {
      const azimuth = 2 * Math.PI / sectors * k / 20, x = r * Math.cos(azimuth), y = r * Math.sin(azimuth);
      const holes = [0, 2 * Math.PI / sectors].map((a) => [middle * Math.cos(a), middle * Math.sin(a)]);
      if (holes.every(([a, b]) => Math.hypot(x - a, y - b) >= holeRadius)) places.push(x, y);
    }
  return Float32Array.from(places);
}

test("means of the vertices around a point are smooth in a hole, where those of the nearest vertices jump", () => {
  const sectors = 16, middle = 0.25, places = verticesAroundHoles(sectors, middle, 0.03), n = places.length / 2;
  const sharesAt = planeView.smoothShares(places, sectors), nearest = planeView.nearestInWheel(places, sectors);
  const placeOf = (vertex) => planeView.turned([places[2 * (vertex % n)], places[2 * (vertex % n) + 1]],
    2 * Math.PI * Math.floor(vertex / n) / sectors);
  for (const s of [0, 5]) {
    const turn = 2 * Math.PI * s / sectors;
    const sideOf = (vertex) => Math.sign(planeView.turned(placeOf(vertex), -turn)[1] - 1e-9);  // of the hole's middle line
    const step = 2e-4, means = [], jumps = [];
    for (let y = -0.04; y <= 0.04; y += step) {
      const point = planeView.turned([middle, y], turn), { vertices, shares } = sharesAt(point);
      assert.ok(Math.abs(shares.reduce((a, b) => a + b, 0) - 1) < 1e-12 && shares.every((share) => share >= 0));
      means.push(vertices.reduce((sum, vertex, i) => sum + shares[i] * sideOf(vertex), 0));
      jumps.push(sideOf(nearest(point)));
    }
    const steepest = (values) => Math.max(...values.slice(1).map((v, k) => Math.abs(v - values[k])));
    assert.equal(steepest(jumps), 2);
    assert.ok(steepest(means) < 0.06, String(steepest(means)));
    assert.ok(means[0] < -0.99 && means.at(-1) > 0.99);
  }
});

test("the vertices with shares are those near the point, and are the same in all sectors", () => {
  const sectors = 5, n = 800, places = verticesOfSector(sectors, n), sharesAt = planeView.smoothShares(places, sectors);
  const here = sharesAt([0.25, 0.01]), there = sharesAt(planeView.turned([0.25, 0.01], 2 * Math.PI * 2 / sectors));
  const sorted = ({ vertices, shares }, shift) => vertices.map((v, i) => [(v + shift * n) % (n * sectors), shares[i]])
    .sort(([a], [b]) => a - b);
  const [a, b] = [sorted(here, 2), sorted(there, 0)];
  assert.deepEqual(a.map(([v]) => v), b.map(([v]) => v));
  a.forEach(([, share], i) => assert.ok(Math.abs(share - b[i][1]) < 1e-5));
  assert.ok(a.length > 3 && a.length < 0.05 * n * sectors, String(a.length));
});

test("the points of a circle come by azimuth, without the first of the next sector", () => {
  const at = (r, azimuth) => [r * Math.cos(azimuth), r * Math.sin(azimuth)];
  const places = [at(0.3, 0.4), at(0.2, 0.1), at(0.3, 0), at(0.3, 0.2), at(0.25, 0.3), at(0.3, 0.1)].flat();
  const points = planeView.circlePoints(places, 0.3);
  assert.equal(points.length, 3);
  points.forEach((point, k) => near(point, at(0.3, 0.1 * k)));
});
