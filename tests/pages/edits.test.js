"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { planeView, edits } = require("./scripts.js").load("plane_view", "edits");

const near = (a, b, tolerance = 1e-9) => a.forEach((v, d) => assert.ok(Math.abs(v - b[d]) <= tolerance, `${a} instead of ${b}`));
const circle = ([x, y], r, n = 40) => Array.from({ length: n }, (_, k) => [x + r * Math.cos(2 * Math.PI * k / n),
  y + r * Math.sin(2 * Math.PI * k / n)]);
const inMicrometres = (points) => points.flat().map((v) => Math.round(1e6 * v));
const square = [[0, 0], [2, 0], [2, 2], [0, 2]];

test("a point is inside a polygon or not, also in a bay", () => {
  assert.ok(edits.isInside(square, [1, 1]));
  for (const point of [[3, 1], [-1, 1], [1, 3], [1, -1]]) assert.ok(!edits.isInside(square, point));
  const bay = [[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]];
  assert.ok(!edits.isInside(bay, [2, 2]));
  assert.ok(edits.isInside(bay, [0.5, 2]) && edits.isInside(bay, [3.5, 2]));
});

const sectors = 6, centre = [0.25, 0.05];
const wheel = [{ in_every_sector: false, points_um: inMicrometres(circle([0, 0], 0.15)) },
  { in_every_sector: true, points_um: inMicrometres(circle(centre, 0.02)) }];

test("a hole is found in every sector, with its edge and its centre there", () => {
  for (let s = 0; s < sectors; ++s) {
    const there = planeView.turned(centre, 2 * Math.PI * s / sectors);
    const hole = edits.holeAt([there[0] + 0.015, there[1]], wheel, sectors);
    near(hole.centre, there, 1e-6);
    for (const [x, y] of hole.edge) near([Math.hypot(x - there[0], y - there[1])], [0.02], 1e-6);
  }
});

test("neither material nor the edge around the axle is a hole", () => {
  assert.equal(edits.holeAt([centre[0] + 0.021, centre[1]], wheel, sectors), null);
  assert.equal(edits.holeAt([0.1, 0], wheel, sectors), null);
});

test("a hole that is not repeated exists once", () => {
  const once = [{ in_every_sector: false, points_um: inMicrometres(circle(centre, 0.02)) }];
  assert.ok(edits.holeAt(centre, once, sectors));
  assert.equal(edits.holeAt(planeView.turned(centre, 2 * Math.PI / sectors), once, sectors), null);
});

const hole = { edge: circle(centre, 0.02), centre };
const tip = 0.01;
const edit = (tool, from, to, more = {}) => ({ tool, from, to, path: [from], hole, ...more });

test("a moved hole keeps its form", () => {
  const moved = edit("move", [0.25, 0.05], [0.26, 0.02]);
  edits.edgeOf(moved, tip).forEach((point, k) => near(point, [hole.edge[k][0] + 0.01, hole.edge[k][1] - 0.03]));
  const { by_m: by, ...command } = edits.commandOf(moved, tip);
  near(by, [0.01, -0.03]);
  assert.deepEqual(command, { do: "move_hole", at_m: [0.25, 0.05], scale: 1 });
});

test("a resized hole keeps its centre and grows with the distance of the pointer from it", () => {
  const resized = edit("resize", [centre[0] + 0.02, centre[1]], [centre[0], centre[1] - 0.03]);
  for (const [x, y] of edits.edgeOf(resized, tip)) near([Math.hypot(x - centre[0], y - centre[1])], [0.03]);
  const { scale, by_m: by } = edits.commandOf(resized, tip);
  near([scale], [1.5]);
  assert.deepEqual(by, [0, 0]);
});

test("a hole grows at most fivefold and shrinks at most to a fifth, also when it is held at its centre", () => {
  const scale = (from, to) => edits.commandOf(edit("resize", from, to), tip).scale;
  assert.equal(scale([centre[0] + 0.01, centre[1]], [centre[0] + 1, centre[1]]), 5);
  assert.equal(scale([centre[0] + 0.01, centre[1]], centre), 0.2);
  assert.ok(Number.isFinite(scale(centre, [centre[0] + 0.002, centre[1]])));
});

test("an added hole is a circle through the pointer, or of the tip's size after a click", () => {
  for (const [to, radius] of [[[0.25, 0.03], 0.03], [[0.251, 0], tip]]) {
    const added = edit("add", [0.25, 0], to, { hole: null });
    for (const [x, y] of edits.edgeOf(added, tip)) near([Math.hypot(x - 0.25, y)], [radius]);
    const { radius_m: told, ...command } = edits.commandOf(added, tip);
    near([told], [radius]);
    assert.deepEqual(command, { do: "paint", as: "hole", path_m: [[0.25, 0]] });
  }
});

test("brushes send their path: paint as material, erase as a hole", () => {
  const path = [[0.2, 0], [0.21, 0], [0.22, 0.01]];
  for (const [tool, as] of [["paint", "material"], ["erase", "hole"]])
    assert.deepEqual(edits.commandOf(edit(tool, path[0], path[2], { path }), tip), { do: "paint", as, path_m: path, radius_m: tip });
});

test("filling tells only where", () => {
  assert.deepEqual(edits.commandOf(edit("fill", centre, centre), tip), { do: "fill_hole", at_m: centre });
});

test("a path gets a point when the brush has moved by a third of the tip or a millimetre, and ends at 200 points", () => {
  const drawn = edit("paint", [0.2, 0], [0.2, 0]);
  assert.ok(!edits.extendsPath(drawn, [0.2029, 0], tip));
  assert.ok(edits.extendsPath(drawn, [0.2031, 0], tip));
  assert.ok(!edits.extendsPath(drawn, [0.2009, 0], 0.001));
  assert.ok(edits.extendsPath(drawn, [0.2011, 0], 0.001));
  assert.ok(!edits.extendsPath({ path: Array(200).fill([0.2, 0]) }, [0.25, 0], tip));
});
