#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/surface/fine_lattice.h"

namespace wheelwright {

/// The part of the boundary on which a triangle lies.
enum class SurfacePart : std::uint8_t { rim, tread, side, hole };

/// The closed surface of the material of the full ring, by triangles whose corners run counter-clockwise when
/// seen from outside. The vertices of sector 0 come first, then those of sector 1 and so on, in the same
/// order.
struct SurfaceMesh {
  int n_sectors;
  std::vector<CellPoint> places;  ///< of the vertices of sector 0, on the grid
  std::vector<Vec<3>> points;     ///< of all vertices, Cartesian [m], body frame; z from 0 to the width
  std::vector<std::array<int, 3>> triangles;
  std::vector<SurfacePart> parts;  ///< of every triangle

  int sector_points() const { return static_cast<int>(places.size()); }
};

/// The surface of {psi < 0} with rim, tread and side faces. Every cell is divided into parts^3 cubes, these
/// into tetrahedra, on which psi is taken to be linear; the places are those of isoparametric cells of degree
/// `map_degree`. Vertices are nodes and edges of this division, not numbers that are compared: the surface is
/// closed and a manifold whatever the values of psi are. Its volume converges to that of the level set with
/// the order 2 in 1 / parts.
SurfaceMesh material_surface(const LevelSet<3>& psi, int parts, int map_degree);

/// Enclosed volume [m^3], and area [m^2], of the whole surface or of one of its parts.
double enclosed_volume(const SurfaceMesh& mesh);
double surface_area(const SurfaceMesh& mesh);
double surface_area(const SurfaceMesh& mesh, SurfacePart part);

}  // namespace wheelwright
