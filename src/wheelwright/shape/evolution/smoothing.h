#pragma once

#include "wheelwright/linalg/sparse_spd.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The smoothing step (76): returns the minimizer phi of int (phi - psi)^2 / 2 + tau |grad phi|^2 / 2 over
/// the sector.
template <int dim>
class Smoother {
 public:
  /// `length` = sqrt(tau) [m]; shorter waves are damped.
  Smoother(const Lattice<dim>& lattice, double length);

  LevelSet<dim> operator()(const LevelSet<dim>& psi) const;

 private:
  std::vector<SparseSpd::Entry> mass_;
  SparseSpd factor_;
};

}  // namespace wheelwright
