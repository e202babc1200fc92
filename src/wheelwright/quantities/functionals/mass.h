#pragma once

#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"

namespace wheelwright {

/// The mass of the whole ring or of a part of it [kg per metre of width when dim = 2, kg when dim = 3], in
/// which a layer without a density does not count. It does not depend on the load position. The density of
/// its shape derivative is that of the material at the boundary, times the number of sectors.
template <int dim>
class Mass : public Functional<dim> {
 public:
  explicit Mass(Materials<dim> materials, std::optional<PartOfRing> part = {})
      : materials_(std::move(materials)), part_(std::move(part)) {}

  std::string name() const override { return of_part("mass", part_); }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }
  double of_small_hole(const PolarGrid<dim>& grid, const Vec<dim>& x, double) const override {
    const double radius = std::hypot(x[0], x[1]);
    if (part_ && !part_->has_radius(radius)) return 0;
    return -materials_.at_radius(radius).density().value_or(0) * grid.n_sectors;
  }

 private:
  Materials<dim> materials_;
  std::optional<PartOfRing> part_;
};

}  // namespace wheelwright
