#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// The mass of the whole ring [kg per metre of width when dim = 2, kg when dim = 3]. It does not depend on
/// the load position.
template <int dim>
class Mass : public Functional<dim> {
 public:
  /// `density` [kg/m^3].
  explicit Mass(double density) : density_(density) {}

  std::string name() const override { return "mass"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }
  double of_small_hole(const PolarGrid<dim>& grid, const Vec<dim>&, double) const override {
    return -density_ * grid.n_sectors;
  }

 private:
  double density_;
};

}  // namespace wheelwright
