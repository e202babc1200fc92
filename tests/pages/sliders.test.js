"use strict";
const test = require("node:test");
const assert = require("node:assert/strict");
const { sliders } = require("./scripts.js").load("sliders");

const near = (a, b) => assert.ok(Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(b)), `${a} instead of ${b}`);

test("the ends of a slider are the ends of its range", () => {
  for (const [low, high] of [[20, 95], [0, 12.5], [-1, 1], [6, -6]]) {
    const { toSlider, fromSlider } = sliders.linear(low, high);
    near(fromSlider(0), low);
    near(fromSlider(1000), high);
    near(toSlider(low), 0);
    near(toSlider(high), 1000);
  }
  near(sliders.powers(0.01, 100).fromSlider(1000), 100);
  near(sliders.powers(0.01, 100).toSlider(100), 1000);
});

test("values survive the way to the slider and back", () => {
  for (const scale of [sliders.linear(-3, 8), sliders.powers(0.01, 100), sliders.aroundLoad(500), sliders.aroundLoad(-20),
    sliders.aroundBound(85e6), sliders.aroundBound(0)])
    for (const s of [1, 10, 500, 999, 1000]) near(scale.toSlider(scale.fromSlider(s)), s);
});

test("equal steps of a slider of powers are equal factors", () => {
  const { fromSlider } = sliders.powers(0.01, 100);
  for (const s of [100, 400, 700]) near(fromSlider(s + 250) / fromSlider(s), 10);
});

test("a slider of powers reaches 0, and only 0 leads to its left end", () => {
  const { toSlider, fromSlider } = sliders.powers(0.01, 100);
  assert.equal(fromSlider(0), 0);
  assert.equal(toSlider(0), 0);
  for (const small of [1e-12, 0.005, 0.01]) assert.equal(toSlider(small), 1);
  assert.equal(toSlider(1e9), 1000);
});

test("the value of the case lies within the range around it", () => {
  for (const first of [1e-3, 4905, -300]) {
    const s = sliders.aroundLoad(first).toSlider(first);
    assert.ok(s > 0 && s < 1000);
  }
  for (const first of [1e-3, 85e6, 0]) {
    const s = sliders.aroundBound(first).toSlider(first);
    assert.ok(s > 0 && s < 1000);
  }
});

test("a negative component of the load can be reversed, a positive one keeps its sign", () => {
  near(sliders.aroundLoad(-20).fromSlider(1000), 60);
  assert.ok(sliders.aroundLoad(20).fromSlider(0) > 0);
});

test("a rounded value has so many digits", () => {
  assert.equal(sliders.rounded(123.456, 4), 123.5);
  assert.equal(sliders.rounded(0.00123456, 3), 0.00123);
});

test("the text of a number field is the same number, short also if it is large", () => {
  for (const value of [0, -0.5, 1e-7, 99999, 123400, -8.5e7, 1e21]) {
    const text = sliders.entry(value);
    assert.equal(Number(text), value);
    assert.ok(text.length <= 7, text);
  }
});
