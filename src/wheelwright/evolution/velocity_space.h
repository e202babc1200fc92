#pragma once

#include <span>
#include <vector>

#include "wheelwright/geometry/level_set.h"
#include "wheelwright/linalg/sparse_spd.h"

namespace wheelwright {

/// Velocities along the outward normal, at the nodes of the lattice, that vanish at some of them; with the
/// inner product (u, v) = int length^2 grad u . grad v + u v over one sector. A load is a linear function of
/// the velocity, one value per node.
template <int dim>
class VelocitySpace {
 public:
  /// `fixed`: the nodes where velocities vanish.
  VelocitySpace(const Lattice<dim>& lattice, std::vector<bool> fixed, double length);

  /// The velocity v with (v, w) = load . w for all velocities w.
  std::vector<double> representative(std::span<const double> load) const;

  /// The load l with l . w = (velocity, w) for all velocities w.
  std::vector<double> load(std::span<const double> velocity) const;

  /// The velocity, or the load, with zeros at the fixed nodes.
  std::vector<double> restricted(std::vector<double> nodal) const;

  /// A space whose velocities vanish at these nodes too.
  VelocitySpace with_held(const std::vector<bool>& held) const;

 private:
  Lattice<dim> lattice_;
  std::vector<bool> fixed_;
  double length_;
  std::vector<SparseSpd::Entry> form_;  ///< lower triangle, without fixed nodes
  SparseSpd factor_;
};

}  // namespace wheelwright
