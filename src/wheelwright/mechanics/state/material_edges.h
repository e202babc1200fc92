#pragma once

#include <optional>

#include "wheelwright/base/expected.h"
#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Where two edges cross: their points in the undeformed wheel, body frame [m].
template <int dim>
struct EdgeCrossing {
  Vec<dim> on_one, on_other;
  double share;  ///< of the displacement, or of its growth, at which the edges meet first
};

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

  /// Where edges meet first as displacements grow in proportion from `from`, where none cross, to `to`;
  /// nothing if none cross there.
  std::optional<EdgeCrossing<dim>> first_crossing(const RingField& from, const RingField& to) const;
  /// The same from rest.
  std::optional<EdgeCrossing<dim>> first_crossing(const RingField& to) const;

  /// A point of an edge, with the nodes of its cell and the values of their shape functions.
  struct Point {
    Vec<dim> x;  ///< undeformed, body frame [m]
    RingCellNodes<dim> nodes;
    std::array<double, ShapeFunctions<dim>::max_nodes> shape;
  };

 private:
  /// A crossing under a displacement, which is its share 1.
  std::optional<EdgeCrossing<dim>> crossing(const RingField& u) const;

  int nodes_per_cell_;
  std::vector<std::vector<Point>> edges_;
};

/// Travels of the rim, by the thickness of the ring, below which edges cannot meet.
inline constexpr double smallest_travel_of_overlap = 0.05;

/// The failure of a wheel whose edges overlap at a travel of the rim, by the thickness of the ring. `load`:
/// at which they meet first, where it is known [N/m].
template <int dim>
Failure overlap_failure(double travel, const EdgeCrossing<dim>& place, std::optional<double> load = {});

}  // namespace wheelwright
