#include "wheelwright/quantities/functionals/fatigue.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/mechanics/state/material_integral.h"

namespace wheelwright {
namespace {

/// A tensor from its components in the plane or in space (StressRows), and from that along the axle when dim
/// =
/// 2. `shear`: a component beside the diagonal by that of the rows.
template <int dim>
SymmetricTensor tensor(const Voigt<dim>& components, double axial, double shear) {
  if constexpr (dim == 2) return {components[0], components[1], axial, 0, 0, shear * components[2]};
  SymmetricTensor result;
  for (int k = 0; k < n_strains<dim>; ++k) result[k] = (k < 3 ? 1 : shear) * components[k];
  return result;
}

/// Stresses and strains at a point in all load cases.
template <int dim>
class History {
 public:
  explicit History(const StrainsAtPoint<dim>& point)
      : point_(point),
        stresses_(point.n_cases(), n_strains<dim>),
        axial_stresses_(point.n_cases(), 0.0),
        axial_strains_(point.n_cases(), 0.0) {
    point.law.stress(point.strains, stress_columns<dim>(stresses_, 0));
    if (dim == 2) point.law.along_axle(point.strains, axial_stresses_, axial_strains_);
  }

  std::vector<SymmetricTensor> stresses() const {
    std::vector<SymmetricTensor> result;
    for (int j = 0; j < point_.n_cases(); ++j) {
      Voigt<dim> components;
      for (int k = 0; k < n_strains<dim>; ++k) components[k] = stresses_(j, k);
      result.push_back(tensor<dim>(components, axial_stresses_[j], 1));
    }
    return result;
  }

  std::vector<SymmetricTensor> strains() const {
    std::vector<SymmetricTensor> result;
    for (int j = 0; j < point_.n_cases(); ++j)
      result.push_back(tensor<dim>(strain(j), axial_strains_[j], 0.5));
    return result;
  }

  Voigt<dim> strain(int load_case) const {
    Voigt<dim> result;
    for (int k = 0; k < n_strains<dim>; ++k) result[k] = point_.strains[k][load_case];
    return result;
  }

  Voigt<dim> stress(int load_case) const {
    Voigt<dim> result;
    for (int k = 0; k < n_strains<dim>; ++k) result[k] = stresses_(load_case, k);
    return result;
  }

