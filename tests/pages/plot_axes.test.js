"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { plotAxes } = require("./scripts.js").load("formats", "plot_axes");

test("ticks are multiples of 1, 2 or 5 times a power of ten, within the range", () => {
  for (const [low, high] of [[0, 1], [-3.7, 12.1], [1e-7, 9e-7], [98.9, 99.1], [-5e8, -1e8]]) {
    const all = plotAxes.ticks(low, high, 6), step = all[1] - all[0];
    const mantissa = step / 10 ** Math.floor(Math.log10(step) + 1e-6);
    assert.ok([1, 2, 5].some((one) => Math.abs(one - mantissa) < 1e-3), `${step}`);
    assert.ok(all.length >= 2 && all.length <= 7, `${all}`);
    for (const t of all) {
      assert.ok(t >= low && t <= high);
      assert.ok(Math.abs(t / step - Math.round(t / step)) < 1e-6);
    }
    assert.ok(all[0] - step < low && all.at(-1) + step > high - 1e-9 * step);
  }
});

test("ticks have no digits of rounding", () => {
  assert.deepEqual(plotAxes.ticks(0, 0.65, 7), [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
});

test("all values lie inside the axis, in their order, with equal scale", () => {
  const values = [3, 9, 4], { of } = plotAxes.scale(values, 90, 880);
  for (const value of values) assert.ok(of(value) > 90 && of(value) < 880);
  assert.ok(of(3) < of(4) && of(4) < of(9));
  assert.ok(Math.abs((of(9) - of(4)) / (of(4) - of(3)) - 5) < 1e-9);
});

test("an axis may run upwards, where pixels run downwards", () => {
  const { of } = plotAxes.scale([1, 2], 460, 20);
  assert.ok(of(1) > of(2) && of(2) > 20);
});

test("equal values have an axis too", () => {
  for (const value of [0, 5, -2e9]) {
    const { of, ticks } = plotAxes.scale([value, value], 0, 100);
    assert.ok(Math.abs(of(value) - 50) < 1e-6);
    assert.ok(ticks.length >= 2);
  }
});

test("a value is shown in its unit, and a missing one is not", () => {
  assert.equal(Number(plotAxes.shown(0.00123456789, { factor: 1e3 })), 1.2346);
  assert.equal(Number(plotAxes.shown(0, { factor: 1e3 })), 0);
  assert.equal(plotAxes.shown(0.0123456, { factor: 1e3 }, 4e-5), "12.35 \u00b1 0.04");
  for (const missing of [null, undefined]) assert.equal(plotAxes.shown(missing, { factor: 1 }), "");
});

test("the ends of a design's bar are its value less and with its error", () => {
  const design = { values: { run_out_m: 3e-6, mass_kg: 2 }, errors: { run_out_m: 1e-6 } };
  assert.deepEqual(plotAxes.ends(design, { key: "run_out_m", factor: 1e6 }).map((end) => Math.round(end)), [2, 4]);
  assert.deepEqual(plotAxes.ends(design, { key: "mass_kg", factor: 1 }), [2, 2]);
});
