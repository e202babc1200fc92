#pragma once

#include <span>

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// A traction that every column of the tread observes, and its weight in an integral.
struct WeightedTraction {
  int row;  ///< of its first component in ObservationRows
  double weight;
};

/// The sum over all columns and these tractions of weight/2 |sigma(u)n - p_mean|^2, by position, with the
/// loads (63) that are minus its derivative.
template <int dim>
FunctionalValue<dim> squared_deviation(const TreadSurface<dim>& tread, const State<dim>& state,
                                       const Matrix& mean, std::span<const WeightedTraction> tractions);

}  // namespace wheelwright
