#pragma once

#include <optional>
#include <span>
#include <vector>

namespace wheelwright {

/// What a number is made of, and with it how regularly it converges.
enum class Converges {
  as_an_integral,  ///< an average over many points
  /// The extreme of single points or places, such as a peak or an edge of the contact: from grid to grid it
  /// moves by parts of a cell. And small differences of such numbers, such as the run-out.
  as_an_extreme,
  /// A power of such an extreme, positive, as a life: it varies by factors, and its error is that of its
  /// logarithm.
  as_a_power,
};

/// The factor by which the estimate exceeds the error of a number that converges with the first order. With
/// these, 95 of 100 errors of random wheels are within their estimates (docs/verification.md).
constexpr double error_safety(Converges how) { return how == Converges::as_an_integral ? 2 : 4; }

/// The estimate of the discretization error |q - exact q| of a number from its value on a finer grid, whose
/// cells are smaller by the factor r > 1: safety |q - q_fine| / (1 - 1/r). Without the factor it is exact for
/// errors proportional to the size of the cells, and too large if they fall faster. The error of a power is q
/// (f - 1), where f is the factor, estimated from the logarithms, by which the exact one is at most smaller
/// or larger.
double discretization_error(double value, double on_finer_grid, double refinement,
                            Converges how = Converges::as_an_integral);

/// The same for the number on the finer grid: smaller by the factor r, as errors of the first order are.
double error_on_finer_grid(double value, double on_finer_grid, double refinement,
                           Converges how = Converges::as_an_integral);

/// All numbers of a wheel come from the same displacements. Where a number happens to be nearly the same on
/// both grids, its relative error is still at least this share of the largest one of travel, stiffness and
/// strain energy.
constexpr double least_share_of_error = 0.05;

/// The estimates of values at load positions that divide one sector. The error at one position changes its
/// sign from cell to cell, and may happen to be small on both grids; therefore each estimate is at least that
/// of the root of the mean square difference of all positions.
std::vector<double> discretization_errors(std::span<const double> values,
                                          std::span<const double> on_finer_grid, double refinement,
                                          Converges how = Converges::as_an_integral);

/// The order p of convergence observed on three grids, each finer than the one before by the factor r:
/// differences fall by r^p. Negative if they grow; nothing if two of the values are equal.
std::optional<double> observed_order(double coarse, double middle, double fine, double refinement);

/// Below this order a number does not visibly converge: peaks at corners, where the exact stress has no
/// bound, grow with every finer grid.
inline constexpr double minimum_order = 0.25;

}  // namespace wheelwright
