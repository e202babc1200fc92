#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/surface/tetrahedra.h"

namespace wheelwright {

/// A place in a cell of a sector's grid, or of the ring if cell[1] counts columns around it.
struct CellPoint {
  std::array<int, 3> cell;
  Vec<3> xi;  ///< in the unit cell
};

/// The corners of the cubes into which a sector's cells are divided: `parts` along each axis of every cell.
/// Nodes of the first azimuth of the next sector belong to it too. A node is material where psi < 0; where
/// psi is exactly 0 it is not.
class FineLattice {
 public:
  /// Places are those of isoparametric cells of degree `map_degree`.
  FineLattice(const LevelSet<3>& psi, int parts, int map_degree);

  const PolarGrid<3>& grid() const { return grid_; }
  int parts() const { return parts_; }
  /// Number of cubes along each axis.
  const std::array<int, 3>& cubes() const { return cubes_; }

  using Position = std::array<int, 3>;

  /// The node on each corner of the cube at a position.
  std::array<Position, 8> corners(const Position& cube) const;

  /// The tetrahedra of that cube. They are mirror-symmetric in azimuth and in z if the numbers of cubes are
  /// even.
  std::array<Tetrahedron, 6> tetrahedra(const Position& cube) const;

  double psi(const Position& node) const { return values_[index_in_sector(node)]; }
  bool is_material(const Position& node) const { return psi(node) < 0; }

  /// Cartesian [m], in the frame of the sector.
  Vec<3> place(const Position& node) const;

  /// A number of the node, the same for a node and its image at the first azimuth of the next sector.
  int index_in_sector(const Position& node) const;

  /// The crossing of the boundary with the edge between two nodes of a cube: a fraction in (0, 1) of the way
  /// from the material `inside` to `outside`. It keeps a distance of 1/256 from both nodes, so that no
  /// triangle that ends there has the area 0.
  double crossing(const Position& inside, const Position& outside) const;

  /// The cell that contains both ends of an edge, and the place in it at a fraction of the way between them.
  CellPoint point(const Position& a, const Position& b, double share) const;

 private:
  PolarGrid<3> grid_;
  int parts_;
  std::array<int, 3> cubes_;
  std::vector<double> values_;
  std::vector<Vec<3>> places_;  ///< of the nodes of one sector
};

}  // namespace wheelwright
