"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { load, encoded } = require("./scripts.js");
const { meshes } = load("meshes");

const near = (a, b, tolerance = 1e-6) => assert.ok(Math.abs(a - b) <= tolerance, `${a} instead of ${b}`);

// The area of a plane mesh, positive if every triangle is counterclockwise.
function area({ places, corners }) {
  let sum = 0;
  for (let k = 0; k < corners.length; k += 3) {
    const [[ax, ay], [bx, by], [cx, cy]] = [0, 1, 2].map((d) => [places[2 * corners[k + d]], places[2 * corners[k + d] + 1]]);
    const twice = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    assert.ok(twice > 0);
    sum += twice / 2;
  }
  return sum;
}

// One sector of a ring, from r to R: two triangles over its chords.
function planeRun(sectors, r, R, positions = []) {
  const angle = 2 * Math.PI / sectors, [c, s] = [Math.cos(angle), Math.sin(angle)];
  return { sectors, fields: { points: encoded(new Float32Array([r, 0, R, 0, R * c, R * s, r * c, r * s])),
    triangles: encoded(new Uint32Array([0, 1, 2, 0, 2, 3])), positions } };
}

test("bytes decodes base64", () => {
  assert.deepEqual([...meshes.bytes(encoded(new Uint8Array([0, 1, 127, 128, 255])))], [0, 1, 127, 128, 255]);
});

test("the sectors of a plane wheel together have the area between two polygons", () => {
  for (const sectors of [3, 7, 16]) {
    const mesh = meshes.wheelMesh(planeRun(sectors, 0.2, 0.3));
    near(area(mesh), sectors / 2 * Math.sin(2 * Math.PI / sectors) * (0.3 ** 2 - 0.2 ** 2));
    assert.equal(mesh.places.length, 2 * 4 * sectors);
  }
});

test("the end of a sector is the beginning of the next", () => {
  const sectors = 5, { places } = meshes.wheelMesh(planeRun(sectors, 0.2, 0.3));
  for (let s = 0; s < sectors; ++s)
    for (const [end, begin] of [[3, 0], [2, 1]])
      for (const d of [0, 1]) near(places[2 * (4 * s + end) + d], places[2 * (4 * ((s + 1) % sectors) + begin) + d]);
});

test("the fields of a position keep the order of the vertices", () => {
  const numbers = (factor) => Int16Array.from({ length: 12 }, (_, k) => factor * (k + 1));
  const stress = Uint8Array.from({ length: 12 }, (_, k) => 20 * k);
  const { positions: [position] } = meshes.wheelMesh(planeRun(3, 0.2, 0.3, [{ azimuth_rad: 0.5,
    x: encoded(numbers(1)), y: encoded(numbers(-1000)), root_of_stress: encoded(stress) }]));
  assert.equal(position.azimuth, 0.5);
  assert.deepEqual([position.x, position.y, position.stress], [numbers(1), numbers(-1000), stress]);
});

// A closed cuboid ring in 3D: in each sector one cell between the radii r and R and the sides 0 and width, with its rim (part
// 0), tread (1) and two side faces (2). With `hole`, the rim counts as the edge of a hole (3).
function solidRun(sectors, r, R, width, hole = false) {
  const points = new Float32Array([r, 0, 0, R, 0, 0, R, 0, width, r, 0, width]);  // the cross-section at the sector's begin
  const quads = [[[0, 3, 7, 4], hole ? 3 : 0], [[1, 5, 6, 2], 1], [[0, 4, 5, 1], 2], [[3, 2, 6, 7], 2]];
  const triangles = quads.flatMap(([[a, b, c, d]]) => [a, b, c, a, c, d]);
  const vertices = 4 * sectors, positions = [0, 1].map((p) => ({ azimuth_rad: 0.1 * p,
    x: encoded(new Int16Array(vertices).fill(p ? 0 : 3 * 4681)), y: encoded(new Int16Array(vertices).fill(p ? 0 : 4 * 4681)),
    z: encoded(new Int16Array(vertices)), root_of_stress: encoded(new Uint8Array(vertices).fill(51 * (p + 1))) }));
  return { sectors, width_m: width, fields: { points: encoded(points), triangles: encoded(new Uint32Array(triangles)),
    parts: encoded(new Uint8Array(quads.flatMap(([, part]) => [part, part]))), positions,
    full_stress_Pa: 4e6, full_displacement_m: 2e-3 } };
}

