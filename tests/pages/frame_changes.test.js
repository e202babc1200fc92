"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { frameChanges } = require("./scripts.js").load("formats", "frame_changes");

const near = (a, b) => assert.ok(Math.abs(a - b) <= 1e-12 * Math.max(1, Math.abs(b)), `${a} instead of ${b}`);

// The numbers of shape 7 and a frame of shape 8, in load case 0.
const numbers = { shape_version: 7, load_case: 0,
  rows: [{ key: "volume_fraction", unit: "%", factor: 100 }, { key: "mean_travel_m", unit: "mm", factor: 1e3 },
    { key: "peak_von_mises_Pa", unit: "MPa", factor: 1e-6 }, { key: "mass_kg", unit: "kg", factor: 1 },
    { key: "unknown_to_the_page", unit: "", factor: 1 }],
  before: { volume_fraction: 0.7, mean_travel_m: 2e-3, peak_von_mises_Pa: 3e6 },
  now: { volume_fraction: 0.6, mean_travel_m: 1.5e-3, peak_von_mises_Pa: 2e6, unknown_to_the_page: 1 } };
const frame = { shape_version: 8, load_case: 0, numbers: { volume_fraction: 0.55 }, contact_numbers: { mean_travel_m: 1.25e-3 } };
const rowsById = (...of) => Object.fromEntries(frameChanges.numberRows(...of).map((row) => [row.id, row]));

test("numbers that come with the frame replace those of the earlier shape", () => {
  const { volume, travel, peak_von_mises_Pa: stress } = rowsById(frame, numbers, 0);
  near(volume.now, 55);
  near(travel.now, 1.25);
  near(travel.before, 2);
  near(stress.now, 2);
});

test("only what is left of the earlier shape is late", () => {
  const { volume, travel, peak_von_mises_Pa: stress } = rowsById(frame, numbers, 0);
  assert.deepEqual([volume.isLate, travel.isLate, stress.isLate], [false, false, true]);
  for (const row of frameChanges.numberRows({ ...frame, shape_version: 7 }, numbers, 0)) assert.equal(row.isLate, false);
});

test("a frame of another load case changes only what belongs to the shape", () => {
  const { volume, travel } = rowsById({ ...frame, load_case: 1 }, numbers, 0);
  near(volume.now, 55);
  near(travel.now, 1.5);
  assert.equal(travel.isLate, true);
});

test("quantities without a value or a label have no row, and the others keep their order", () => {
  assert.deepEqual(frameChanges.numberRows(frame, numbers, 0).map(({ id }) => id), ["volume", "travel", "peak_von_mises_Pa"]);
});

test("numbers of layers have rows with the layer's name", () => {
  const key = "peak_von_mises_Pa of tyre", rows = [...numbers.rows, { key, unit: "MPa", factor: 1e-6 }];
  const of = { ...numbers, rows, now: { ...numbers.now, [key]: 4e6 }, before: { ...numbers.before, [key]: 5e6 } };
  const row = rowsById(frame, of, 0)["peak_von_mises_Pa_of_tyre"];
  assert.equal(row.name, "peak stress of tyre");
  near(row.now, 4);
});

test("a quantity that only the initial shape has keeps its row", () => {
  const { now } = numbers, rest = { ...now };
  delete rest.peak_von_mises_Pa;
  const { peak_von_mises_Pa: stress } = rowsById(frame, { ...numbers, now: rest }, 0);
  near(stress.before, 3);
  assert.ok(Number.isNaN(stress.now));
});

// Errors of shape 12, which is version 8 of the board, under two loads.
const estimate = { shape: 12, shape_version: 8, seconds: 2.345, objective_J_per_m: 9, volume_fraction: 0.55, mean_travel_m: 1.25e-3,
  peak_von_mises_Pa: 2e6, rows: numbers.rows, errors: { objective_J_per_m: 0.1, volume_fraction: 0, mean_travel_m: 2e-5,
    peak_von_mises_Pa: null }, missing_errors: { peak_von_mises_Pa: "not solved" },
  load_cases: { kerb: { mean_travel_m: 5e-3, errors: { mean_travel_m: 4e-5 } } } };
