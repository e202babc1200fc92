#include "wheelwright/mechanics/state/fatigue_utilization.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/mechanics/elasticity/fatigue_measures.h"

namespace wheelwright {
namespace {

/// A tensor from its components in Voigt's order; when dim = 2 with the one along the axle. `shear`: what a
/// component beside the diagonal is of the given one, 1/2 for engineering strains.
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

 private:
  const StrainsAtPoint<dim>& point_;
  Matrix stresses_;
  std::vector<double> axial_stresses_, axial_strains_;
};

template <int dim>
Voigt<dim> unit_strain(int component) {
  Voigt<dim> strain{};
  strain[component] = 1;
  return strain;
}

/// The tensors of stress and strain of a linear law under a unit of every component of the strain.
template <int dim>
std::array<SymmetricTensor, n_strains<dim>> unit_tensors(const MaterialLaw<dim>& law, bool of_stress) {
  std::array<SymmetricTensor, n_strains<dim>> result;
  for (int k = 0; k < n_strains<dim>; ++k) {
    const Voigt<dim> unit = unit_strain<dim>(k);
    double stress_along = 0, strain_along = 0;
    if (dim == 2) law.along_axle(one_strain<dim>(unit), {&stress_along, 1}, {&strain_along, 1});
    result[k] =
        of_stress ? tensor<dim>(stress(law, unit), stress_along, 1) : tensor<dim>(unit, strain_along, 0.5);
  }
  return result;
}

/// Calls visit(measure, tensors, is_of_stress) with the measure and its history of stresses or strains.
template <int dim, class Visit>
void with_measure(const StrainsAtPoint<dim>& point, const FatigueStrength& strength, Visit visit) {
  const History<dim> history(point);
  switch (strength.measure) {
    case FatigueMeasure::crossland:
      return visit(Crossland{strength.pressure_factor}, history.stresses(), true);
    case FatigueMeasure::dang_van:
      return visit(DangVan{strength.pressure_factor}, history.stresses(), true);
    case FatigueMeasure::goodman:
      return visit(Goodman{strength.ultimate_strength.value_or(INFINITY)}, history.stresses(), true);
    case FatigueMeasure::principal_strain:
      return visit(LargestPrincipal(), history.strains(), false);
    default:
      return;
  }
}

/// Samples of the utilization, at least 0.
template <int dim>
void utilization_of_samples(const StrainsAtPoint<dim>& point, const FatigueStrength& strength,
                            std::span<double> values) {
  if (strength.measure == FatigueMeasure::strain_energy)
    point.law.energy_density(point.strains, values);
  else
    with_measure(point, strength, [&](const auto& measure, const auto& tensors, bool) {
      std::ranges::copy(measure.samples(tensors), values.begin());
    });
  for (double& value : values) value = std::max(0.0, value / strength.limit);
}

/// The derivative of sum_j factor_j u_j with respect to the strains, u the samples of the utilization.
template <int dim>
void set_slopes(const StrainsAtPoint<dim>& point, const FatigueStrength& strength,
                std::vector<double> factors, const StressRows<dim>& slopes) {
  for (double& factor : factors) factor /= strength.limit;
  if (strength.measure == FatigueMeasure::strain_energy) {
    point.law.stress(point.strains, slopes);
    for (int k = 0; k < n_strains<dim>; ++k)
      for (std::size_t j = 0; j < factors.size(); ++j) slopes[k][j] *= factors[j];
    return;
  }
  with_measure(point, strength, [&](const auto& measure, const auto& tensors, bool is_of_stress) {
    const auto by_tensor = measure.slopes(tensors, factors);
    const auto units = unit_tensors(point.law, is_of_stress);
    for (int k = 0; k < n_strains<dim>; ++k)
      for (std::size_t j = 0; j < factors.size(); ++j)
        slopes[k][j] = std::inner_product(by_tensor[j].begin(), by_tensor[j].end(), units[k].begin(), 0.0);
  });
}

}  // namespace

template <int dim>
bool has_fatigue_strength(const Materials<dim>& materials) {
  return std::ranges::all_of(materials.layers(),
                             [](const auto& layer) { return layer.law->fatigue_strength() != nullptr; });
}

template <int dim>
double fatigue_utilization(const StrainsAtPoint<dim>& point) {
  const FatigueStrength* strength = point.law.fatigue_strength();
  if (!strength) return 0;
  if (strength->measure == FatigueMeasure::strain_energy) {
    std::vector<double> values(point.n_cases());
    utilization_of_samples(point, *strength, values);
    return std::ranges::max(values);
  }
  double value = 0;
  with_measure(point, *strength, [&](const auto& measure, const auto& tensors, bool) {
    value = std::max(0.0, measure.value(tensors) / strength->limit);
  });
  return value;
}

template <int dim>
void UtilizationPower<dim>::densities(const StrainsAtPoint<dim>& point, std::span<double> values) const {
  std::ranges::fill(values, 0.0);
  const FatigueStrength* strength = point.law.fatigue_strength();
  if (!strength) return;
  utilization_of_samples(point, *strength, values);
  for (double& value : values) value = std::pow(value, exponent_);
}

template <int dim>
void UtilizationPower<dim>::slopes(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                                   const StressRows<dim>& slopes) const {
  for (const auto& row : slopes) std::ranges::fill(row, 0.0);
  const FatigueStrength* strength = point.law.fatigue_strength();
  if (!strength) return;
  constexpr double negligible = 1e-16;  // of the largest share
  std::vector<double> shares(point.n_cases());
  utilization_of_samples(point, *strength, shares);
  for (int j = 0; j < point.n_cases(); ++j)
    shares[j] = factors[j] * exponent_ * std::pow(shares[j], exponent_ - 1);
  const auto size = [](double share) { return std::abs(share); };
  const double least = negligible * size(std::ranges::max(shares, {}, size));
  for (double& share : shares)
    if (size(share) < least) share = 0;
  set_slopes(point, *strength, std::move(shares), slopes);
}

template <int dim>
bool UtilizationPower<dim>::covers(const PolarGrid<dim>& grid, int row) const {
  return materials_.in_row(grid, row).fatigue_strength() != nullptr;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                      \
  template decltype(has_fatigue_strength<dim>) has_fatigue_strength<dim>; \
  template decltype(fatigue_utilization<dim>) fatigue_utilization<dim>;   \
  template class UtilizationPower<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
