#pragma once

#include <array>
#include <vector>

namespace wheelwright {

/// Four corners of a cube, or of a tetrahedron of one. Corner c of a cube is at (c & 1, c >> 1 & 1, c >> 2 &
/// 1). The vectors from the first corner to the other three are right-handed.
using Tetrahedron = std::array<int, 4>;

/// Kuhn's division of a cube into six tetrahedra along a diagonal of the cube, reflected along some axes. The
/// diagonal of each face depends on the reflections along the other two axes. Therefore cubes of a lattice
/// fit together if each reflection depends only on the position along its own axis.
std::array<Tetrahedron, 6> tetrahedra_of_cube(const std::array<bool, 3>& reflected);

/// The corners of the face opposite to each corner; seen from outside they run counter-clockwise.
std::array<std::array<int, 3>, 4> faces(const Tetrahedron& tetrahedron);

/// A corner of the part of a simplex that is material: the node `first`, or where the boundary crosses the
/// edge from `first` to `second`.
struct ClippedCorner {
  int first, second;

  bool operator==(const ClippedCorner&) const = default;
  bool is_node() const { return first == second; }
};

/// A triangle, or a quadrilateral.
using ClippedPolygon = std::vector<ClippedCorner>;

/// Where the boundary of the material crosses a tetrahedron: nothing, a triangle or a quadrilateral, counter-
/// clockwise when seen from outside of the material. `is_material`: of each corner of the cube.
ClippedPolygon boundary_in(const Tetrahedron& tetrahedron, const std::array<bool, 8>& is_material);

/// The part of a triangle that is material, with the same sense of rotation.
ClippedPolygon material_of(const std::array<int, 3>& triangle, const std::array<bool, 8>& is_material);

/// The part of a tetrahedron that is material: nothing, a tetrahedron (4 corners) or a wedge (6 corners, two
/// triangles whose corners correspond; the first triangle is clockwise when seen from the second).
ClippedPolygon material_of(const Tetrahedron& tetrahedron, const std::array<bool, 8>& is_material);

}  // namespace wheelwright
