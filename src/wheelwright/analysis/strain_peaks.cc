#include "wheelwright/analysis/strain_peaks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wheelwright {
namespace {

/// e:e - (tr e)^2 / 3, the square of the strain's deviator: the von Mises stress is mu sqrt(6) times its
/// root. When dim = 2, e_33 is `axial_strain_ratio` times the trace in the plane.
template <int dim>
double squared_deviator(const double* strain, double axial_strain_ratio) {
  double trace = 0, square = 0;
  for (int k = 0; k < dim; ++k) {
    trace += strain[k];
    square += strain[k] * strain[k];
  }
  if constexpr (dim == 2) {
    const double axial = axial_strain_ratio * trace;
    trace += axial;
    square += axial * axial;
  }
  for (int k = dim; k < n_strains<dim>; ++k) square += 0.5 * strain[k] * strain[k];
  return square - trace * trace / 3;
}

}  // namespace

template <>
std::array<double, 3> principal_strains<2>(const double* strain, double axial_strain_ratio) {
  const double mean = 0.5 * (strain[0] + strain[1]);
  const double radius = 0.5 * std::hypot(strain[0] - strain[1], strain[2]);
  return {mean + radius, mean - radius, 2 * axial_strain_ratio * mean};
}

/// The eigenvalues of a symmetric 3 x 3 matrix by the cosine of a third of an angle.
template <>
std::array<double, 3> principal_strains<3>(const double* strain, double) {
  const double mean = (strain[0] + strain[1] + strain[2]) / 3;
  const double a = strain[0] - mean, b = strain[1] - mean, c = strain[2] - mean;
  const double d = 0.5 * strain[3], e = 0.5 * strain[4], f = 0.5 * strain[5];
  const double radius = std::sqrt((a * a + b * b + c * c + 2 * (d * d + e * e + f * f)) / 6);
  if (radius == 0) return {mean, mean, mean};
  const double determinant = a * b * c + 2 * d * e * f - a * d * d - b * e * e - c * f * f;
  const double angle = std::acos(std::clamp(determinant / (2 * radius * radius * radius), -1.0, 1.0)) / 3;
  constexpr double third = 2 * std::numbers::pi / 3;
  return {mean + 2 * radius * std::cos(angle), mean + 2 * radius * std::cos(angle - third),
          mean + 2 * radius * std::cos(angle + third)};
}

template <int dim>
StrainPeaks strain_peaks(const StateSolver<dim>& solver, const State<dim>& state,
                         const Displacement<dim>& displacement) {
  const PolarGrid<dim>& grid = solver.model().grid;
  const std::vector<double> zeros(state.positions().size(), 0.0);
  StrainPeaks peaks{zeros, zeros};
  const auto full = unit_cell_rule<dim>(solver.model().degree + 1);
  auto cut = state.domain().cut.begin();
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const bool is_cut = cut != state.domain().cut.end() && cut->cell == cell;
    const std::span<const ReferencePoint<dim>> points = is_cut ? (cut++)->material : full;
    if (!state.domain().active(cell) || points.empty()) continue;
    std::vector<Vec<dim>> xi;
    for (const auto& point : points) xi.push_back(point.xi);
    const Material& material = solver.model().materials.in_row(grid.cell_position(cell)[0]);
    const double mu = material.mu(), axial = material.axial_strain_ratio();
    const Matrix strains = displacement.strains(cell, xi);
    for (int j = 0; j < strains.columns(); ++j) {
      double &squared_stress = peaks.von_mises[j / grid.n_sectors],
             &principal = peaks.principal[j / grid.n_sectors];
      for (int row = 0; row < strains.rows(); row += n_strains<dim>) {
        const double* strain = strains.column(j) + row;
        squared_stress = std::max(squared_stress, mu * mu * squared_deviator<dim>(strain, axial));
        for (const double e : principal_strains<dim>(strain, axial))
          principal = std::max(principal, std::abs(e));
      }
    }
  }
  for (double& stress : peaks.von_mises) stress = std::sqrt(6 * stress);
  return peaks;
}

template StrainPeaks strain_peaks(const StateSolver<2>&, const State<2>&, const Displacement<2>&);
template StrainPeaks strain_peaks(const StateSolver<3>&, const State<3>&, const Displacement<3>&);

}  // namespace wheelwright
