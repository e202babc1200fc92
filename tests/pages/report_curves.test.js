"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { reportCurves } = require("./scripts.js").load("formats", "colours", "report_curves");

const rolling = { azimuths_rad: [0, Math.PI / 18], travel_at_load_m: [1e-3, 2e-3], force_at_travel_N: null, travel_harmonics_m: [3e-6, 1e-6],
  force_harmonics_N: null, peak_von_mises_Pa: [1e6, 4e6] };
const run = { dimension: 2, sectors: 18, objective: { unit: "J/m", factor: 10 },
  history: { iteration: [0, 1], "objective [J/m]": [5, null], "strain_energy [J/m]": [5, null], "uniformity_l2 [J/m]": [1, 2],
    "strain_energy in kerb [J/m]": [7, 8], "mass [kg/m]": [3, 4], "mean_travel [m]": [null, null], "compliance [J/m]": [5, 6],
    "volume fraction": [0.7, 0.6] },
  rolling: { before: null, after: rolling },
  pressures: [{ x_m: [-1e-3, 1e-3], pressure_Pa: [0, 2e6] }, { x_m: [0], pressure_Pa: [1e6] }] };
const starting = (title) => reportCurves.all(run).filter((chart) => chart.title.startsWith(title));

test("only what has values is drawn", () => {
  assert.equal(starting("Mean travel").length, 0);
  assert.equal(starting("Radial force").length, 0);
  assert.equal(starting("Spectrum").length, 1);
  assert.equal(reportCurves.all({ history: {}, objective: run.objective }).length, 0);
});

test("a term that equals the objective is drawn once, and gaps remain gaps", () => {
  const [{ curves }] = starting("Objective");
  assert.equal(curves.length, 2);
  assert.deepEqual(curves.map(({ y }) => y), [[50, null], [10, 20]]);
  assert.deepEqual(curves[0].x, [0, 1]);
});

test("terms in another unit or load case, and measures, are not drawn with the objective", () => {
  const [{ curves }] = starting("Objective");
  assert.deepEqual(curves.map(({ y }) => y.at(-1)), [null, 20]);
});

test("courses are in practical units", () => {
  const history = { iteration: [0, 1], "mean_travel [m]": [1e-3, 2e-3], "run_out [m]": [1e-4, 1e-4], "peak_pressure [Pa]": [2e6, null],
    "peak_von_mises [Pa]": [3e6, 4e6], "volume fraction": [0.7, 0.6] };
  const near = (a, b) => a.forEach((v, k) => v === null ? assert.equal(b[k], null) : assert.ok(Math.abs(v - b[k]) < 1e-9));
  const charts = reportCurves.all({ history, objective: run.objective });
  assert.equal(charts.length, 3);
  near(charts[0].curves.flatMap(({ y }) => y), [1, 2, 0.1, 0.1]);
  near(charts[1].curves.flatMap(({ y }) => y), [2, null, 3, 4]);
  near(charts[2].curves[0].y, [70, 60]);
});

test("curves over a sector are closed", () => {
  const [{ curves: [after] }] = starting("Travel at fixed load");
  [0, 10, 20].forEach((azimuth, k) => assert.ok(Math.abs(after.x[k] - azimuth) < 1e-9));
  assert.deepEqual(after.y, [1, 2, 1]);
});

test("errors are bands around their curve, closed as it is", () => {
  const errors = { travel_at_load_m: [1e-4, 3e-4], force_at_travel_N: null };
  const [{ curves: [after] }] = reportCurves.all({ ...run, rolling: { before: null, after: { ...rolling, errors } } })
    .filter(({ title }) => title.startsWith("Travel at fixed load"));
  [0.1, 0.3, 0.1].forEach((error, k) => assert.ok(Math.abs(after.errors[k] - error) < 1e-9));
  assert.equal(starting("Travel at fixed load")[0].curves[0].errors, undefined);
});

test("a harmonic of a sector has as many waves per revolution as there are sectors", () => {
  const [{ curves, options }] = starting("Spectrum");
  assert.deepEqual(options.labels, ["18", "36"]);
  curves[0].y.forEach((y, k) => assert.ok(Math.abs(y - [3, 1][k]) < 1e-9));
});

test("the bar of the largest stress has another colour", () => {
  const [{ curves, options: { colours } }] = starting("Peak von Mises");
  assert.deepEqual(curves[0].y, [1, 4]);
  assert.notEqual(colours[0], colours[1]);
});

test("pressures are a curve for each position", () => {
  const [{ curves }] = starting("Contact pressure");
  assert.deepEqual(curves.map(({ x, y }) => [x, y]), [[[-1, 1], [0, 2]], [[0], [1]]]);
});
