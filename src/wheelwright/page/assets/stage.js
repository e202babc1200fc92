"use strict";
// The wheel on its ground: the loaded wheel at one load position, coloured by stress, overlaid by the edges of the
// newest shape, which may be newer than the colours. Coordinates are in metres: in the body frame, as in the
// computation, or in the view, with the axle at the origin and the ground below.
const stage = (() => {
  const { colour, bytes, wheelPainter, roundMagnification } = parts;
  const mostZoom = 200, leastZoom = 0.5;

  const turned = ([x, y], angle) => [Math.cos(angle) * x - Math.sin(angle) * y, Math.sin(angle) * x + Math.cos(angle) * y];

  // Nearest vertices of the mesh of a sector, found by bins of the azimuth.
  function nearestVertices(places, sectors) {
    const bins = 48, angle = 2 * Math.PI / sectors, n = places.length / 2;
    const members = Array.from({ length: bins }, () => []);
    const bin = (azimuth) => Math.max(0, Math.min(bins - 1, Math.floor(azimuth / angle * bins)));
    for (let k = 0; k < n; ++k) members[bin(Math.atan2(places[2 * k + 1], places[2 * k]))].push(k);
    return (x, y) => {  // of a point of sector 0
      const at = bin(Math.atan2(y, x));
      let best = 0, least = Infinity;
      for (let reach = 1; least === Infinity && reach <= bins; reach *= 3)
        for (let b = Math.max(0, at - reach); b <= Math.min(bins - 1, at + reach); ++b)
          for (const k of members[b]) {
            const d = (places[2 * k] - x) ** 2 + (places[2 * k + 1] - y) ** 2;
            if (d < least) [least, best] = [d, k];
          }
      return best;
    };
  }

  // The points of rim and tread in the mesh of a sector, by azimuth.
  function circlePoints(places, radius) {
    const points = [];
    for (let k = 0; k < places.length / 2; ++k) {
      const [x, y] = [places[2 * k], places[2 * k + 1]];
      if (Math.abs(Math.hypot(x, y) - radius) < 1e-6 * radius) points.push([x, y]);
    }
    return points.sort(([a, b], [c, d]) => Math.atan2(b, a) - Math.atan2(d, c)).slice(0, -1);
  }

  function make(overlay, picture, wheel) {
    const { sectors, inner_radius_m: inner, outer_radius_m: outer, stands_on_ground: hasGround } = wheel;
    const view = { zoom: 1, x: 0, y: 0 };  // in the middle of the canvas; 0, 0: as set by fit()
    let painter = null, fields = null, field = null, mesh = null, size = { width: 1, height: 1, ratio: 1 };
    let turn = -Math.PI / 2, magnified = 1, isLoaded = true, painted = {};

    // The fitted view: the wheel, and a strip of ground below it.
    const top = 1.05 * outer, bottom = (hasGround ? 1.13 : 1.05) * outer;
    const fitted = () => Math.min(size.width / (2.1 * outer), size.height / (top + bottom));
    const scale = () => fitted() * view.zoom;  // device pixels per metre
    const middle = () => [view.x, view.y + (top - bottom) / 2];
    const toPixel = ([x, y]) => {
      const s = scale(), [cx, cy] = middle();
      return [size.width / 2 + s * (x - cx), size.height / 2 - s * (y - cy)];
    };
    const fromPixel = ([x, y]) => {
      const s = scale(), [cx, cy] = middle();
      return [cx + (x - size.width / 2) / s, cy - (y - size.height / 2) / s];
    };

    // Sets the loaded wheel at a load position, as received from the server.
    function take(loaded) {
      const isMesh = !fields || fields.points !== loaded.fields.points || fields.triangles !== loaded.fields.triangles;
      fields = loaded.fields;
      if (painter) painter.take(fields);
      else painter = wheelPainter(picture, { fields, sectors, outer_radius_m: outer });
      if (isMesh) {
        const places = new Float32Array(bytes(fields.points).buffer);
        mesh = { n: places.length / 2, places, nearest: nearestVertices(places, sectors),
          circles: [inner, outer].map((radius) => circlePoints(places, radius)) };
      }
      const [position] = fields.positions;
      field = { x: new Int16Array(bytes(position.x).buffer), y: new Int16Array(bytes(position.y).buffer),
        full: fields.full_displacement_m / 32767, azimuth: position.azimuth_rad };
      turn = -Math.PI / 2 - field.azimuth;
      const wanted = 0.03 * outer / Math.max(loaded.travel_m, 1e-12);
      if (magnified < 0.4 * wanted || magnified > 1.25 * wanted) magnified = roundMagnification(wanted);
    }

    // The drawn displacement of the material nearest to a point of the body.
    function displacement([x, y]) {
      if (!field || !isLoaded) return [0, 0];
      const angle = 2 * Math.PI / sectors, azimuth = (Math.atan2(y, x) + 2 * Math.PI) % (2 * Math.PI);
      const sector = Math.min(sectors - 1, Math.floor(azimuth / angle));
      const k = sector * mesh.n + mesh.nearest(...turned([x, y], -sector * angle));
      return [magnified * field.full * field.x[k], magnified * field.full * field.y[k]];
    }

    // The drawn position of a point of the body. No point of the wheel is below its ground.
    function drawn(point) {
      const [u, v] = displacement(point), [x, y] = turned([point[0] + u, point[1] + v], turn);
      return toPixel([x, hasGround ? Math.max(y, -outer) : y]);
    }

    // The point of the body that is drawn at a pixel of the page.
    function bodyPoint(clientX, clientY) {
      const box = overlay.getBoundingClientRect();
      const place = turned(fromPixel([(clientX - box.left) * size.ratio, (clientY - box.top) * size.ratio]), -turn);
      let point = place;
      for (let k = 0; k < 3; ++k) {
        const [u, v] = displacement(point);
        point = [place[0] - u, place[1] - v];
      }
      return point;
    }

    // Adds lines through pixels to a path.
    const through = (path, pixels) => {
      pixels.forEach(([x, y], k) => k ? path.lineTo(x, y) : path.moveTo(x, y));
      return path;
    };
    const copiesOf = (points, copies) => Array.from({ length: copies }, (_, s) =>
      points.map((point) => turned(point, 2 * Math.PI * s / copies)));

    // Edges of the material: closed polylines of the body, in all sectors or in one.
    function addLine(path, points, copies) {
      for (const copy of copiesOf(points, copies)) through(path, copy.map(drawn)).closePath();
      return path;
    }

    // Strokes drawn by hand move as a whole with the material around them.
    function moved(points) {
      const all = points.map(displacement), u = [0, 1].map((d) => all.reduce((sum, v) => sum + v[d], 0) / all.length);
      return points.map(([x, y]) => toPixel(turned([x + u[0], y + u[1]], turn)));
    }
    function addLoose(path, points, copies) {
      for (const copy of copiesOf(points, copies)) through(path, moved(copy)).closePath();
      return path;
    }
    function addStroke(path, points, copies) {
      for (const copy of copiesOf(points, copies)) through(path, moved(copy));
      return path;
    }

    function outlinePath(outline) {
      const path = new Path2D();
      for (const { in_every_sector, points_um } of outline) {
        const points = [];
        for (let k = 0; k < points_um.length; k += 2) points.push([points_um[k] * 1e-6, points_um[k + 1] * 1e-6]);
        addLine(path, points, in_every_sector ? sectors : 1);
      }
      return path;
    }

    function circlePath(radius, index) {
      const points = mesh?.circles[index] ?? [], path = new Path2D(), all = [];
      for (let s = 0; s < sectors; ++s)
        for (const point of points) all.push(turned(point, 2 * Math.PI * s / sectors));
      if (all.length > 0) return addLine(path, all, 1);
      const [x, y] = toPixel([0, 0]);
      path.arc(x, y, radius * scale(), 0, 2 * Math.PI);
      return path;
    }

    function resize() {
      const ratio = Math.min(2, devicePixelRatio || 1), width = Math.round(overlay.clientWidth * ratio),
            height = Math.round(overlay.clientHeight * ratio);
      size = { width: Math.max(1, width), height: Math.max(1, height), ratio };
      if (overlay.width !== size.width) overlay.width = size.width;
      if (overlay.height !== size.height) overlay.height = size.height;
    }

    function paintGround(context) {
      if (!hasGround) return;
      const { width, height, ratio } = size, level = Math.round(toPixel([0, -outer])[1]), step = 11 * ratio;
      overlay.dataset.ground = String(level / ratio);
      if (level > height) return;
      context.fillStyle = colour("--panel");
      context.fillRect(0, level, width, height - level);
      context.strokeStyle = colour("--line");
      context.lineWidth = ratio;
      context.beginPath();
      for (let x = 0; x < width + 2 * step; x += step) {
        context.moveTo(x, level);
        context.lineTo(x - step, level + step);
      }
      context.stroke();
      context.strokeStyle = colour("--ink");
      context.lineWidth = 1.5 * ratio;
      context.beginPath();
      context.moveTo(0, level + 0.75 * ratio);
      context.lineTo(width, level + 0.75 * ratio);
      context.stroke();
    }

    // The coloured wheel is on a separate canvas below the edges, which is kept while only they change.
    function paintStress(seen) {
      const shown = isLoaded ? magnified : 0, key = JSON.stringify([shown, seen]);
      if (!painter || (painted.fields === fields && painted.key === key)) return;
      painted = { fields, key };
      painter(0, shown, "stress", seen);
    }

    // Paints the wheel. `outline`: edges of the newest shape; `coloured`: those of the coloured shape, if that differs;
    // `ghost`: those of the initial shape, or null; `brightest`: stress at the colours' end.
    function paint({ outline, coloured, ghost, brightest }) {
      resize();
      const context = overlay.getContext("2d"), { width, height, ratio } = size;
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, width, height);
      const [cx, cy] = middle(), s = scale();
      paintStress({ ...size, scale: s, x: cx, y: cy, ground: hasGround ? -outer : -1e9, brightest });
      const edges = outlinePath(outline), rim = circlePath(inner, 0), tread = circlePath(outer, 1);
      if (!painter) {
        const ring = new Path2D(rim);
        ring.addPath(tread);
        context.fillStyle = colour("--material");
        context.fill(ring, "evenodd");
      }
      if (coloured && coloured !== outline) {  // material not solved yet
        context.fillStyle = colour("--material");
        context.fill(outlinePath(coloured), "evenodd");
      }
      context.fillStyle = colour("--paper");
      context.fill(edges, "evenodd");
      context.strokeStyle = colour("--ink");
      context.lineWidth = ratio;
      context.lineJoin = "round";
      for (const path of [edges, rim, tread]) context.stroke(path);
      if (ghost) {
        context.save();
        context.strokeStyle = colour("--ghost");
        context.lineWidth = 1.25 * ratio;
        context.setLineDash([5 * ratio, 4 * ratio]);
        context.stroke(outlinePath(ghost));
        context.restore();
      }
      paintGround(context);
      const axle = toPixel([0, 0]);
      overlay.dataset.view = JSON.stringify({ scale: s / ratio, x: axle[0] / ratio, y: axle[1] / ratio, turn });
      return context;
    }

    // Zooms by a factor about a pixel of the page; without one, about the contact if visible, else about the middle.
    function zoom(factor, clientX, clientY) {
      const box = overlay.getBoundingClientRect(), contact = toPixel([0, -outer]);
      const isSeen = contact.every((v, d) => v >= 0 && v <= [size.width, size.height][d]);
      const pixel = clientX !== undefined ? [(clientX - box.left) * size.ratio, (clientY - box.top) * size.ratio]
        : isSeen ? contact : [size.width / 2, size.height / 2];
      const before = fromPixel(pixel);
      view.zoom = Math.max(leastZoom, Math.min(mostZoom, view.zoom * factor));
      const after = fromPixel(pixel);
      view.x += before[0] - after[0];
      view.y += before[1] - after[1];
    }

    return { take, paint, bodyPoint, drawn, addLine, addLoose, addStroke, zoom,
      pan: (dx, dy) => {
        view.x -= dx * size.ratio / scale();
        view.y += dy * size.ratio / scale();
      },
      fit: () => Object.assign(view, { zoom: 1, x: 0, y: 0 }),
      load: (on) => { isLoaded = on; },
      pixels: (metres) => metres * scale(),
      get zoomed() { return view.zoom; },
      get magnified() { return isLoaded ? magnified : 0; },
      get hasPicture() { return field !== null; },
    };
  }

  return { make, turned };
})();