test("the surface of a solid wheel is closed and encloses its volume", () => {
  for (const sectors of [3, 8]) {
    const { places, sources, corners } = meshes.wheelSurface(solidRun(sectors, 0.2, 0.3, 0.1));
    const edges = new Map();
    let volume = 0;
    for (let k = 0; k < corners.length; k += 3) {
      const [a, b, c] = [0, 1, 2].map((d) => sources[corners[k + d]]);
      for (const [from, to] of [[a, b], [b, c], [c, a]]) {
        const key = `${Math.min(from, to)} ${Math.max(from, to)}`;
        edges.set(key, (edges.get(key) ?? 0) + Math.sign(to - from));
      }
      const [p, q, r] = [a, b, c].map((v) => places.subarray(3 * v, 3 * v + 3));
      volume += (p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0])) / 6;
    }
    assert.ok([...edges.values()].every((sum) => sum === 0));  // every edge is passed in both directions
    near(Math.abs(volume), 0.1 * sectors / 2 * Math.sin(2 * Math.PI / sectors) * (0.3 ** 2 - 0.2 ** 2));
    for (let v = 2; v < places.length; v += 3) near(Math.abs(places[v]), 0.05);  // the middle of the width is the origin
  }
});

test("parts of the surface share no vertex, so that the edges between them are sharp", () => {
  const run = solidRun(4, 0.2, 0.3, 0.1), { corners, sources } = meshes.wheelSurface(run), parts = meshes.bytes(run.fields.parts);
  const partOf = new Map();
  corners.forEach((corner, k) => {
    const part = parts[Math.floor(k % (3 * parts.length) / 3)];
    assert.equal(partOf.get(corner) ?? part, part);
    partOf.set(corner, part);
  });
  assert.equal(partOf.size, sources.length);
  assert.equal(new Set(sources).size, 4 * 4);
});

test("the edges of the holes are the lines between holes and side faces", () => {
  const sectors = 6, chord = 2 * 0.2 * Math.sin(Math.PI / sectors);
  assert.equal(meshes.holeEdges(solidRun(sectors, 0.2, 0.3, 0.1)).length, 0);
  const edges = meshes.holeEdges(solidRun(sectors, 0.2, 0.3, 0.1, true));
  assert.equal(edges.length, 2 * sectors * 6);
  for (let k = 0; k < edges.length; k += 6) {
    near(Math.hypot(...[0, 1, 2].map((d) => edges[k + d] - edges[k + 3 + d])), chord);
    near(Math.hypot(edges[k], edges[k + 1]), 0.2);
  }
  const middles = Array.from({ length: edges.length / 6 }, (_, k) => [0, 1, 2].map((d) =>
    Math.round(1e4 * (edges[6 * k + d] + edges[6 * k + 3 + d]))).join(" "));
  assert.equal(new Set(middles).size, 2 * sectors);  // a line per sector and side face
});

test("colours show the root of the stress, and the displacement relative to the largest of all positions", () => {
  const { fields } = solidRun(3, 0.2, 0.3, 0.1), positions = meshes.surfacePositions(fields);
  const { stress, displacement } = meshes.colourings(fields, positions);
  near(stress.share(positions[0], 0), 0.2);
  near(stress.end, 4);
  near(displacement.share(positions[0], 5), 1);
  near(displacement.share(positions[1], 5), 0);
  near(displacement.end, 5 * 4681 / 32767 * 2);  // mm
});

test("a wheel without displacement has no coloured displacement", () => {
  const { fields } = solidRun(3, 0.2, 0.3, 0.1), positions = meshes.surfacePositions(fields).slice(1);
  assert.equal(meshes.colourings(fields, positions).displacement.share(positions[0], 0), 0);
});

test("edges between layers are repeated in every sector, and those across its end begin the next one", () => {
  const plane = planeRun(3, 0.2, 0.3);
  assert.equal(meshes.layerEdges(plane).length, 0);
  plane.fields.layer_edges = encoded(new Uint32Array([0, 3]));
  assert.deepEqual([...meshes.layerEdges(plane)], [0, 3, 4, 7, 8, 11]);
  const solid = solidRun(3, 0.2, 0.3, 0.1);
  solid.fields.is_surface = true;
  solid.fields.layer_edges = encoded(new Uint32Array([0, 4]));
  assert.deepEqual([...meshes.layerEdges(solid)], [0, 4, 4, 8, 8, 0]);
});
