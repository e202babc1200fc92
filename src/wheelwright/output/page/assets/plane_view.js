"use strict";
// Geometry of the plane wheel on its ground: from the body frame, as in the computation, to the view, with the axle at the
// origin and the ground below, and to pixels. Coordinates of both frames are in metres.
const planeView = (() => {
  const largestZoom = 200, smallestZoom = 0.5;

  const turned = ([x, y], angle) => [Math.cos(angle) * x - Math.sin(angle) * y, Math.sin(angle) * x + Math.cos(angle) * y];

  const copiesOf = (points, copies) => Array.from({ length: copies }, (_, s) =>
    points.map((point) => turned(point, 2 * Math.PI * s / copies)));

  // [[x, y], ...] in metres of a polyline that is given as [x, y, x, y, ...] in micrometres.
  function pointsOf(points_um) {
    const points = [];
    for (let k = 0; k < points_um.length; k += 2) points.push([points_um[k] * 1e-6, points_um[k + 1] * 1e-6]);
    return points;
  }

  const bins = 48;  // of the azimuth, in a sector

  // The vertices of the mesh of sector 0 in each bin, and a function from an azimuth in this sector to its bin.
  function binned(places, sectors) {
    const members = Array.from({ length: bins }, () => []);
    const bin = (azimuth) => Math.max(0, Math.min(bins - 1, Math.floor(azimuth * sectors / (2 * Math.PI) * bins)));
    for (let k = 0; k < places.length / 2; ++k) members[bin(Math.atan2(places[2 * k + 1], places[2 * k]))].push(k);
    return { members, bin };
  }

  // A function from a point of sector 0 to the nearest vertex of its mesh.
  function nearestVertices(places, sectors) {
    const { members, bin } = binned(places, sectors);
    return (x, y) => {
      const at = bin(Math.atan2(y, x));
      let best = 0, shortest = Infinity;
      for (let reach = 1; shortest === Infinity && reach <= bins; reach *= 3)
        for (let b = Math.max(0, at - reach); b <= Math.min(bins - 1, at + reach); ++b)
          for (const k of members[b]) {
            const d = (places[2 * k] - x) ** 2 + (places[2 * k + 1] - y) ** 2;
            if (d < shortest) [shortest, best] = [d, k];
          }
      return best;
    };
  }

  // A function from a point of the body to the nearest vertex of the whole wheel: vertex of sector 0 + vertices * sector.
  function nearestInWheel(places, sectors) {
    const nearest = nearestVertices(places, sectors), n = places.length / 2, angle = 2 * Math.PI / sectors;
    return ([x, y]) => {
      const azimuth = (Math.atan2(y, x) + 2 * Math.PI) % (2 * Math.PI);
      const sector = Math.min(sectors - 1, Math.floor(azimuth / angle));
      return sector * n + nearest(...turned([x, y], -sector * angle));
    };
  }

  // A function from a point of the body to shares of the vertices around it, numbered as in nearestInWheel: { vertices,
  // shares }. A mean with these shares changes smoothly with the point, also in a hole, where it passes from the material on
  // one side to that on the other.
  function smoothShares(places, sectors) {
    const { members } = binned(places, sectors), n = places.length / 2, angle = 2 * Math.PI / sectors, all = bins * sectors;
    const radii = Array.from({ length: n }, (_, k) => Math.hypot(places[2 * k], places[2 * k + 1]));
    const ring = Math.PI * (Math.max(...radii) ** 2 - Math.min(...radii) ** 2), spacing = Math.sqrt(ring / (n * sectors));
    // Visits the vertices at most so far from a point, with their distances, and some others.
    const visit = ([x, y], farthest, visitor) => {
      const radius = Math.hypot(x, y), turn = radius > farthest ? Math.asin(farthest / radius) : Math.PI;
      const reach = Math.ceil(turn / angle * bins) + 1, at = Math.floor(Math.atan2(y, x) / angle * bins);
      for (let b = 0; b < Math.min(2 * reach + 1, all); ++b) {
        const bin = (at - reach + b + 2 * all) % all, s = Math.floor(bin / bins), [u, v] = turned([x, y], -s * angle);
        for (const k of members[bin % bins]) visitor(s * n + k, Math.hypot(places[2 * k] - u, places[2 * k + 1] - v));
      }
    };
    return (point) => {
      let nearest = Infinity, within = spacing;
      do {
        within *= 2;
        visit(point, within, (vertex, distance) => { nearest = Math.min(nearest, distance); });
      } while (nearest > within);
      const farthest = 2 * (nearest + spacing), vertices = [], weights = [];
      visit(point, farthest, (vertex, distance) => {
        if (distance >= farthest) return;
        vertices.push(vertex);
        weights.push((1 - distance / farthest) ** 2);
      });
      const sum = weights.reduce((a, b) => a + b, 0);
      return { vertices, shares: weights.map((weight) => weight / sum) };
    };
  }

  // The points of rim or tread in the mesh of a sector, by azimuth; the last one belongs to the next sector.
  function circlePoints(places, radius) {
    const points = [];
    for (let k = 0; k < places.length / 2; ++k) {
      const [x, y] = [places[2 * k], places[2 * k + 1]];
      if (Math.abs(Math.hypot(x, y) - radius) < 1e-6 * radius) points.push([x, y]);
    }
    return points.sort(([a, b], [c, d]) => Math.atan2(b, a) - Math.atan2(d, c)).slice(0, -1);
  }

  // The view of a wheel of this outer radius on a canvas. Fitted, it shows the wheel and a strip of ground below it.
  function make(outer, hasGround) {
    const top = 1.05 * outer, bottom = (hasGround ? 1.13 : 1.05) * outer;
    const size = { width: 1, height: 1 }, place = { zoom: 1, x: 0, y: 0 };  // place of the middle, relative to the fitted view
    const scale = () => Math.min(size.width / (2.1 * outer), size.height / (top + bottom)) * place.zoom;  // pixels per metre
    const middle = () => [place.x, place.y + (top - bottom) / 2];
    const toPixel = ([x, y]) => {
      const s = scale(), [cx, cy] = middle();
      return [size.width / 2 + s * (x - cx), size.height / 2 - s * (y - cy)];
    };
    const fromPixel = ([x, y]) => {
      const s = scale(), [cx, cy] = middle();
      return [cx + (x - size.width / 2) / s, cy - (y - size.height / 2) / s];
    };
    return { scale, middle, toPixel, fromPixel,
      get zoom() { return place.zoom; },
      resize: (width, height) => Object.assign(size, { width, height }),
      fit: () => Object.assign(place, { zoom: 1, x: 0, y: 0 }),
      // Moves the picture by pixels, to the right and down.
      pan: (dx, dy) => {
        place.x -= dx / scale();
        place.y += dy / scale();
      },
      // Zooms about a pixel; if none is given, about the contact if it is visible, else about the middle.
      zoomBy: (factor, pixel) => {
        const contact = toPixel([0, -outer]), isSeen = contact.every((v, d) => v >= 0 && v <= [size.width, size.height][d]);
        const about = pixel ?? (isSeen ? contact : [size.width / 2, size.height / 2]), before = fromPixel(about);
        place.zoom = Math.max(smallestZoom, Math.min(largestZoom, place.zoom * factor));
        const after = fromPixel(about);
        place.x += before[0] - after[0];
        place.y += before[1] - after[1];
      },
    };
  }

  return { make, turned, copiesOf, pointsOf, nearestVertices, nearestInWheel, smoothShares, circlePoints };
})();
