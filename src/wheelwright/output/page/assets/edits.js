"use strict";
// What the user draws on the plane wheel. An edit is { tool, from, to, path, hole }: the tool, where it was set down, where
// it is now, the points in between, and the hole that it holds. Points are [x, y] in metres of the body frame.
const edits = (() => {
  const { turned, pointsOf } = planeView;
  const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

  function isInside(points, [x, y]) {
    let inside = false;
    for (let i = 0, j = points.length - 1; i < points.length; j = i++)
      if ((points[i][1] > y) !== (points[j][1] > y) &&
          x < (points[j][0] - points[i][0]) * (y - points[i][1]) / (points[j][1] - points[i][1]) + points[i][0])
        inside = !inside;
    return inside;
  }

  // The edge of the hole around a point, with its centre; null if there is material. An edge around the axle is no hole.
  function holeAt(point, outline, sectors) {
    for (const { in_every_sector, points_um } of outline) {
      const n = in_every_sector ? sectors : 1, points = pointsOf(points_um);
      for (let s = 0; s < n; ++s) {
        const edge = points.map((one) => turned(one, 2 * Math.PI * s / n));
        if (!isInside(edge, point) || isInside(edge, [0, 0])) continue;
        const sum = edge.reduce(([a, b], [x, y]) => [a + x, b + y], [0, 0]);
        return { edge, centre: sum.map((v) => v / edge.length) };
      }
    }
    return null;
  }

  // The factor by which a hole grows when it is dragged away from its centre.
  const scaleOf = ({ from, to, hole }) =>
    Math.min(5, Math.max(0.2, distance(to, hole.centre) / Math.max(1e-3, distance(from, hole.centre))));

  const addedRadius = ({ from, to }, tipRadius) => Math.max(tipRadius, distance(from, to));

  // Whether a point is far enough from the end of the path to be added.
  const extendsPath = ({ path }, point, tipRadius) =>
    distance(point, path.at(-1)) > Math.max(0.3 * tipRadius, 1e-3) && path.length < 200;

  // The edge drawn by a tool, in one sector.
  function edgeOf(edit, tipRadius) {
    const { tool, from, to, hole } = edit;
    if (tool === "move") return hole.edge.map(([x, y]) => [x + to[0] - from[0], y + to[1] - from[1]]);
    if (tool === "resize") {
      const f = scaleOf(edit), [cx, cy] = hole.centre;
      return hole.edge.map(([x, y]) => [cx + f * (x - cx), cy + f * (y - cy)]);
    }
    const radius = addedRadius(edit, tipRadius);
    return Array.from({ length: 48 }, (_, k) => [from[0] + radius * Math.cos(k * Math.PI / 24), from[1] + radius * Math.sin(k * Math.PI / 24)]);
  }

  // The command that tells the run what was drawn.
  function commandOf(edit, tipRadius) {
    const { tool, from, to, path } = edit;
    return {
      move: () => ({ do: "move_hole", at_m: from, by_m: [to[0] - from[0], to[1] - from[1]], scale: 1 }),
      resize: () => ({ do: "move_hole", at_m: from, by_m: [0, 0], scale: scaleOf(edit) }),
      add: () => ({ do: "paint", as: "hole", path_m: [from], radius_m: addedRadius(edit, tipRadius) }),
      fill: () => ({ do: "fill_hole", at_m: from }),
      paint: () => ({ do: "paint", as: "material", path_m: path, radius_m: tipRadius }),
      erase: () => ({ do: "paint", as: "hole", path_m: path, radius_m: tipRadius }),
    }[tool]();
  }

  return { isInside, holeAt, extendsPath, edgeOf, commandOf };
})();
