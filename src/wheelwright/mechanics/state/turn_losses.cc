#include "wheelwright/mechanics/state/turn_losses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wheelwright/mechanics/state/turn_harmonics.h"

namespace wheelwright {
namespace {

/// sigma(a):b / 2 of every row.
template <int dim>
std::vector<double> energies(const MaterialLaw<dim>& law, const StrainRows<dim>& a,
                             const StrainRows<dim>& b) {
  const auto n = static_cast<int>(a[0].size());
  Matrix stresses(n, n_strains<dim>);
  law.stress(a, stress_columns<dim>(stresses, 0));
  std::vector<double> energies(n, 0.0);
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int j = 0; j < n; ++j) energies[j] += 0.5 * stresses(j, k) * b[k][j];
  return energies;
}

/// The energies by harmonics in a layer, by quadrature of the strains.
template <int dim>
std::vector<double> integrated_energy(const StateSolver<dim>& solver, const State<dim>& state, int layer) {
  const TurnHarmonics turn(state.positions().size(), solver.model().grid.n_sectors);
  const Matrix waves = transposed(turn.waves());
  std::vector<double> result(turn.n_harmonics(), 0.0);
  for_each_cell<dim>(solver, state, LossDensity<dim>(solver.model(), layer, LossFactor(1)),
                     [&](const StrainedCell<dim>& cell) {
                       const Matrix amplitudes = cell.combined(waves);
                       for (int q = 0; q < cell.n_points(); ++q) {
                         const auto strains = strain_columns<dim>(amplitudes, n_strains<dim> * q);
                         const auto of_waves = energies<dim>(cell.law(), strains, strains);
                         for (int wave = 0; wave < turn.n_cases(); ++wave)
                           result[TurnHarmonics::harmonic(wave)] +=
                               cell.weights[q] * of_waves[wave] / state.positions().size();
                       }
                     });
  return result;
}

}  // namespace

template <int dim>
std::vector<double> loss_factors(const RollingModel<dim>& model, int n_harmonics,
                                 const LossFactor& loss_factor) {
  const double turns_per_second = std::abs(model.distributed.angular_speed) / (2 * std::numbers::pi);
  std::vector<double> factors;
  for (int n = 0; n < n_harmonics; ++n) factors.push_back(loss_factor.at(n * turns_per_second));
  return factors;
}

template <int dim>
std::vector<double> forces_by_energy(const PolarGrid<dim>& grid, std::span<const double> loss_factors) {
  std::vector<double> forces;
  for (std::size_t n = 0; n < loss_factors.size(); ++n)
    forces.push_back(loss_factors[n] * 2 * static_cast<double>(n) / grid.outer_radius);
  return forces;
}

template <int dim>
bool has_loss_factors(const Materials<dim>& materials) {
  return std::ranges::all_of(materials.layers(),
                             [](const auto& layer) { return layer.law->loss_factor().has_value(); });
}

template <int dim>
LossDensity<dim>::LossDensity(const RollingModel<dim>& model, int layer, std::span<const double> loss_factors)
    : materials_(model.materials), layer_(layer) {
  std::vector<double> of_position(loss_factors.begin(), loss_factors.end());
  for (double& factor : of_position) factor /= model.n_positions;
  filter_ = TurnHarmonics(model.n_positions, model.grid.n_sectors)
                .filter(forces_by_energy<dim>(model.grid, of_position));
}

template <int dim>
LossDensity<dim>::LossDensity(const RollingModel<dim>& model, int layer, const LossFactor& loss_factor)
    : LossDensity(model, layer,
                  loss_factors(model, TurnHarmonics(model.n_positions, model.grid.n_sectors).n_harmonics(),
                               loss_factor)) {}

template <int dim>
Matrix LossDensity<dim>::densities(const StrainsInCell<dim>& cell) const {
  const Matrix filtered = cell.combined(filter_);
  auto values = Matrix::unfilled(cell.n_cases(), cell.n_points());
  for (int q = 0; q < cell.n_points(); ++q)
    std::ranges::copy(
        energies<dim>(cell.law(), cell.at(q).strains, strain_columns<dim>(filtered, n_strains<dim> * q)),
        values.column(q));
  return values;
}