const atLoads = (...names) => ({ ...frame, shape: 12, settings: { load_cases: names.map((name) => ({ name })) } });

test("the errors of the shape shown stand beside its numbers, in the same unit", () => {
  const { travel, peak_von_mises_Pa: stress, volume } = rowsById(atLoads(), numbers, 0, estimate);
  near(travel.error, 0.02);
  assert.equal(volume.error, 0);
  assert.ok(Number.isNaN(stress.error));  // unknown
  near(frameChanges.objectiveError(atLoads(), estimate), 0.1);
  // Its own numbers need not wait for others of that shape.
  const late = rowsById(atLoads(), { ...numbers, now: { ...numbers.now, peak_von_mises_Pa: 3e6 } }, 0, estimate);
  assert.deepEqual([late.peak_von_mises_Pa.now, late.peak_von_mises_Pa.isLate], [2, false]);
});

test("every load case has errors of its own", () => {
  const of = { ...atLoads("flat", "kerb"), load_case: 1 }, { travel } = rowsById(of, { ...numbers, load_case: 1 }, 1, estimate);
  near(travel.error, 0.04);
  const [row] = frameChanges.errorRows(estimate, "kerb").filter(({ name }) => name === "travel");
  assert.deepEqual([row.text, row.unit], ["5.00 \u00b1 0.04", "mm"]);
});

test("errors of another shape are not those of the numbers shown", () => {
  const later = { ...atLoads(), shape: 15, shape_version: 11 };
  for (const of of [null, { ...estimate, shape_version: 7 }])
    for (const { error } of frameChanges.numberRows(atLoads(), numbers, 0, of)) assert.ok(Number.isNaN(error));
  assert.ok(Number.isNaN(frameChanges.objectiveError(later, estimate)));
  assert.ok(Number.isNaN(frameChanges.objectiveError(later, null)));
});

test("the table of an estimate has values with errors, and why one is missing", () => {
  const texts = Object.fromEntries(frameChanges.errorRows(estimate, undefined).map(({ name, text }) => [name, text]));
  assert.deepEqual(texts, { objective: "9.00 \u00b1 0.10", material: "55", travel: "1.25 \u00b1 0.02", "peak stress": "2; not solved" });
  assert.deepEqual(frameChanges.errorRows(null, undefined), []);
});

test("errors say of which shape they are, how long they took, and whether it is still the newest", () => {
  const told = (of, shown = atLoads()) => frameChanges.errorsText({ busy: null, estimate: of }, shown);
  const now = told(estimate), later = told(estimate, { ...atLoads(), shape: 15, shape_version: 11 });
  for (const text of [now, later]) assert.match(text, /shape 12.* 2\.3 s/);
  assert.doesNotMatch(now, /changed/);
  assert.match(later, /changed/);
  assert.match(frameChanges.errorsText({ busy: { shape: 13, seconds: 4 }, estimate }, atLoads()), /shape 13.* 4\.0 s/);
});

test("an estimate without any error says why, once", () => {
  const reason = "the finer grid would have 1e7 unknowns", errors = { mean_travel_m: null, peak_von_mises_Pa: null };
  const text = frameChanges.errorsText({ busy: null, estimate: { ...estimate, errors,
    missing_errors: { mean_travel_m: reason, peak_von_mises_Pa: reason } } }, atLoads());
  assert.equal(text.split(reason).length, 2);
  assert.match(frameChanges.errorsText({ busy: null, estimate: { shape: 3, failure: "no memory" } }, atLoads()), /3.*no memory/);
});

test("a bound is shown in its unit, with its relation", () => {
  const bound = { name: "run_out_in_kerb", shown: { unit: "mm", factor: 1e3 }, value: 0.004, limit: 0.005, is_kept: true };
  const signs = Object.entries({ "<": "\u2264", ">": "\u2265", "=": "=" });
  for (const [relation, sign] of signs) {
    const row = frameChanges.boundRow({ ...bound, relation });
    assert.deepEqual([Number(row.value), row.limit, row.unit, row.isKept], [4, `${sign} 5`, "mm", true]);
    assert.doesNotMatch(row.name, /_/);
  }
});

