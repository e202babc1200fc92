#pragma once

#include "wheelwright/mechanics/elasticity/voigt.h"

namespace wheelwright {

/// e:e - (tr e)^2 / 3, the square of the strain's deviator, and its derivative with respect to the strain
/// (engineering shear strains): the von Mises stress is mu sqrt(6) times its root. When dim = 2, e_33 is
/// `axial_strain_ratio` times the trace in the plane.
template <int dim>
struct SquaredDeviator {
  SquaredDeviator(const double* strain, double axial_strain_ratio) : strain_(strain) {
    double in_plane = 0;
    for (int k = 0; k < dim; ++k) {
      in_plane += strain[k];
      value += strain[k] * strain[k];
    }
    const double axial = dim == 2 ? axial_strain_ratio * in_plane : 0, trace = in_plane + axial;
    value += axial * axial - trace * trace / 3;
    for (int k = dim; k < n_strains<dim>; ++k) value += 0.5 * strain[k] * strain[k];
    by_trace_ = dim == 2 ? 2 * axial_strain_ratio * axial - 2.0 / 3 * (1 + axial_strain_ratio) * trace
                         : -2.0 / 3 * trace;
  }

  Voigt<dim> by_strain() const {
    Voigt<dim> slopes;
    for (int k = 0; k < n_strains<dim>; ++k) slopes[k] = k < dim ? 2 * strain_[k] + by_trace_ : strain_[k];
    return slopes;
  }

  double value = 0;

 private:
  const double* strain_;
  double by_trace_;
};

}  // namespace wheelwright
