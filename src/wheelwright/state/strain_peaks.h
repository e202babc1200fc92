#pragma once

#include <array>

#include "wheelwright/state/state.h"

namespace wheelwright {

/// Computes State::strain_peaks(), which remembers them.
template <int dim>
StrainPeaks<dim> strain_peaks(const StateSolver<dim>& solver, const State<dim>& state);

/// The principal strains; `strain`: n_strains entries, shear strains as angles. When dim = 2, the one along
/// the axle is `axial_strain_ratio` times the trace in the plane.
template <int dim>
std::array<double, 3> principal_strains(const double* strain, double axial_strain_ratio);

}  // namespace wheelwright
