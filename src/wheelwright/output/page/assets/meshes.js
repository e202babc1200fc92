"use strict";
// Meshes of the whole wheel, from the mesh of sector 0 and the fields of all sectors. Arrays come as base64.
const meshes = (() => {
  function bytes(text) {
    return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  }

  // The plane wheel: two coordinates per vertex, three vertices per triangle.
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

  const surfacePositions = (fields) => fields.positions.map((p) => ({
    azimuth: p.azimuth_rad, stress: bytes(p.root_of_stress),
    displacement: [p.x, p.y, p.z].map((text) => new Int16Array(bytes(text).buffer)),
  }));

  // The vertices of all sectors of a wheel in 3D; the axial coordinate is measured from the middle of the width.
  function surfacePlaces(points, sectors, width) {
    const n = points.length / 3, places = new Float32Array(points.length * sectors);
    for (let s = 0; s < sectors; ++s) {
      const c = Math.cos(2 * Math.PI * s / sectors), d = Math.sin(2 * Math.PI * s / sectors);
      for (let k = 0; k < n; ++k) {
        const x = points[3 * k], y = points[3 * k + 1];
        places.set([c * x - d * y, d * x + c * y, points[3 * k + 2] - width / 2], 3 * (s * n + k));
      }
    }
    return places;
  }

  // The surface of a wheel in 3D. Rim, tread, side faces and holes have separate vertices where they meet, so that the
  // edges between them are sharp: `sources` contains the original vertices.
  function wheelSurface(run) {
    const { fields, sectors } = run;
    const points = new Float32Array(bytes(fields.points).buffer);
    const triangles = new Uint32Array(bytes(fields.triangles).buffer), parts = bytes(fields.parts);
    const n = points.length / 3, places = surfacePlaces(points, sectors, run.width_m);
    const known = new Map(), sources = [], corners = new Uint32Array(triangles.length * sectors);
    for (let s = 0; s < sectors; ++s)
      for (let k = 0; k < triangles.length; ++k) {
        const vertex = (triangles[k] + s * n) % (n * sectors), key = 4 * vertex + parts[Math.floor(k / 3)];
        if (!known.has(key)) {
          known.set(key, sources.length);
          sources.push(vertex);
        }
        corners[s * triangles.length + k] = known.get(key);
      }
    return { places, sources, corners, positions: surfacePositions(fields) };
  }

  // The edges of the holes on the side faces, as consecutive pairs of points.
  function holeEdges(run) {
    const { fields, sectors } = run;
    const places = surfacePlaces(new Float32Array(bytes(fields.points).buffer), sectors, run.width_m);
    const triangles = new Uint32Array(bytes(fields.triangles).buffer), parts = bytes(fields.parts), n = places.length / 3;
    const sides = (part, visit) => {
      for (let s = 0; s < sectors; ++s)
        for (let k = 0; k < triangles.length; ++k) {
          if (parts[Math.floor(k / 3)] !== part) continue;
          const next = k % 3 === 2 ? k - 2 : k + 1;
          const ends = [k, next].map((corner) => (triangles[corner] + s * n / sectors) % n);
          visit(ends, Math.min(...ends) * n + Math.max(...ends));
        }
    };
    const ofHoles = new Set(), edges = [];
    sides(3, (ends, key) => ofHoles.add(key));
    sides(2, (ends, key) => {
      if (ofHoles.has(key)) for (const vertex of ends) edges.push(...places.subarray(3 * vertex, 3 * vertex + 3));
    });
    return new Float32Array(edges);
  }

  // The edges between layers of materials in all sectors, as consecutive pairs of vertices of the whole wheel.
  function layerEdges({ fields, sectors }) {
    if (!fields.layer_edges) return new Uint32Array(0);
    const edges = new Uint32Array(bytes(fields.layer_edges).buffer);
    const n = bytes(fields.points).length / (fields.is_surface ? 12 : 8), all = new Uint32Array(edges.length * sectors);
    for (let s = 0; s < sectors; ++s)
      for (let k = 0; k < edges.length; ++k) all[s * edges.length + k] = (edges[k] + s * n) % (n * sectors);
    return all;
  }

  // What the colours can represent: a fraction in [0, 1] at a vertex, and the value at the end of the scale.
  function colourings({ full_stress_Pa, full_displacement_m }, positions) {
    const size = ({ displacement }, v) => Math.hypot(...displacement.map((d) => d[v])) / 32767;
    const most = Math.max(...positions.map((position) => {
      let largest = 0;
      for (let v = 0; v < position.stress.length; ++v) largest = Math.max(largest, size(position, v));
      return largest;
    }));
    return {
      stress: { name: "von Mises stress, on a scale of square roots", end: full_stress_Pa * 1e-6, unit: "MPa", power: 2,
        share: (position, v) => position.stress[v] / 255 },
      displacement: { name: "displacement", end: most * full_displacement_m * 1e3, unit: "mm", power: 1,
        share: (position, v) => most > 0 ? size(position, v) / most : 0 },
    };
  }

  return { bytes, wheelMesh, wheelSurface, surfacePositions, holeEdges, layerEdges, colourings };
})();
