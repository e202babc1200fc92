"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { formats } = require("./scripts.js").load("formats");

test("a shown number differs from its value by less than half a unit of its fifth digit", () => {
  for (const mantissa of [1, 1.00004, 1.23456789, 5.5555555, 9.99994, 9.99996])
    for (let power = -12; power <= 15; ++power)
      for (const value of [mantissa * 10 ** power, -mantissa * 10 ** power]) {
        const text = formats.shown(value), digits = /e/.test(text) ? 4 : 5;
        assert.ok(Math.abs(Number(text.replace("\u2212", "-")) - value) <= 0.5001 * 10 ** (Math.floor(Math.log10(Math.abs(value))) - digits + 1), text);
        assert.ok(text.replace(/^\u2212|\.|e.*$/g, "").replace(/^0+/, "").length <= 8, text);
      }
});

test("numbers between 1e-4 and 1e7 are shown without an exponent", () => {
  for (const value of [1e-4, 0.012345, 1, 9999999, -123456, 0]) assert.doesNotMatch(formats.shown(value), /e/);
  for (const value of [9e-5, 1e7, -2e9]) assert.match(formats.shown(value), /e/);
});

test("what is no number is shown as a dash", () => {
  for (const value of [NaN, Infinity, undefined, null]) {
    assert.equal(formats.shown(value), "\u2013");
    assert.equal(formats.short(value), "\u2013");
  }
});

test("a number and its error have the same digits", () => {
  assert.equal(formats.withError(0.380105, 0.00077), "0.3801 \u00b1 0.0008");
  assert.equal(formats.withError(7742.61, 23), "7740 \u00b1 30");
  assert.equal(formats.withError(-1.23456, 0.0131), "\u22121.235 \u00b1 0.014");
  assert.equal(formats.withError(9.99, 0.0996), "9.99 \u00b1 0.10");
  assert.equal(formats.rowText({ unit: "km", factor: 1e-3 }, 120e3, 360e3), "120 (30 to 480)");  // a life, by a factor of 4
  assert.equal(formats.rowText({ unit: "km", factor: 1e-3 }, 120e3, 3e3), "120 \u00b1 3");
  assert.equal(formats.rowText({ unit: "N", factor: 1 }, 120, 360), formats.withError(120, 360));
  for (const error of [0, 1e-9, NaN, undefined]) assert.equal(formats.withError(2943, error), formats.shown(2943));
});

test("a short number has four digits", () => {
  assert.equal(Number(formats.short(1.23456)), 1.235);
  assert.equal(Number(formats.short(98765)), 98770);
});

test("a change has the sign and the size of the difference", () => {
  assert.equal(formats.change(200, 250), "+25.00 %");
  assert.equal(formats.change(200, 150), "\u221225.00 %");
  assert.equal(formats.change(-2, -3), "+50.00 %");
  assert.equal(formats.change(1, 1.00004), "0 %");
  assert.equal(formats.change(1, 1.00006), "+0.01 %");
  assert.equal(formats.briefChange(200, 251), "+25.5\u2009%");
});

test("a change relative to nothing is not shown", () => {
  for (const [before, after] of [[0, 1], [0, 0], [1e-9, 1], [NaN, 1], [1, undefined]]) assert.equal(formats.change(before, after), "");
  assert.equal(formats.briefChange(0, 1), "");
});

test("a full turn has 360 degrees", () => {
  assert.ok(Math.abs(2 * Math.PI * formats.degree - 360) < 1e-9);
});

test("times are shown in seconds or minutes", () => {
  assert.equal(formats.minutes(99.94), "99.9 s");
  assert.equal(formats.minutes(150), "2.5 min");
  assert.equal(formats.minutes(6000), "100.0 min");
});

test("a magnification is 1, 2 or 5 times a power of ten, at most the wanted one, and more than 2/5 of it", () => {
  for (let wanted = 1; wanted < 1e6; wanted *= 1.07) {
    const m = formats.roundMagnification(wanted), mantissa = m / 10 ** Math.floor(Math.log10(m) + 1e-9);
    assert.ok([1, 2, 5].some((one) => Math.abs(one - mantissa) < 1e-9), String(m));
    assert.ok(m <= wanted * 1.0001 && m > 0.399 * wanted, `${m} for ${wanted}`);
  }
  for (const wanted of [0.99, 0.3, 1e-5]) assert.equal(formats.roundMagnification(wanted), 1);
});

test("the magnification stays while the drawn displacement is about 3 % of the radius", () => {
  const radius = 0.3, travel = 1e-3;  // 9 would be right
  assert.equal(formats.steadyMagnification(undefined, travel, radius), 5);
  for (const current of [4, 5, 10]) assert.equal(formats.steadyMagnification(current, travel, radius), current);
  for (const current of [1, 3.5, 12, 100]) assert.equal(formats.steadyMagnification(current, travel, radius), 5);
  assert.ok(Number.isFinite(formats.steadyMagnification(1, 0, radius)));
});

test("the labels of a scale of square roots are quadratic, and the last one has the unit", () => {
  assert.deepEqual(formats.scaleLabels([0, 0.5, 1], { end: 8, unit: "MPa", power: 2 }), ["0", "2", "8 MPa"]);
  assert.deepEqual(formats.scaleLabels([0, 0.25, 1], { end: 8.0004, unit: "mm" }), ["0", "2", "8 mm"]);
});

test("a scale that ends below the peak names it", () => {
  const last = (peak) => formats.scaleLabels([0, 1], { end: 1.9, unit: "MPa", peak })[1];
  assert.equal(last(2.456), "1.9, up to 2.46 MPa");
  for (const peak of [1.9, 1.9001, 1.5, undefined]) assert.equal(last(peak), "1.9 MPa");
});

test("lines in pictures are explained for wheels with layers", () => {
  assert.equal(formats.layersText(undefined), "");
  assert.match(formats.layersText({ names: ["core", "tyre"] }), / core, tyre\.$/);
});
