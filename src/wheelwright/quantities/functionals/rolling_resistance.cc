#include "wheelwright/quantities/functionals/rolling_resistance.h"

#include <algorithm>
#include <numeric>

#include "wheelwright/mechanics/state/turn_harmonics.h"

namespace wheelwright {
namespace {

/// The force by the energy of a harmonic in a material of loss factor 1: 2 n / R_e [1/m].
template <int dim>
double force_by_energy(const PolarGrid<dim>& grid, int harmonic) {
  return 2 * harmonic / grid.outer_radius;
}

template <int dim>
std::vector<double> forces_by_energy(const PolarGrid<dim>& grid, int n_harmonics, double factor) {
  std::vector<double> forces;
  for (int n = 0; n < n_harmonics; ++n) forces.push_back(factor * force_by_energy(grid, n));
  return forces;
}

/// The loss factors of the layers, 0 for those outside of a part.
template <int dim>
std::vector<double> loss_factors(const RollingModel<dim>& model, const std::optional<PartOfRing>& part) {
  const auto& layers = model.materials.layers();
  std::vector<double> factors;
  double inner = model.grid.inner_radius;
  for (const auto& layer : layers) {
    const double outer = &layer == &layers.back() ? model.grid.outer_radius : layer.outer_radius;
    const bool counts = !part || part->has_radius(0.5 * (inner + outer));
    factors.push_back(counts ? layer.law->loss_factor().value_or(0) : 0);
    inner = outer;
  }
  return factors;
}

/// The loss factor of all strain energy from which those of single layers differ: that at the tread, where
/// most of the losses are and the tread's refinement is only known to the energy. Cords store energy without
/// losses.
template <int dim>
double reference(const Materials<dim>& materials, const std::vector<double>& loss_factors) {
  return materials.cords().empty() ? loss_factors.back() : 0;
}

/// Combinations of the strains of the load cases at a point, one column per component.
template <int dim>
Matrix combined(const Matrix& map, const StrainRows<dim>& strains) {
  auto x = Matrix::unfilled(map.columns(), n_strains<dim>);
  for (int k = 0; k < n_strains<dim>; ++k) std::ranges::copy(strains[k], x.column(k));
  return product(map, Op::none, x, Op::none);
}

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
  const Matrix waves = turn.waves();
  std::vector<double> result(turn.n_harmonics(), 0.0);
  for_each_cell<dim>(solver, state, LossDensity<dim>(solver.model(), layer, 1),
                     [&](const StrainedCell<dim>& cell) {
                       const Matrix amplitudes = product(waves, Op::transpose, cell.strains, Op::none);
                       for (int q = 0; q < cell.n_points(); ++q) {
                         const auto strains = strain_columns<dim>(amplitudes, n_strains<dim> * q);
                         const auto of_waves = energies<dim>(cell.law, strains, strains);
                         for (int wave = 0; wave < turn.n_cases(); ++wave)
                           result[TurnHarmonics::harmonic(wave)] +=
                               cell.weights[q] * of_waves[wave] / state.positions().size();
                       }
                     });
  return result;
}

}  // namespace

template <int dim>
bool has_loss_factors(const Materials<dim>& materials) {
  return std::ranges::all_of(materials.layers(),
                             [](const auto& layer) { return layer.law->loss_factor().has_value(); });
}

template <int dim>
LossDensity<dim>::LossDensity(const RollingModel<dim>& model, int layer, double loss_factor)
    : materials_(model.materials), layer_(layer) {
  const TurnHarmonics turn(model.n_positions, model.grid.n_sectors);
  filter_ = turn.filter(forces_by_energy(model.grid, turn.n_harmonics(), loss_factor / model.n_positions));
}

template <int dim>
void LossDensity<dim>::densities(const StrainsAtPoint<dim>& point, std::span<double> values) const {
  const Matrix filtered = combined<dim>(filter_, point.strains);
  std::ranges::copy(energies<dim>(point.law, point.strains, strain_columns<dim>(filtered, 0)),
                    values.begin());
}

template <int dim>
void LossDensity<dim>::slopes(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                              const StressRows<dim>& slopes) const {
  // With the symmetric filter T the derivative of sum_j f_j sigma_j : (T eps)_j / 2 is the stress of half of
  // f T eps + T f eps.
  Matrix strains = combined<dim>(filter_, point.strains);
  auto weighted = Matrix::unfilled(strains.rows(), strains.columns());
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int j = 0; j < strains.rows(); ++j) weighted(j, k) = factors[j] * point.strains[k][j];
  const Matrix of_weighted = product(filter_, Op::none, weighted, Op::none);
  for (int k = 0; k < n_strains<dim>; ++k)
    for (int j = 0; j < strains.rows(); ++j)
      strains(j, k) = 0.5 * (factors[j] * strains(j, k) + of_weighted(j, k));
  point.law.stress(strain_columns<dim>(strains, 0), slopes);
}

template <int dim>
bool LossDensity<dim>::covers(const PolarGrid<dim>& grid, int row) const {
  return materials_.layer_at(grid.middle_of_row(row)) == layer_;
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
  const auto factors = loss_factors(model, {});
  for (int layer = 0; layer < n_layers; ++layer)
    for (std::size_t n = 0; n < forces[layer].size(); ++n)
      forces[layer][n] *= factors[layer] * force_by_energy(model.grid, static_cast<int>(n));
  return forces;
}

double resistance_beyond(std::span<const double> by_harmonic) {
  const auto last_octave = by_harmonic.subspan(by_harmonic.size() / 2);
  return std::accumulate(last_octave.begin(), last_octave.end(), 0.0);
}

template <int dim>
RollingResistance<dim>::RollingResistance(const RollingModel<dim>& model, std::optional<PartOfRing> part)
    : part_(std::move(part)) {
  const auto factors = loss_factors(model, part_);
  loss_factor_ = reference(model.materials, factors);
  for (std::size_t layer = 0; layer < factors.size(); ++layer)
    if (const double difference = factors[layer] - loss_factor_; difference != 0)
      differences_.emplace_back(model, static_cast<int>(layer), difference);
}

template <int dim>
FunctionalValue<dim> RollingResistance<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                      const State<dim>& state, const Matrix&) const {
  FunctionalValue<dim> value;
  double resistance = 0;
  if (loss_factor_ != 0) {
    const std::vector<double>& energy = state.energy_by_harmonic();
    value.derivative.energy_by_harmonic =
        forces_by_energy(solver.model().grid, static_cast<int>(energy.size()), loss_factor_);
    resistance =
        std::inner_product(energy.begin(), energy.end(), value.derivative.energy_by_harmonic.begin(), 0.0);
  }
  for (const LossDensity<dim>& difference : differences_) {
    const auto by_position = material_integral<dim>(solver, state, difference);
    resistance = std::accumulate(by_position.begin(), by_position.end(), resistance);
    value.derivative.integrals.push_back({&difference, std::vector<double>(by_position.size(), 1.0)});
  }
  value.over_positions = resistance;
  return value;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                      \
  template decltype(has_loss_factors<dim>) has_loss_factors<dim>;         \
  template class LossDensity<dim>;                                        \
  template decltype(resistance_of_layers<dim>) resistance_of_layers<dim>; \
  template class RollingResistance<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
