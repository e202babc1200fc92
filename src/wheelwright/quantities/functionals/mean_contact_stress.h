#pragma once

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The mean over the load positions of what the tread observes at a fixed place of the ground frame: p_mean
/// (73) in its traction rows. One column per ring column, counted from the one at the ground position;
/// components in the columns' own frames, which turn with the ground. The other sectors of the wheel do not
/// change it: the fields in their positions are the same. Positions between columns are interpolated
/// (ColumnShift).
template <int dim>
Matrix mean_observations(const TreadSurface<dim>& tread, const State<dim>& state);

/// The same mean of given observations, in the layout of State::observations().
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

/// The derivative of sum_i m_i J_i(d_i), with m_i the multiplicities and d_i the deviations of all positions
/// from their own mean: changes loads on the deviations into loads on the observations, both in the layout of
/// State::observations() and per position that each represents. When all positions stand on columns and the
/// loads sum to zero over them, turned into the ground's frame, nothing changes.
template <int dim>
void add_derivative_of_mean(const TreadSurface<dim>& tread, const LoadPositions& positions, Matrix& loads);

}  // namespace wheelwright
