"use strict";
// What all pages draw with.
const parts = (() => {
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const curveColours = ["#1f77b4", "#d1495b", "#2e8b57", "#b8860b", "#9565c4", "#008b8b", "#c2549d", "#737a88"];
  const degree = 180 / Math.PI;

  // --- Elements ---------------------------------------------------------------------------------------

  function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  }

  // At most five digits, without an exponent where people would not write one.
  function shown(value) {
    if (!Number.isFinite(value)) return "-";
    const size = Math.abs(value);
    return size !== 0 && (size < 1e-4 || size >= 1e7) ? value.toExponential(3) : String(Number(value.toPrecision(5)));
  }

  function change(before, after) {
    const percents = 100 * (after / before - 1);
    if (!Number.isFinite(percents)) return "";
    return Math.abs(percents) < 0.005 ? "0 %" : `${percents > 0 ? "+" : "\u2212"}${Math.abs(percents).toFixed(2)} %`;
  }

  const minutes = (seconds) => seconds < 100 ? `${seconds.toFixed(1)} s` : `${(seconds / 60).toFixed(1)} min`;

  // --- Colours ----------------------------------------------------------------------------------------

  const viridis = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137],
    [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37]];
  const gradient = `linear-gradient(90deg, ${viridis.map((c) => `rgb(${c})`).join(", ")})`;

  // --- The wheel loaded -------------------------------------------------------------------------------

  function bytes(text) {
    return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  }

  // The mesh of sector 0 and the fields of all sectors, as one mesh of the whole wheel.
  function wheelMesh(run) {
    const { fields, sectors } = run;
    const points = new Float32Array(bytes(fields.points).buffer);
    const triangles = new Uint32Array(bytes(fields.triangles).buffer);
    const n = points.length / 2;
    const places = new Float32Array(2 * n * sectors), corners = new Uint32Array(triangles.length * sectors);
    for (let s = 0; s < sectors; ++s) {
      const c = Math.cos(2 * Math.PI * s / sectors), d = Math.sin(2 * Math.PI * s / sectors);
      for (let k = 0; k < n; ++k) {
        places[2 * (s * n + k)] = c * points[2 * k] - d * points[2 * k + 1];
        places[2 * (s * n + k) + 1] = d * points[2 * k] + c * points[2 * k + 1];
      }
      for (let k = 0; k < triangles.length; ++k) corners[s * triangles.length + k] = triangles[k] + s * n;
    }
    const positions = fields.positions.map((p) => ({
      azimuth: p.azimuth_rad,
      x: new Int16Array(bytes(p.x).buffer), y: new Int16Array(bytes(p.y).buffer), stress: bytes(p.root_of_stress),
    }));
    return { places, corners, positions };
  }

  const vertexShader = `
    attribute vec2 place; attribute float dx, dy, stress;
    uniform float magnified, scale; uniform vec2 turn;
    varying float value;
    void main() {
      vec2 p = place + magnified * vec2(dx, dy);
      gl_Position = vec4(scale * vec2(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y), 0.0, 1.0);
      value = stress;
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

  // Draws the wheel with the ground below: a function of the position and the magnification.
  function wheelPainter(canvas, run) {
    const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
    if (!gl || !gl.getExtension("OES_element_index_uint")) return null;
    const mesh = wheelMesh(run), p = program(gl);
    gl.useProgram(p);
    const attribute = (name, content, size, type, normalized) => {
      const place = gl.getAttribLocation(p, name), made = buffer(gl, gl.ARRAY_BUFFER, content);
      return () => {
        gl.bindBuffer(gl.ARRAY_BUFFER, made);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
      };
    };
    const corners = buffer(gl, gl.ELEMENT_ARRAY_BUFFER, mesh.corners);
    const places = attribute("place", mesh.places, 2, gl.FLOAT, false);
    const fields = mesh.positions.map((position) => [
      attribute("dx", position.x, 1, gl.SHORT, true), attribute("dy", position.y, 1, gl.SHORT, true),
      attribute("stress", position.stress, 1, gl.UNSIGNED_BYTE, true)]);
    const texture = gl.createTexture(), ramp = new Uint8Array(4 * 256);
    for (let k = 0; k < 256; ++k) {
      const at = k / 255 * (viridis.length - 1), low = Math.min(Math.floor(at), viridis.length - 2);
      for (let c = 0; c < 3; ++c) ramp[4 * k + c] = viridis[low][c] + (at - low) * (viridis[low + 1][c] - viridis[low][c]);
      ramp[4 * k + 3] = 255;
    }
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, ramp);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    const uniform = (name) => gl.getUniformLocation(p, name);
    const full = run.fields.full_displacement_m;
    return (index, magnified) => {
      const size = Math.min(1200, Math.round(canvas.clientWidth * (window.devicePixelRatio || 1))) || 600;
      if (canvas.width !== size) canvas.width = canvas.height = size;
      gl.viewport(0, 0, size, size);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      places();
      for (const bind of fields[index]) bind();
      const turn = -Math.PI / 2 - mesh.positions[index].azimuth;  // the ground's azimuth points down
      gl.uniform2f(uniform("turn"), Math.cos(turn), Math.sin(turn));
      gl.uniform1f(uniform("magnified"), magnified * full);
      gl.uniform1f(uniform("scale"), 0.9 / run.outer_radius_m);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, corners);
      gl.drawElements(gl.TRIANGLES, mesh.corners.length, gl.UNSIGNED_INT, 0);
    };
  }

  // The ground, flat and solid. Near the contact, magnified displacements take the tread a little below it.
  function drawGround(canvas, run) {
    const size = canvas.width = canvas.height = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1)) || 600;
    const context = canvas.getContext("2d"), level = 0.95 * size, step = size / 60;
    context.fillStyle = colour("--panel");
    context.fillRect(0, level, size, size - level);
    context.strokeStyle = colour("--ink");
    context.lineWidth = size / 300;
    context.beginPath();
    context.moveTo(0, level);
    context.lineTo(size, level);
    context.stroke();
    context.lineWidth /= 2;
    context.beginPath();
    for (let x = 0; x < size + step; x += step) {
      context.moveTo(x, level);
      context.lineTo(x - step, level + step);
    }
    context.stroke();
  }

  const roundMagnification = (wanted) => {
    const power = 10 ** Math.floor(Math.log10(wanted));
    return Math.max(1, [1, 2, 5, 10].map((m) => m * power).filter((m) => m <= wanted * 1.0001).pop());
  };

  // --- The wheel as it is cut -------------------------------------------------------------------------

  // Edges as a path: closed polylines with x and y in turn, y pointing up, each `copies` times round the axle.
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

  // The material between rim, tread and edges; the axle is the origin of the context.
  function paintWheel(context, edges, inner, outer) {
    const wheel = new Path2D(edges);
    for (const r of [outer, inner]) {
      wheel.moveTo(r, 0);
      wheel.arc(0, 0, r, 0, 2 * Math.PI);
    }
    context.fillStyle = colour("--material");
    context.fill(wheel, "evenodd");
    context.strokeStyle = colour("--ink");
    context.stroke(wheel);
  }

  // --- Curves -----------------------------------------------------------------------------------------

  function chart(title, xTitle, yTitle, curves, options = {}) {
    const canvas = element("canvas", { role: "img", "aria-label": title });
    const figure = element("figure", {}, element("figcaption", {}, title), element("div", { class: "chart" }, canvas));
    const data = (of) => of.map(({ name, x, y }, k) => ({
      label: name, data: x ? x.map((value, i) => ({ x: value, y: y[i] })) : y,
      borderColor: curveColours[k % curveColours.length], backgroundColor: options.colours ??
        curveColours[k % curveColours.length], borderWidth: options.bars ? 0 : 2,
      pointRadius: y.length > 30 ? 0 : 2.5, pointHitRadius: 8 }));
    let drawn = null;
    const start = () => {
      const axis = (text) => ({ title: { display: true, text, color: colour("--quiet") },
        ticks: { color: colour("--quiet") }, grid: { color: colour("--line") } });
      drawn = new Chart(canvas, {
        type: options.bars ? "bar" : "line",
        data: { labels: options.labels, datasets: data(curves) },
        options: { animation: false, responsive: true, maintainAspectRatio: false, interaction: { mode: "nearest",
          intersect: false }, scales: { x: { ...(options.bars ? {} : { type: "linear" }), ...axis(xTitle) },
          y: { ...axis(yTitle), ...options.y } }, plugins: { legend: { display: curves.length > 1, labels: { color: colour("--ink") } } } },
      });
    };
    // Other curves, of the same kinds.
    const update = (of) => {
      data(of).forEach((dataset, k) => {
        if (drawn.data.datasets[k]) Object.assign(drawn.data.datasets[k], dataset);
        else drawn.data.datasets.push(dataset);
      });
      drawn.data.datasets.length = of.length;
      drawn.update("none");
    };
    // In the colours that hold now.
    const recolour = () => {
      drawn?.destroy();
      start();
    };
    return { figure, start, update, recolour };
  }

  return { colour, curveColours, degree, element, shown, change, minutes, viridis, gradient, bytes, wheelPainter,
    drawGround, roundMagnification, wheelPath, paintWheel, chart };
})();
