#pragma once

#include <array>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// Computes State::strain_peaks(), which remembers them.
template <int dim>
StrainPeaks<dim> strain_peaks(const StateSolver<dim>& solver, const State<dim>& state);

/// The principal strains; `strain`: n_strains entries, shear strains as angles. When dim = 2, one of
/// them is the given strain along the axle.
template <int dim>
std::array<double, 3> principal_strains(const double* strain, double axial_strain);

}  // namespace wheelwright