template <int dim>
Matrix LossDensity<dim>::slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const {
  // With the symmetric filter T the derivative of sum_j f_j sigma_j : (T eps)_j / 2 is the stress of half of
  // f T eps + T f eps.
  Matrix map = filter_;
  for (int j = 0; j < map.columns(); ++j)
    for (int i = 0; i < map.rows(); ++i) map(i, j) *= 0.5 * (factors[i] + factors[j]);
  const Matrix strains = cell.combined(map);
  auto slopes = Matrix::unfilled(strains.rows(), strains.columns());
  for (int q = 0; q < cell.n_points(); ++q)
    cell.law().stress(strain_columns<dim>(strains, n_strains<dim> * q),
                      stress_columns<dim>(slopes, n_strains<dim> * q));
  return slopes;
}

template <int dim>
bool LossDensity<dim>::covers(const PolarGrid<dim>& grid, int row) const {
  return materials_.layer_at(grid.middle_of_row(row)) == layer_;
}

template <int dim>
LossOfTurn<dim>::LossOfTurn(const RollingModel<dim>& model, const LossFactor& loss_factor) {
  const TurnHarmonics turn(model.n_positions, model.grid.n_sectors);
  const auto forces = forces_by_energy<dim>(model.grid, loss_factors(model, turn.n_harmonics(), loss_factor));
  waves_ = transposed(turn.waves());
  for (int wave = 0; wave < turn.n_cases(); ++wave)
    factors_.push_back(forces[TurnHarmonics::harmonic(wave)] / model.n_positions);
}

template <int dim>
std::vector<double> LossOfTurn<dim>::densities(const StrainsInCell<dim>& cell) const {
  const Matrix amplitudes = cell.combined(waves_);
  std::vector<double> densities;
  for (int q = 0; q < cell.n_points(); ++q) {
    const auto strains = strain_columns<dim>(amplitudes, n_strains<dim> * q);
    const auto of_waves = energies<dim>(cell.law(), strains, strains);
    densities.push_back(std::inner_product(of_waves.begin(), of_waves.end(), factors_.begin(), 0.0));
  }
  return densities;
}

template <int dim>
std::vector<std::vector<double>> resistance_of_layers(const StateSolver<dim>& solver,
                                                      const State<dim>& state) {
  const RollingModel<dim>& model = solver.model();
  const auto n_layers = static_cast<int>(model.materials.layers().size());
  const bool ends_with_rest = model.materials.cords().empty();
  std::vector<std::vector<double>> forces;
  for (int layer = 0; layer < n_layers - (ends_with_rest ? 1 : 0); ++layer)
    forces.push_back(integrated_energy(solver, state, layer));
  if (ends_with_rest) {
    std::vector<double> rest = state.energy_by_harmonic();
    for (const auto& of_layer : forces)
      for (std::size_t n = 0; n < rest.size(); ++n) rest[n] -= of_layer[n];
    forces.push_back(std::move(rest));
  }
  const auto n_harmonics = static_cast<int>(forces.front().size());
  const auto by_energy = forces_by_energy<dim>(model.grid, std::vector<double>(n_harmonics, 1.0));
  for (int layer = 0; layer < n_layers; ++layer) {
    const auto factors = loss_factors(state.model(), n_harmonics,
                                      model.materials.layers()[layer].law->loss_factor().value_or(0));
    for (int n = 0; n < n_harmonics; ++n) forces[layer][n] *= factors[n] * by_energy[n];
  }
  return forces;
}

double resistance_beyond(std::span<const double> by_harmonic) {
  constexpr double rounding = 1e-12;  // of the energies, of which one layer's is a difference
  const auto sum = [](std::span<const double> forces) {
    return std::accumulate(forces.begin(), forces.end(), 0.0);
  };
  const double last_octave = sum(by_harmonic.subspan(by_harmonic.size() / 2));
  return std::abs(last_octave) > rounding * std::abs(sum(by_harmonic)) ? last_octave : 0;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                              \
  template decltype(has_loss_factors<dim>) has_loss_factors<dim>; \
  template decltype(loss_factors<dim>) loss_factors<dim>;         \
  template decltype(forces_by_energy<dim>) forces_by_energy<dim>; \
  template class LossDensity<dim>;                                \
  template class LossOfTurn<dim>;                                 \
  template decltype(resistance_of_layers<dim>) resistance_of_layers<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
