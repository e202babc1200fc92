#pragma once

#include <array>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The peaks in every layer of the model's materials, from the rim to the tread.
template <int dim>
std::vector<StrainPeaks<dim>> strain_peaks_by_layer(const StateSolver<dim>& solver, const State<dim>& state);

/// Computes State::strain_peaks(), which remembers them: the largest of all layers.
template <int dim>
StrainPeaks<dim> strain_peaks(const StateSolver<dim>& solver, const State<dim>& state);

/// The principal strains; `strain`: n_strains entries, shear strains as angles. When dim = 2, one of
/// them is the given strain along the axle.
template <int dim>
std::array<double, 3> principal_strains(const double* strain, double axial_strain);

}  // namespace wheelwright
