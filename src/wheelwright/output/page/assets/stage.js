"use strict";
// The wheel on its ground: the loaded wheel at one load position, coloured by stress, overlaid by the edges of the
// newest shape, which may be newer than the colours. Coordinates and frames are those of planeView.
const stage = (() => {
  const { colour, strokeLayers, paintGround, wheelPainter } = parts, { steadyMagnification } = formats, { bytes, layerEdges } = meshes;
  const { turned, copiesOf, pointsOf, nearestInWheel, smoothShares, circlePoints } = planeView;

  function make(overlay, picture, wheel) {
    const { sectors, inner_radius_m: inner, outer_radius_m: outer, stands_on_ground: hasGround } = wheel;
    const view = planeView.make(outer, hasGround), { toPixel } = view;
    let painter = null, fields = null, field = null, mesh = null, size = { width: 1, height: 1, ratio: 1 };
    let turn = -Math.PI / 2, magnified = 1, isLoaded = true, painted = {};
    // The wheel is drawn flat where it touches flat ground; other ground covers what magnified displacements move below it.
    const isFlat = () => hasGround && !fields?.ground_m, lowest = () => isFlat() ? -outer : -1e9;

    // Sets the loaded wheel at a load position, as received from the server.
    function take(loaded) {
      const isMesh = !fields || fields.points !== loaded.fields.points || fields.triangles !== loaded.fields.triangles;
      fields = loaded.fields;
      if (painter) painter.take(fields);
      else painter = wheelPainter(picture, { fields, sectors, outer_radius_m: outer });
      if (isMesh) {
        const places = new Float32Array(bytes(fields.points).buffer);
        mesh = { vertices: places.length / 2, nearest: nearestInWheel(places, sectors), sharesAt: smoothShares(places, sectors),
          circles: [inner, outer].map((radius) => circlePoints(places, radius)), places,
          layerEdges: layerEdges({ fields, sectors }) };
      }
      const [position] = fields.positions;
      field = { x: new Int16Array(bytes(position.x).buffer), y: new Int16Array(bytes(position.y).buffer),
        full: fields.full_displacement_m / 32767, azimuth: position.azimuth_rad };
      turn = -Math.PI / 2 - field.azimuth;
      magnified = steadyMagnification(magnified, loaded.travel_m, outer);
    }

    // The drawn displacement of the material nearest to a point of the body.
    function displacement(point) {
      if (!field || !isLoaded) return [0, 0];
      const k = mesh.nearest(point);
      return [magnified * field.full * field.x[k], magnified * field.full * field.y[k]];
    }

    // The pixel of a displaced point of the body. No point of the wheel is below flat ground.
    function pixelOf(point) {
      const [x, y] = turned(point, turn);
      return toPixel([x, Math.max(y, lowest())]);
    }

    // The drawn position of a point of the body.
    function drawn(point) {
      const [u, v] = displacement(point);
      return pixelOf([point[0] + u, point[1] + v]);
    }

    // The point of the body that is drawn at a pixel of the page.
    function bodyPoint(clientX, clientY) {
      const box = overlay.getBoundingClientRect();
      const place = turned(view.fromPixel([(clientX - box.left) * size.ratio, (clientY - box.top) * size.ratio]), -turn);
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
      for (const { in_every_sector, points_um } of outline) addLine(path, pointsOf(points_um), in_every_sector ? sectors : 1);
      return path;
    }

    // Lines that may lie far from all material move with a mean of the material around them: those of the nearest material
    // would jump in the middle of a hole. The shares of an outline are kept while the mesh stays.
    let shared = {};
    function sharesOf(outline) {
      if (shared.mesh !== mesh || shared.outline !== outline)
        shared = { mesh, outline, lines: outline.map(({ in_every_sector, points_um }) => ({ copies: in_every_sector ? sectors : 1,
          points: pointsOf(points_um).map((point) => ({ point, ...mesh.sharesAt(point) })) })) };
      return shared.lines;
    }
    function smoothlyDrawn({ point, vertices, shares }, sector) {
      const factor = magnified * field.full, all = mesh.vertices * sectors;
      let [x, y] = turned(point, 2 * Math.PI * sector / sectors);
      vertices.forEach((vertex, i) => {
        const k = (vertex + sector * mesh.vertices) % all;
        x += factor * shares[i] * field.x[k];
        y += factor * shares[i] * field.y[k];
      });
      return pixelOf([x, y]);
    }
    function smoothPath(outline) {
      if (!field || !isLoaded) return outlinePath(outline);
      const path = new Path2D();
      for (const { copies, points } of sharesOf(outline))
        for (let s = 0; s < copies; ++s) through(path, points.map((point) => smoothlyDrawn(point, s))).closePath();
      return path;
    }

    function circlePath(radius, index) {
      const path = new Path2D(), all = copiesOf(mesh?.circles[index] ?? [], sectors).flat();
      if (all.length > 0) return addLine(path, all, 1);
      const [x, y] = toPixel([0, 0]);
      path.arc(x, y, radius * view.scale(), 0, 2 * Math.PI);
      return path;
    }

    // The lines between layers of the coloured shape.
    function layersPath() {
      const path = new Path2D(), n = mesh.vertices, factor = isLoaded ? magnified * field.full : 0;
      mesh.layerEdges.forEach((v, k) => {
        const [x, y] = turned([mesh.places[2 * (v % n)], mesh.places[2 * (v % n) + 1]], 2 * Math.PI * Math.floor(v / n) / sectors);
        path[k % 2 ? "lineTo" : "moveTo"](...pixelOf([x + factor * field.x[v], y + factor * field.y[v]]));
      });
      return path;
    }

    function resize() {
      const ratio = Math.min(2, devicePixelRatio || 1), width = Math.round(overlay.clientWidth * ratio),
            height = Math.round(overlay.clientHeight * ratio);
      size = { width: Math.max(1, width), height: Math.max(1, height), ratio };
      view.resize(size.width, size.height);
      if (overlay.width !== size.width) overlay.width = size.width;
      if (overlay.height !== size.height) overlay.height = size.height;
    }

    // The outline of the ground in pixels, from edge to edge if it is flat.
    function groundPixels() {
      if (!isFlat()) return fields.ground_m.map(toPixel);
      const level = Math.round(toPixel([0, -outer])[1]), beyond = 22 * size.ratio;
      return [[-beyond, level], [size.width + beyond, level]];
    }

    function drawGround(context) {
      if (!hasGround) return;
      const { ratio } = size, pixels = groundPixels();
      overlay.dataset.ground = String(grounds.heightAt(pixels, toPixel([0, 0])[0]) / ratio);
      context.save();
      context.translate(0, 0.75 * ratio);  // half of the line
      paintGround(context, pixels, { line: 1.5 * ratio, step: 11 * ratio, hatchInk: colour("--line"), hatchLine: ratio });
      context.restore();
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
      const [cx, cy] = view.middle(), s = view.scale();
      paintStress({ ...size, scale: s, x: cx, y: cy, ground: lowest(), brightest });
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
      if (mesh?.layerEdges.length) strokeLayers(context, layersPath(), 0.8 * ratio);
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
        context.stroke(smoothPath(ghost));
        context.restore();
      }
      drawGround(context);
      const axle = toPixel([0, 0]);
      overlay.dataset.view = JSON.stringify({ scale: s / ratio, x: axle[0] / ratio, y: axle[1] / ratio, turn });
      return context;
    }

    // Zooms about a pixel of the page, or as planeView does without one.
    function zoom(factor, clientX, clientY) {
      const box = overlay.getBoundingClientRect();
      view.zoomBy(factor, clientX === undefined ? undefined : [(clientX - box.left) * size.ratio, (clientY - box.top) * size.ratio]);
    }

    return { take, paint, bodyPoint, drawn, addLine, addLoose, addStroke, zoom,
      pan: (dx, dy) => view.pan(dx * size.ratio, dy * size.ratio),
      fit: view.fit,
      load: (on) => { isLoaded = on; },
      pixels: (metres) => metres * view.scale(),
      get zoomed() { return view.zoom; },
      get magnified() { return isLoaded ? magnified : 0; },
      get hasPicture() { return field !== null; },
    };
  }

  return { make };
})();
