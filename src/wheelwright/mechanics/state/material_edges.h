#pragma once

#include "wheelwright/base/expected.h"
#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The edges of holes and tread, as closed polylines of two pieces per cell and axis that displacements move.
/// Only 2D; in 3D there are none.
template <int dim>
class MaterialEdges {
 public:
  /// `lattice`: that of the displacements.
  MaterialEdges(const LevelSet<dim>& psi, const Lattice<dim>& lattice);

  /// Whether the edges cross each other or themselves where a displacement takes them. `u`: as
  /// Displacement::at_nodes() gives it.
  bool overlap(const RingField& u) const;

  /// A point of an edge, with the nodes of its cell and the values of their shape functions.
  struct Point {
    Vec<dim> x;  ///< undeformed, body frame [m]
    RingCellNodes<dim> nodes;
    std::array<double, ShapeFunctions<dim>::max_nodes> shape;
  };

 private:
  int nodes_per_cell_;
  std::vector<std::vector<Point>> edges_;
};

/// Travels of the rim, by the thickness of the ring, below which edges cannot meet.
inline constexpr double smallest_travel_of_overlap = 0.05;

/// The failure of a wheel whose edges overlap at a travel of the rim, by the thickness of the ring.
Failure overlap_failure(double travel);

}  // namespace wheelwright
