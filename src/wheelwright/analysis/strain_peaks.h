#pragma once

#include <array>

#include "wheelwright/state/state.h"

namespace wheelwright {

/// The largest values of every load position, over the quadrature points of the material. The tread is seen
/// through the nodes of the level set's grid, without its refinement.
template <int dim>
struct StrainPeaks {
  std::vector<double> von_mises;           ///< stress [Pa]
  std::vector<Vec<dim>> von_mises_places;  ///< where they are: polar coordinates of the body (m, rad, m)
  std::vector<double> principal;           ///< absolute value of a principal strain
};

template <int dim>
StrainPeaks<dim> strain_peaks(const StateSolver<dim>& solver, const State<dim>& state,
                              const Displacement<dim>& displacement);

/// The same where nothing else asks for the displacement.
template <int dim>
StrainPeaks<dim> strain_peaks(const StateSolver<dim>& solver, const State<dim>& state) {
  return strain_peaks<dim>(solver, state, *state.displacement());
}

/// The principal strains; `strain`: n_strains entries, shear strains as angles. When dim = 2, the one along
/// the axle is `axial_strain_ratio` times the trace in the plane.
template <int dim>
std::array<double, 3> principal_strains(const double* strain, double axial_strain_ratio);

}  // namespace wheelwright
