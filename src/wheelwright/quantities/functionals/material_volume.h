#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// The measure of the material of one sector, int_Omega 1 dx [m^2, or m^3 when dim = 3]. It does not depend
/// on the load position. Its shape derivative has the density 1 (45).
template <int dim>
class MaterialVolume : public Functional<dim> {
 public:
  std::string name() const override { return "volume"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }
  double of_small_hole(const PolarGrid<dim>&, const Vec<dim>&, double) const override { return -1; }
};

}  // namespace wheelwright
