#pragma once

#include "wheelwright/state/state.h"

namespace wheelwright {

/// The mean over the load positions of what the tread observes at a fixed place of the ground frame: p_mean
/// (73) in its traction rows. One column per ring column, counted from the one at the ground position;
/// components in the columns' own frames, which turn with the ground. The other sectors of the wheel do not
/// change it: the fields in their positions are the same.
template <int dim>
Matrix mean_observations(const TreadSurface<dim>& tread, const State<dim>& state);

/// The same mean of other numbers with the layout of observations, such as loads.
template <int dim>
Matrix mean_over_positions(const TreadSurface<dim>& tread, const LoadPositions& positions,
                           const Matrix& observations);

/// Whether a mean, of whatever shape, is its own mirror image, up to 1e-8 of its largest entry.
template <int dim>
bool is_mirror_symmetric(const TreadSurface<dim>& tread, const Matrix& mean);

/// Observations minus a mean, in the layout of State::observations() (body frame).
template <int dim>
Matrix deviation_from_mean(const TreadSurface<dim>& tread, const LoadPositions& positions,
                           Matrix observations, const Matrix& mean);

}  // namespace wheelwright
