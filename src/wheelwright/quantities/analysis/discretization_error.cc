#include "wheelwright/quantities/analysis/discretization_error.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {

namespace {

/// Of a power: the error of its logarithm.
double error_of_logarithm(double value, double on_finer_grid, double refinement) {
  return discretization_error(std::log(value), std::log(on_finer_grid), refinement, Converges::as_an_extreme);
}

}  // namespace

double discretization_error(double value, double on_finer_grid, double refinement, Converges how) {
  if (how == Converges::as_a_power)
    return value * std::expm1(error_of_logarithm(value, on_finer_grid, refinement));
  return error_safety(how) * std::abs(value - on_finer_grid) / (1 - 1 / refinement);
}

double error_on_finer_grid(double value, double on_finer_grid, double refinement, Converges how) {
  if (how == Converges::as_a_power)
    return on_finer_grid * std::expm1(error_of_logarithm(value, on_finer_grid, refinement) / refinement);
  return discretization_error(value, on_finer_grid, refinement, how) / refinement;
}

std::vector<double> discretization_errors(std::span<const double> values,
                                          std::span<const double> on_finer_grid, double refinement,
                                          Converges how) {
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    squares += (values[i] - on_finer_grid[i]) * (values[i] - on_finer_grid[i]);
  const double usual = std::sqrt(squares / static_cast<double>(values.size()));
  const double minimum = discretization_error(usual, 0, refinement, how);
  std::vector<double> errors;
  for (std::size_t i = 0; i < values.size(); ++i)
    errors.push_back(std::max(minimum, discretization_error(values[i], on_finer_grid[i], refinement, how)));
  return errors;
}

std::optional<double> observed_order(double coarse, double middle, double fine, double refinement) {
  const double first = std::abs(middle - coarse), second = std::abs(fine - middle);
  if (!(first > 0 && second > 0)) return {};
  return std::log(first / second) / std::log(refinement);
}

}  // namespace wheelwright
