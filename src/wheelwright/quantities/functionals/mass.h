#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// The mass of a shape by its volume [kg/m^3]; nothing if a layer has no density.
template <int dim>
std::optional<double> mean_density(const Materials<dim>& materials, const LevelSet<dim>& psi);

/// The mass of the whole ring [kg per metre of width when dim = 2, kg when dim = 3], in which a layer without
/// a density does not count. It does not depend on the load position. The density of its shape derivative is
/// that of the material at the boundary, times the number of sectors.
template <int dim>
class Mass : public Functional<dim> {
 public:
  explicit Mass(Materials<dim> materials) : materials_(std::move(materials)) {}

  std::string name() const override { return "mass"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }
  double of_small_hole(const PolarGrid<dim>& grid, const Vec<dim>& x, double) const override {
    return -materials_.at_radius(std::hypot(x[0], x[1])).density().value_or(0) * grid.n_sectors;
  }

 private:
  Materials<dim> materials_;
};

}  // namespace wheelwright
