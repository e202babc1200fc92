#include "wheelwright/mechanics/rolling/recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wheelwright {
namespace {

/// Largest accepted interior_residual(); rounding gives about 1e-15.
constexpr double largest_residual = 1e-10;

bool all_finite(const Matrix& a) {
  return std::all_of(a.entries().begin(), a.entries().end(), [](double x) { return std::isfinite(x); });
}

/// sum_i factors_i x_i^2 over some columns of x.
double weighted_square(const std::vector<double>& factors, const Matrix& x, int first_column, int n) {
  std::vector<double> sums(factors.size(), 0.0);
  for (int j = first_column; j < first_column + n; ++j) {
    const double* column = x.column(j);
    for (size_t i = 0; i < sums.size(); ++i) sums[i] += factors[i] * column[i] * column[i];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double column_dot(const Matrix& a, const Matrix& b, int column) {
  const double *x = a.column(column), *y = b.column(column);
  double sum = 0;
  for (int i = 0; i < a.rows(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

std::vector<double> case_multiplicities(const LoadPositions& positions, int n_sectors) {
  std::vector<double> multiplicities;
  for (const double m : positions.multiplicities) multiplicities.insert(multiplicities.end(), n_sectors, m);
  return multiplicities;
}

template <int dim>
Expected<RecoveredFields<dim>> recover(const FactoredShape<dim>& shape, const Tread<dim>& tread,
                                       const LoadPositions& positions, const Preloaded<dim>& preloaded,
                                       const TreadLoads& loads) {
  const CyclicStiffness<dim>& ring = shape.ring;
  const auto& [core, on_boundary] = preloaded.condensed;
  Matrix outer_line = ring.outer_displacements(sum(on_boundary.outer, base_loads(tread, loads)));
  const Matrix boundary = ring.boundary_displacements(outer_line, on_boundary.interface);
  auto sweep = boundary_sweep(ring, shape.domain, preloaded.core_loads);
  SectorFields displacement =
      displacement_fields(ring, sweep, boundary, core, case_multiplicities(positions, ring.n_sectors()));
  Matrix observed = observations(tread, tread_field(tread, outer_line, loads), loads);
  Matrix ghosts = ghost_loads(ring, displacement.modes);
  if (!all_finite(displacement.modes) || !all_finite(observed))
    return Failure{FailureReason::not_finite, "the displacement is not finite"};
  if (const double residual = interior_residual(ring, sweep, displacement, preloaded.core_loads);
      !(residual <= largest_residual))
    return Failure{FailureReason::inaccurate_solution,
                   fmt::format("the equations of a sector are off by {:.2g} of their terms", residual)};
  return RecoveredFields<dim>{std::move(outer_line), std::move(sweep), std::move(displacement),
                              std::move(observed), std::move(ghosts)};
}

std::vector<double> strain_energies(const SolvedFields& fields, int n_groups,
                                    const std::vector<double>& nitsche_factors) {
  const auto& [displacement, observations, ghost_loads, core_loads, tread_loads, loaded_columns] = fields;
  const int n_cases = displacement.weights.rows() / n_groups;
  const int n_columns = observations.columns() / n_groups;
  std::vector<double> energy(n_groups);
  for (int i = 0; i < n_groups; ++i)
    energy[i] = -0.5 * weighted_square(nitsche_factors, observations, i * n_columns, n_columns);
  for (const int c : loaded_columns) energy[c / n_columns] += 0.5 * column_dot(tread_loads, observations, c);
  const auto ghost_work = work_by_case({ghost_loads, displacement.weights}, displacement);
  for (size_t c = 0; c < ghost_work.size(); ++c) energy[c / n_cases] -= 0.5 * ghost_work[c];
  if (!core_loads.empty()) {
    const auto core_work = work_by_case(core_loads, displacement);
    for (size_t c = 0; c < core_work.size(); ++c) energy[c / n_cases] += 0.5 * core_work[c];
  }
  return energy;
}

template <int dim>
Expected<std::vector<double>> strain_energies(const RecoveredFields<dim>& fields,
                                              const LoadPositions& positions, const SectorFields& core_loads,
                                              const Matrix& tread_loads,
                                              const std::vector<int>& loaded_columns,
                                              const std::vector<double>& nitsche_factors) {
  const int n_positions = positions.size();
  std::vector<double> energy = strain_energies(
      {fields.displacement, fields.observations, fields.ghost_loads, core_loads, tread_loads, loaded_columns},
      n_positions, nitsche_factors);
  for (int i = 0; i < n_positions; ++i)
    if (!(energy[i] > 0))
      return Failure{FailureReason::negative_energy,
                     fmt::format("the strain energy of position {} is {:.4g} J/m", i, energy[i])};
  return energy;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                            \
  template Expected<RecoveredFields<dim>> recover(const FactoredShape<dim>&, const Tread<dim>&, \
                                                  const LoadPositions&, const Preloaded<dim>&,  \
                                                  const TreadLoads&);                           \
  template Expected<std::vector<double>> strain_energies(                                       \
      const RecoveredFields<dim>&, const LoadPositions&, const SectorFields&, const Matrix&,    \
      const std::vector<int>&, const std::vector<double>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
