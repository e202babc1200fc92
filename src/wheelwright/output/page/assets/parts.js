"use strict";
// Elements, painters and charts shared by the pages of runs.
const parts = (() => {
  const { curveColours } = colours;
  const { wheelMesh, wheelSurface, surfacePositions, holeEdges, layerEdges, colourings } = meshes;
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // --- Elements ---------------------------------------------------------------------------------------

  function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  }

  // --- The wheel loaded -------------------------------------------------------------------------------

  const vertexShader = `
    attribute vec2 place; attribute float dx, dy, stress;
    uniform float magnified, ground, share; uniform vec2 scale, middle, turn;
    varying float value;
    void main() {
      vec2 p = place + magnified * vec2(dx, dy);
      vec2 q = vec2(turn.x * p.x - turn.y * p.y, max(turn.y * p.x + turn.x * p.y, ground));
      gl_Position = vec4(scale * (q - middle), 0.0, 1.0);
      value = min(1.0, share * stress);
    }`;
  const fragmentShader = `
    precision mediump float; varying float value; uniform sampler2D colours;
    void main() { gl_FragColor = texture2D(colours, vec2(value, 0.5)); }`;

  function program(gl) {
    const made = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    return made;
  }

  function buffer(gl, target, content) {
    const made = gl.createBuffer();
    gl.bindBuffer(target, made);
    gl.bufferData(target, content, gl.STATIC_DRAW);
    return made;
  }

  // Draws the wheel with the ground below: a function of the position, the magnification, the colouring (always the
  // stress) and the view: `width` and `height` of the canvas, pixels per metre (`scale`), the point in its middle (`x`,
  // `y`), the depth of the ground, and the stress at the end of the colours (`brightest`). Without a view, shows the
  // whole wheel in a square.
  function wheelPainter(canvas, run) {
    const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
    if (!gl || !gl.getExtension("OES_element_index_uint")) return null;
    const p = program(gl);
    gl.useProgram(p);
    let mesh = null, corners = null, places = null, fields = [], full = 0, full_stress = 0, buffers = [];
    const filled = (target, content) => {
      buffers.push(buffer(gl, target, content));
      return buffers.at(-1);
    };
    const attribute = (name, content, size, type, normalized) => {
      const place = gl.getAttribLocation(p, name), made = filled(gl.ARRAY_BUFFER, content);
      return () => {
        gl.bindBuffer(gl.ARRAY_BUFFER, made);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
      };
    };
    // Replaces the shape by another one of the same wheel; visible when painted.
    const take = (of) => {
      for (const old of buffers) gl.deleteBuffer(old);
      buffers = [];
      mesh = wheelMesh({ ...run, fields: of });
      full = of.full_displacement_m;
      full_stress = of.full_stress_Pa;
      corners = filled(gl.ELEMENT_ARRAY_BUFFER, mesh.corners);
      places = attribute("place", mesh.places, 2, gl.FLOAT, false);
      fields = mesh.positions.map((position) => [
        attribute("dx", position.x, 1, gl.SHORT, true), attribute("dy", position.y, 1, gl.SHORT, true),
        attribute("stress", position.stress, 1, gl.UNSIGNED_BYTE, true)]);
    };
    take(run.fields);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colours.texture());
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    const uniform = (name) => gl.getUniformLocation(p, name);
    const square = () => {
      const size = Math.min(1200, Math.round(canvas.clientWidth * (window.devicePixelRatio || 1))) || 600;
      return { width: size, height: size, scale: 0.45 * size / run.outer_radius_m, x: 0, y: 0, ground: -1e9 };
    };
    const paint = (index, magnified, colouring, view = square()) => {
      const { width, height } = view;
      if (canvas.width !== width) canvas.width = width;
      if (canvas.height !== height) canvas.height = height;
      gl.viewport(0, 0, width, height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      places();
      for (const bind of fields[index]) bind();
      const turn = -Math.PI / 2 - mesh.positions[index].azimuth;  // the ground's azimuth points down
      gl.uniform2f(uniform("turn"), Math.cos(turn), Math.sin(turn));
      gl.uniform1f(uniform("magnified"), magnified * full);
      gl.uniform2f(uniform("scale"), 2 * view.scale / width, 2 * view.scale / height);
      gl.uniform2f(uniform("middle"), view.x, view.y);
      gl.uniform1f(uniform("ground"), view.ground);
      gl.uniform1f(uniform("share"), view.brightest ? Math.sqrt(full_stress / view.brightest) : 1);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, corners);
      gl.drawElements(gl.TRIANGLES, mesh.corners.length, gl.UNSIGNED_INT, 0);
    };
    return Object.assign(paint, { take });
  }

  // Strokes a path between layers, visible on light and dark colours.
  function strokeLayers(context, path, width) {
    for (const [ink, share] of [["#ffffffb0", 2.4], ["#24292f", 1]]) {
      context.strokeStyle = ink;
      context.lineWidth = share * width;
      context.stroke(path);
    }
  }

  // Draws the lines between layers over the whole wheel in a square canvas: a function of the position and the magnification.
  function layerPainter(canvas, run) {
    const edges = layerEdges(run);
    if (edges.length === 0) return () => {};
    const { places, positions } = wheelMesh(run), full = run.fields.full_displacement_m / 32767;
    return (index, magnified) => {
      const { azimuth, x, y } = positions[index], size = canvas.width, scale = 0.45 * size / run.outer_radius_m;
      const path = new Path2D(), turn = -Math.PI / 2 - azimuth, c = Math.cos(turn), d = Math.sin(turn);
      edges.forEach((v, k) => {
        const u = places[2 * v] + magnified * full * x[v], w = places[2 * v + 1] + magnified * full * y[v];
        path[k % 2 ? "lineTo" : "moveTo"](size / 2 + scale * (c * u - d * w), size / 2 - scale * (d * u + c * w));
      });
      strokeLayers(canvas.getContext("2d"), path, size / 700);
    };
  }

  // --- The lit surface of a wheel in 3D ---------------------------------------------------------------

  // Draws the lit wheel on the ground: a function of the position, the magnification and the colouring. The wheel turns
  // under the mouse or a finger, and with the arrow keys; the mouse's wheel and + and - change its size.
  function surfacePainter(canvas, run) {
    let renderer;
    try {
      renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      return null;
    }
    const radius = run.outer_radius_m;
    const wheel = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshPhongMaterial(
      { vertexColors: THREE.VertexColors, shininess: 25, specular: 0x222222,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4 }));
    let surface = null, full = 0, places = null, shades = null, edges = null;
    const between = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xb8bec6 }));
    const ground = new THREE.Mesh(new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.35, side: THREE.DoubleSide }));
    const groundBorder = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
    const takeGround = (fields) => {
      const made = grounds.surface(grounds.outlineOf(fields, radius, 1.1 * radius), 0.5 * run.width_m + 0.25 * radius);
      for (const [object, vertices] of [[ground, made.corners], [groundBorder, made.border]]) {
        object.geometry.dispose();
        object.geometry = new THREE.BufferGeometry();
        object.geometry.setAttribute("position", new THREE.BufferAttribute(made.places, 3));
        object.geometry.setIndex(new THREE.BufferAttribute(vertices, 1));
        object.rotation.x = -(fields.camber_rad ?? 0);
        object.position.y = -0.001 * radius;
      }
      ground.visible = made.corners.length > 0;
      groundBorder.visible = ground.visible && fields.ground_m !== undefined;
    };
    const kinds = {};
    // Replaces the shape by another one of the same wheel, or its load positions; visible when painted.
    let taken = {};
    const take = (fields) => {
      const isSame = fields.points === taken.points && fields.triangles === taken.triangles;
      taken = fields;
      surface = isSame ? { ...surface, positions: surfacePositions(fields) } : wheelSurface({ ...run, fields });
      full = fields.full_displacement_m / 32767;
      Object.assign(kinds, colourings(fields, surface.positions));
      takeGround(fields);
      if (isSame) return;
      places = new Float32Array(3 * surface.sources.length);
      shades = new Float32Array(3 * surface.sources.length);
      wheel.geometry.dispose();
      wheel.geometry = new THREE.BufferGeometry();
      wheel.geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
      wheel.geometry.setAttribute("color", new THREE.BufferAttribute(shades, 3));
      wheel.geometry.setIndex(new THREE.BufferAttribute(surface.corners, 1));
      edges = layerEdges({ ...run, fields });
      between.geometry.dispose();
      between.geometry = new THREE.BufferGeometry();
      between.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * edges.length), 3));
    };
    take(run.fields);
    const before = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
    before.visible = false;
    const turned = new THREE.Group(), scene = new THREE.Scene();
    turned.add(wheel, ground, groundBorder, before, between);
    scene.add(turned, new THREE.HemisphereLight(0xffffff, 0xc8c8d0, 0.75));
    const key = new THREE.DirectionalLight(0xffffff, 0.55);
    key.position.set(-0.5, 0.8, 1);
    scene.add(key);
    const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
    camera.position.z = 5;
    const usual = { yaw: run.shows_smaller_z ? Math.PI - 0.6 : -0.6, pitch: 0.25, size: 1 };
    const view = { ...usual };
    const draw = () => {
      const ratio = window.devicePixelRatio || 1, width = Math.min(1600, Math.round(canvas.clientWidth * ratio)) || 600,
            height = Math.round(width * (canvas.clientHeight / canvas.clientWidth || 1));
      renderer.setSize(width, height, false);
      const half = 1.2 / view.size / Math.min(width, height);
      Object.assign(camera, { left: -half * width, right: half * width, top: half * height, bottom: -half * height });
      camera.updateProjectionMatrix();
      turned.rotation.set(view.pitch, view.yaw, 0);
      turned.scale.setScalar(1 / radius);
      for (const { material } of [ground, groundBorder]) material.color.set(colour("--quiet"));
      before.material.color.set(colour("--ghost") || colour("--bad"));
      renderer.render(scene, camera);
    };
    const paint = (index, magnified, kind, brightened = 1) => {
      const position = surface.positions[index], { share } = kinds[kind], factor = magnified * full;
      const [dx, dy, dz] = position.displacement;
      const place = (target, k, v) => {
        target[3 * k] = surface.places[3 * v] + factor * dx[v];
        target[3 * k + 1] = surface.places[3 * v + 1] + factor * dy[v];
        target[3 * k + 2] = surface.places[3 * v + 2] + factor * dz[v];
      };
      const lines = between.geometry.getAttribute("position");
      edges.forEach((v, k) => place(lines.array, k, v));
      lines.needsUpdate = true;
      surface.sources.forEach((v, k) => {
        place(places, k, v);
        colours.write(shades, 3 * k, Math.min(1, brightened * share(position, v)), 255);
      });
      wheel.rotation.z = before.rotation.z = between.rotation.z = -Math.PI / 2 - position.azimuth;  // the ground's azimuth points down
      for (const name of ["position", "color"]) wheel.geometry.getAttribute(name).needsUpdate = true;
      wheel.geometry.computeVertexNormals();
      draw();
    };
    // Sets the holes of another shape, whose edges are drawn as lines on request.
    const takeGhost = (fields) => {
      before.geometry.setAttribute("position", new THREE.BufferAttribute(holeEdges({ ...run, fields }), 3));
    };
    const showGhost = (isShown) => {
      before.visible = isShown && before.geometry.getAttribute("position") !== undefined;
      draw();
    };
    const turn = (yaw, pitch) => {
      view.yaw += yaw;
      view.pitch = Math.max(-1.5, Math.min(1.5, view.pitch + pitch));
      draw();
    };
    const resize = (factor) => {
      view.size = Math.max(0.5, Math.min(40, view.size * factor));
      draw();
    };
    const fit = () => {
      Object.assign(view, usual);
      draw();
    };
    canvas.tabIndex = 0;
    canvas.style.touchAction = "none";
    canvas.style.cursor = "grab";
    let held = null;
    canvas.addEventListener("pointerdown", (event) => {
      held = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!held) return;
      const per_pixel = 3 / canvas.clientWidth;
      turn((event.clientX - held[0]) * per_pixel, (event.clientY - held[1]) * per_pixel);
      held = [event.clientX, event.clientY];
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      resize(Math.exp(-0.001 * event.deltaY));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      const factor = { "+": 1.2, "-": 1 / 1.2 }[event.key];
      if (!step && !factor) return;
      event.preventDefault();
      if (step) turn(...step);
      else resize(factor);
    });
    return Object.assign(paint, { kinds, take, takeGhost, showGhost, draw, resize, fit });
  }

  // The solid ground through pixels in ascending order from left to right, down to the canvas's edge, with a line of this width
  // as its edge, and hatches at intervals of `step`.
  function paintGround(context, pixels, { line, step, hatchInk, hatchLine }) {
    if (pixels.length === 0) return;
    const bottom = pixels.reduce((lowest, [, y]) => Math.max(lowest, y), context.canvas.height);
    const edge = new Path2D(), body = new Path2D(), hatches = new Path2D();
    for (const [x, y] of pixels) edge.lineTo(x, y);
    body.addPath(edge);
    body.lineTo(pixels[pixels.length - 1][0], bottom);
    body.lineTo(pixels[0][0], bottom);
    body.closePath();
    for (const [x, y] of grounds.feet(pixels, step, context.canvas.width + 2 * step)) {
      hatches.moveTo(x, y);
      hatches.lineTo(x - step, y + step);
    }
    context.fillStyle = colour("--panel");
    context.fill(body);
    context.save();
    context.clip(body);
    context.strokeStyle = hatchInk;
    context.lineWidth = hatchLine;
    context.stroke(hatches);
    context.restore();
    context.strokeStyle = colour("--ink");
    context.lineWidth = line;
    context.stroke(edge);
  }

  // The ground below a plane wheel in a square canvas. Near the contact, magnified displacements move the tread slightly
  // below it.
  function drawGround(canvas, run) {
    const size = canvas.width = canvas.height = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1)) || 600;
    const scale = 0.45 * size / run.outer_radius_m;
    const pixels = grounds.outlineOf(run.fields, run.outer_radius_m, 2 * run.outer_radius_m)
      .map(([along, up]) => [0.5 * size + scale * along, 0.5 * size - scale * up]);
    paintGround(canvas.getContext("2d"), pixels,
      { line: size / 300, step: size / 60, hatchInk: colour("--ink"), hatchLine: size / 600 });
  }

  // --- The wheel as it is cut -------------------------------------------------------------------------

  // Edges as a path: closed polylines with x and y alternating, y up, each `copies` times around the axle.
  function wheelPath(loops, copies, unit) {
    const one = new Path2D(), all = new Path2D();
    for (const points of loops) {
      for (let k = 0; k < points.length; k += 2)
        k ? one.lineTo(points[k] * unit, -points[k + 1] * unit) : one.moveTo(points[0] * unit, -points[1] * unit);
      one.closePath();
    }
    for (let s = 0; s < copies; ++s) all.addPath(one, new DOMMatrix().rotate(-360 * s / copies));
    return all;
  }

  // The material between rim, tread and edges, with circles between layers of these radii; the axle is the origin of the
  // context.
  function paintWheel(context, edges, inner, outer, layers = []) {
    const wheel = new Path2D(edges);
    for (const r of [outer, inner]) {
      wheel.moveTo(r, 0);
      wheel.arc(0, 0, r, 0, 2 * Math.PI);
    }
    context.fillStyle = colour("--material");
    context.fill(wheel, "evenodd");
    if (layers.length) {
      const circles = new Path2D();
      for (const r of layers) {
        circles.moveTo(r, 0);
        circles.arc(0, 0, r, 0, 2 * Math.PI);
      }
      context.save();
      context.clip(wheel, "evenodd");
      strokeLayers(context, circles, context.lineWidth);
      context.restore();
    }
    context.strokeStyle = colour("--ink");
    context.stroke(wheel);
  }

  // --- Curves -----------------------------------------------------------------------------------------

  function chart(title, xTitle, yTitle, curves, options = {}) {
    const canvas = element("canvas", { role: "img", "aria-label": title });
    const figure = element("figure", {}, element("figcaption", {}, title), element("div", { class: "chart" }, canvas));
    // The two sides of a band of errors around a curve.
    const band = ({ x, y, errors }, k) => !errors ? [] : [-1, 1].map((side) => ({ label: "", isBand: true,
      data: x.map((value, i) => ({ x: value, y: y[i] + side * errors[i] })), borderWidth: 0, pointRadius: 0, pointHitRadius: 0,
      backgroundColor: `${curveColours[k % curveColours.length]}33`, fill: side < 0 ? "+1" : false }));
    const data = (of) => [...of.map(({ name, x, y }, k) => ({
      label: name, data: x ? x.map((value, i) => ({ x: value, y: y[i] })) : y,
      borderColor: curveColours[k % curveColours.length], backgroundColor: options.colours ??
        curveColours[k % curveColours.length], borderWidth: options.bars ? 0 : options.compact ? 1.5 : 2,
      pointRadius: options.compact || y.length > 30 ? 0 : 2.5, pointHitRadius: 8 })), ...of.flatMap(band)];
    let drawn = null;
    const start = () => {
      const small = options.compact ? { font: { size: 10 }, maxTicksLimit: 4, maxRotation: 0, includeBounds: false } : {};
      const axis = (text) => ({ title: { display: !options.compact, text, color: colour("--quiet") },
        ticks: { color: colour("--quiet"), ...(text === "shape" ? { precision: 0 } : {}), ...small }, grid: { color: colour("--line") } });
      drawn = new Chart(canvas, {
        type: options.bars ? "bar" : "line",
        data: { labels: options.labels, datasets: data(curves) },
        options: { animation: false, responsive: true, maintainAspectRatio: false, interaction: { mode: "nearest",
          intersect: false }, scales: { x: { ...(options.bars ? {} : { type: "linear" }), ...axis(xTitle) },
          y: { ...axis(yTitle), ...options.y } }, plugins: { legend: { display: curves.length > 1,
            labels: { color: colour("--ink"), filter: (item, { datasets }) => !datasets[item.datasetIndex].isBand } } } },
      });
    };
    // New curves of the same kinds.
    const update = (of) => {
      const datasets = data(of);
      datasets.forEach((dataset, k) => {
        if (drawn.data.datasets[k]) Object.assign(drawn.data.datasets[k], dataset);
        else drawn.data.datasets.push(dataset);
      });
      drawn.data.datasets.length = datasets.length;
      if (options.compact) {
        const x = of.flatMap((one) => one.x);
        Object.assign(drawn.options.scales.x, { min: Math.min(...x), max: Math.max(...x) });
      }
      drawn.update("none");
    };
    // In the current colours.
    const recolour = () => {
      drawn?.destroy();
      start();
    };
    return { figure, start, update, recolour };
  }

  return { colour, element, wheelPainter, layerPainter, strokeLayers, surfacePainter, paintGround, drawGround, wheelPath, paintWheel, chart };
})();
