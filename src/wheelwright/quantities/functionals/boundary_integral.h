#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// int_Gamma_m N(x) ds (46) over the moving boundary of one sector. It does not depend on the load position;
/// N is the same in all sectors. By (42) and (47) its shape derivative has the density kappa_m N + grad N .
/// n, with kappa_m the mean curvature. This is the derivative for a smooth boundary: it leaves out the kinks
/// of the level set's boundary on the faces of cells, which are O(h^2).
template <int dim>
class BoundaryIntegral : public Functional<dim> {
 public:
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }
  /// A circle has the length 2 / radius per area, a sphere the area 3 / radius per volume.
  double of_small_hole(const PolarGrid<dim>&, const Vec<dim>& x, double radius) const override {
    return densities(std::span(&x, 1)).front().value * dim / radius;
  }

 protected:
  struct Density {
    double value;       ///< N
    Vec<dim> gradient;  ///< grad N
  };

 private:
  double integral(const CutDomain<dim>& domain, int map_degree) const;

  /// N at points, Cartesian, in the body frame [m]. Derived classes implement it, or density().
  virtual std::vector<Density> densities(std::span<const Vec<dim>> points) const;
  virtual Density density(const Vec<dim>&) const { return {}; }
};

}  // namespace wheelwright