 private:
  const StrainsAtPoint<dim>& point_;
  Matrix stresses_;
  std::vector<double> axial_stresses_, axial_strains_;
};

/// A measure and its derivatives with respect to the strains of some load cases.
template <int dim>
struct PointMeasure {
  double value = 0;
  struct Slope {
    int load_case;
    Voigt<dim> by_strain;
  };
  std::vector<Slope> slopes = {};
};

template <int dim>
Voigt<dim> unit_strain(int component) {
  Voigt<dim> strain{};
  strain[component] = 1;
  return strain;
}

/// Stress and strain along the axle under a strain, of a linear law when dim = 2.
template <int dim>
std::pair<double, double> along_axle(const MaterialLaw<dim>& law, const Voigt<dim>& strain) {
  double stress = 0, axial = 0;
  if (dim == 2) law.along_axle(one_strain<dim>(strain), {&stress, 1}, {&axial, 1});
  return {stress, axial};
}

/// From derivatives with respect to stresses. The laws of rolling wheels are linear.
template <int dim>
PointMeasure<dim> of_stresses(const MaterialLaw<dim>& law, const HistoryMeasure& measure) {
  std::array<SymmetricTensor, n_strains<dim>> by_component;
  for (int k = 0; k < n_strains<dim>; ++k) {
    const Voigt<dim> unit = unit_strain<dim>(k);
    by_component[k] = tensor<dim>(stress(law, unit), along_axle(law, unit).first, 1);
  }
  PointMeasure<dim> result{measure.value};
  for (const auto& [load_case, by_tensor] : measure.slopes) {
    Voigt<dim> slope;
    for (int k = 0; k < n_strains<dim>; ++k)
      slope[k] = std::inner_product(by_tensor.begin(), by_tensor.end(), by_component[k].begin(), 0.0);
    result.slopes.push_back({load_case, slope});
  }
  return result;
}

/// From derivatives with respect to strains.
template <int dim>
PointMeasure<dim> of_strains(const MaterialLaw<dim>& law, const HistoryMeasure& measure) {
  PointMeasure<dim> result{measure.value};
  for (const auto& [load_case, by_tensor] : measure.slopes) {
    Voigt<dim> slope;
    for (int k = 0; k < n_strains<dim>; ++k) {
      const Voigt<dim> unit = unit_strain<dim>(k);
      const SymmetricTensor moved = tensor<dim>(unit, along_axle(law, unit).second, 0.5);
      slope[k] = std::inner_product(by_tensor.begin(), by_tensor.end(), moved.begin(), 0.0);
    }
    result.slopes.push_back({load_case, slope});
  }
  return result;
}

template <int dim>
PointMeasure<dim> largest_energy(const StrainsAtPoint<dim>& point, const History<dim>& history) {
  std::vector<double> energies(point.n_cases());
  point.law.energy_density(point.strains, energies);
  const auto at = static_cast<int>(std::ranges::max_element(energies) - energies.begin());
  return {energies[at], {{at, history.stress(at)}}};
}

template <int dim>
PointMeasure<dim> measure_of(const StrainsAtPoint<dim>& point, const FatigueStrength& strength) {
  const History<dim> history(point);
  switch (strength.measure) {
    case FatigueMeasure::crossland:
      return of_stresses<dim>(point.law, crossland(history.stresses(), strength.pressure_factor));
    case FatigueMeasure::dang_van:
      return of_stresses<dim>(point.law, dang_van(history.stresses(), strength.pressure_factor));
    case FatigueMeasure::goodman:
      return of_stresses<dim>(point.law,
                              goodman(history.stresses(), strength.ultimate_strength.value_or(1e300)));
    case FatigueMeasure::principal_strain:
      return of_strains<dim>(point.law, largest_principal(history.strains()));
    case FatigueMeasure::strain_energy:
      return largest_energy(point, history);
    case FatigueMeasure::none:
      break;
  }
  return {};
}

template <int dim>
PointMeasure<dim> utilization(const StrainsAtPoint<dim>& point) {
  const FatigueStrength* strength = point.law.fatigue_strength();
  if (!strength || strength->measure == FatigueMeasure::none) return {};
  PointMeasure<dim> result = measure_of(point, *strength);
  if (result.value <= 0) return {};
  result.value /= strength->limit;
  for (auto& [load_case, by_strain] : result.slopes)
    for (double& x : by_strain) x /= strength->limit;
  return result;
}

}  // namespace

template <int dim>
bool has_fatigue_strength(const Materials<dim>& materials) {
  return std::ranges::all_of(materials.layers(),
                             [](const auto& layer) { return layer.law->fatigue_strength() != nullptr; });
}

template <int dim>
double fatigue_utilization(const StrainsAtPoint<dim>& point) {
  return utilization(point).value;
}

template <int dim>
void UtilizationPower<dim>::densities(const StrainsAtPoint<dim>& point, std::span<double> values) const {
  std::ranges::fill(values, std::pow(utilization(point).value, exponent_) / point.n_cases());
}

template <int dim>
void UtilizationPower<dim>::slopes(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                                   const StressRows<dim>& slopes) const {
  for (const auto& row : slopes) std::ranges::fill(row, 0.0);
  const PointMeasure<dim> of_point = utilization(point);
  const double mean_factor = std::accumulate(factors.begin(), factors.end(), 0.0) / point.n_cases();
  const double slope = mean_factor * exponent_ * std::pow(of_point.value, exponent_ - 1);
  for (const auto& [load_case, by_strain] : of_point.slopes)
    for (int k = 0; k < n_strains<dim>; ++k) slopes[k][load_case] += slope * by_strain[k];
}

template <int dim>
bool UtilizationPower<dim>::covers(const PolarGrid<dim>& grid, int row) const {
  return materials_.in_row(grid, row).fatigue_strength() && (!part_ || part_->has_row(grid, row));
}

template <int dim>
FunctionalValue<dim> FatigueUtilization<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&,
                                                       const State<dim>& state, const Matrix&) const {
  double integral = 0, peak = 0;
  for_each_cell<dim>(solver, state, power_, [&](const StrainedCell<dim>& cell) {
    for (int q = 0; q < cell.n_points(); ++q) {
      const double value = fatigue_utilization(cell.at(q));
      peak = std::max(peak, value);
      integral += cell.weights[q] * std::pow(value, norm_.exponent);
    }
  });
  FunctionalValue<dim> value;
  const double norm = norm_.value(peak, integral, 1).peak();
  value.over_positions = norm;
  const double factor = integral > 0 ? norm / (norm_.exponent * integral) : 0;
  value.derivative.integrals.push_back({&power_, std::vector<double>(state.positions().size(), factor)});
  return value;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                      \
  template decltype(has_fatigue_strength<dim>) has_fatigue_strength<dim>; \
  template decltype(fatigue_utilization<dim>) fatigue_utilization<dim>;   \
  template class UtilizationPower<dim>;                                   \
  template class FatigueUtilization<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
