"use strict";
// The ground below a wheel, by its outline: places [along, up] in ascending order along the ground, up from the axle.
const grounds = (() => {
  // The outline that comes with fields; without one, the ground is flat below an upright wheel. `reach`: how far it is drawn.
  const outlineOf = (fields, outer, reach) => fields.ground_m ?? [[-reach, -outer], [reach, -outer]];

  // The height of an outline at a place along it; -Infinity where there is no ground.
  function heightAt(outline, along) {
    const next = outline.findIndex(([x]) => x >= along);
    if (next < 0 || along < outline[0][0]) return -Infinity;
    const [x, y] = outline[next], [from, height] = outline[Math.max(0, next - 1)];
    return x === from ? y : height + (y - height) * (along - from) / (x - from);
  }

  // Places of an outline at multiples of `step` along it, from 0 on to `end`.
  function feet(outline, step, end) {
    const places = [];
    if (outline.length === 0) return places;
    let k = 1;
    const last = outline[outline.length - 1][0];
    for (let x = Math.max(0, Math.ceil(outline[0][0] / step) * step); x <= Math.min(last, end); x += step) {
      while (k < outline.length - 1 && outline[k][0] < x) ++k;
      const [from, height] = outline[k - 1], [to, y] = outline[k];
      places.push([x, to === from ? y : height + (y - height) * (x - from) / (to - from)]);
    }
    return places;
  }

  // The ground as a surface, on both sides of the wheel's middle as wide as this: three coordinates per vertex (along, up,
  // along the axle of an upright wheel), three vertices per triangle, and pairs of vertices at its border.
  function surface(outline, halfWidth) {
    const places = [], corners = [], border = [];
    outline.forEach(([x, y], k) => {
      places.push(x, y, halfWidth, x, y, -halfWidth);
      if (k === 0) return;
      const v = 2 * k;
      corners.push(v - 2, v, v + 1, v - 2, v + 1, v - 1);
      border.push(v - 2, v, v - 1, v + 1);
    });
    const end = 2 * outline.length - 2;
    if (end > 0) border.push(0, 1, end, end + 1);
    return { places: new Float32Array(places), corners: new Uint32Array(corners), border: new Uint32Array(border) };
  }

  return { outlineOf, heightAt, feet, surface };
})();