test("a bound is met, met within a tolerance, or not met", () => {
  const stateOf = (more) => frameChanges.boundRow({ name: "travel", shown: { unit: "mm", factor: 1e3 }, value: 1, relation: "<", limit: 1, ...more }).state;
  assert.equal(stateOf({ is_kept: true, kept_within: 0 }), "met");
  assert.equal(stateOf({ is_kept: true, kept_within: 1e-3 }), "met within 0.1 %");
  assert.equal(stateOf({ is_kept: false, kept_within: 0 }), "not met");
});

test("objectives are compared since the last change of what they mean", () => {
  const point = (shape, objective, initial) => [shape, objective, 1e-3, 1e-5, 0.5, initial];
  const before = [point(0, 4, 4), point(1, 3, 4)], heavier = [point(1, 9, 12), point(2, 8, 12 * (1 + 1e-13))];
  assert.deepEqual(frameChanges.comparable(before), before);
  assert.deepEqual(frameChanges.comparable([...before, ...heavier]), heavier);
  assert.deepEqual(frameChanges.comparable([...before, ...heavier, point(3, 3, 4)]), [point(3, 3, 4)]);
  assert.deepEqual(frameChanges.comparable([]), []);
  const unknown = [point(0, 4, null), point(1, 3, null)];
  assert.deepEqual(frameChanges.comparable([...before, ...unknown]), unknown);
});

test("the clauses of a warning together are the warning", () => {
  for (const text of ["strains reach 12 %; the theory is linear; see below", "One sentence. And 2.5 more.", "no end", "it is 2.5 times"]) {
    const [first, rest] = frameChanges.clauses(text);
    const lettersOf = (words) => words.toLowerCase().match(/[a-z0-9]/g);
    assert.deepEqual(lettersOf(first + rest), lettersOf(text));
    assert.doesNotMatch(first, /[.;]$/);
    assert.equal(first[0], first[0].toUpperCase());
  }
  assert.deepEqual(frameChanges.clauses("a; b; c"), ["A", "B; c"]);
  assert.deepEqual(frameChanges.clauses("it is 2.5 times"), ["It is 2.5 times", ""]);
});

test("a list keeps its newest entries", () => {
  const list = [1, 2, 3];
  assert.deepEqual(frameChanges.newest(list, [4, 5], 4), [2, 3, 4, 5]);
  assert.deepEqual(frameChanges.newest(list, [], 4), [1, 2, 3]);
  assert.deepEqual(frameChanges.newest([], [1, 2, 3], 2), [2, 3]);
  assert.deepEqual(list, [1, 2, 3]);
});

test("pictures differ by shape, load case and position", () => {
  const picture = { shape_version: 1, load_case: 2, position: 3 };
  for (const other of [{ shape_version: 12, load_case: 2 }, { load_case: 1 }, { position: 31 }])
    assert.notEqual(frameChanges.pictureKey({ ...picture, ...other }), frameChanges.pictureKey(picture));
  assert.ok(frameChanges.isSameShape(picture, { ...picture, position: 4 }));
  assert.ok(!frameChanges.isSameShape(picture, { ...picture, load_case: 1 }));
  assert.ok(!frameChanges.isSameShape(picture, { ...picture, shape_version: 2 }));
});

test("outlines are the same if all their points are", () => {
  const outline = () => [{ in_every_sector: true, points_um: [1, 2, 3] }];
  assert.ok(frameChanges.sameOutline(outline(), outline()));
  assert.ok(!frameChanges.sameOutline(outline(), [{ in_every_sector: true, points_um: [1, 2, 4] }]));
  assert.ok(!frameChanges.sameOutline(outline(), null));
});

test("the curve of the travel closes after one sector", () => {
  const { x, y } = frameChanges.travelCurve([1e-3, 2e-3, 3e-3], 12);
  [0, 10, 20, 30].forEach((azimuth, k) => near(x[k], azimuth));
  [1, 2, 3, 1].forEach((travel, k) => near(y[k], travel));
  assert.equal(x.length, y.length);
});
