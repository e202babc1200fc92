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

  // A function from a point of sector 0 to the nearest vertex of its mesh, found by bins of the azimuth.
  function nearestVertices(places, sectors) {
    const bins = 48, angle = 2 * Math.PI / sectors, n = places.length / 2;
    const members = Array.from({ length: bins }, () => []);
    const bin = (azimuth) => Math.max(0, Math.min(bins - 1, Math.floor(azimuth / angle * bins)));
    for (let k = 0; k < n; ++k) members[bin(Math.atan2(places[2 * k + 1], places[2 * k]))].push(k);
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

  return { make, turned, copiesOf, pointsOf, nearestVertices, nearestInWheel, circlePoints };
})();
