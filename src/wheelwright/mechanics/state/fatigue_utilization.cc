#include "wheelwright/mechanics/state/fatigue_utilization.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "wheelwright/base/integer_power.h"

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

/// Whether a measure is one of strains, and not of stresses.
bool is_of_strains(FatigueMeasure measure) { return measure == FatigueMeasure::principal_strain; }

/// What a history of stresses or strains is measured by, for samples up to a least one.
std::unique_ptr<const MeasuredHistory> measured(const FatigueStrength& strength, TensorHistory history,
                                                double least) {
  switch (strength.measure) {
    case FatigueMeasure::crossland:
      return Crossland{strength.pressure_factor}.of(history, least);
    case FatigueMeasure::dang_van:
      return DangVan{strength.pressure_factor}.of(history, least);
    case FatigueMeasure::goodman:
      return Goodman{strength.ultimate_strength.value_or(INFINITY)}.of(history, least);
    case FatigueMeasure::principal_strain:
      return LargestPrincipal().of(history, least);
    default:
      throw std::logic_error("not a measure of a history");
  }
}

}  // namespace

template <int dim>
bool has_fatigue_strength(const Materials<dim>& materials) {
  return std::ranges::all_of(materials.layers(),
                             [](const auto& layer) { return layer.law->fatigue_strength() != nullptr; });
}

template <int dim>
PointUtilization<dim>::PointUtilization(const StrainsAtPoint<dim>& point, double least)
    : point_(point), strength_(point.law.fatigue_strength()) {
  if (!strength_) return;
  if (strength_->measure == FatigueMeasure::strain_energy) {
    energies_.resize(point.n_cases());
    point.law.energy_density(point.strains, energies_);
    return;
  }
  const History<dim> history(point);
  tensors_ = is_of_strains(strength_->measure) ? history.strains() : history.stresses();
  measured_ = measured(*strength_, tensors_, least * strength_->limit);
}

template <int dim>
double PointUtilization<dim>::value() const {
  if (!strength_) return 0;
  return std::max(0.0, measured_ ? measured_->value() : std::ranges::max(energies_)) / strength_->limit;
}

template <int dim>
std::vector<double> PointUtilization<dim>::samples() const {
  if (!strength_) return std::vector<double>(point_.n_cases(), 0.0);
  std::vector<double> values = measured_ ? measured_->samples() : energies_;
  const double by_limit = 1 / strength_->limit;
  for (double& value : values) value = std::max(0.0, value * by_limit);
  return values;
}

template <int dim>
void PointUtilization<dim>::set_slopes(std::span<const double> factors, const StressRows<dim>& slopes) const {
  for (const auto& row : slopes) std::ranges::fill(row, 0.0);
  if (!strength_) return;
  std::vector<double> by_limit;
  for (const double factor : factors) by_limit.push_back(factor / strength_->limit);
  if (!measured_) {
    point_.law.stress(point_.strains, slopes);
    for (int k = 0; k < n_strains<dim>; ++k)
      for (std::size_t j = 0; j < by_limit.size(); ++j) slopes[k][j] *= by_limit[j];
    return;
  }
  const auto by_tensor = measured_->slopes(by_limit);
  const auto units = unit_tensors(point_.law, !is_of_strains(strength_->measure));
  for (int k = 0; k < n_strains<dim>; ++k)
    for (std::size_t j = 0; j < by_limit.size(); ++j)
      slopes[k][j] = std::inner_product(by_tensor[j].begin(), by_tensor[j].end(), units[k].begin(), 0.0);
}

template <int dim>
void UtilizationPower<dim>::densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const {
  std::ranges::transform(PointUtilization<dim>(point, least_).samples(), values.begin(),
                         [&](double sample) { return integer_power(sample, exponent_); });
}

template <int dim>
void UtilizationPower<dim>::slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                                      const StressRows<dim>& slopes) const {
  const PointUtilization<dim> utilization(point, least_);
  std::vector<double> shares = utilization.samples();
  if (std::ranges::max(shares) < least_) {
    for (const auto& row : slopes) std::ranges::fill(row, 0.0);
    return;
  }
  for (int j = 0; j < point.n_cases(); ++j)
    shares[j] = shares[j] < least_ ? 0 : factors[j] * exponent_ * integer_power(shares[j], exponent_ - 1);
  utilization.set_slopes(shares, slopes);
}

template <int dim>
bool UtilizationPower<dim>::covers(const PolarGrid<dim>& grid, int row) const {
  return materials_.in_row(grid, row).fatigue_strength() != nullptr;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                      \
  template decltype(has_fatigue_strength<dim>) has_fatigue_strength<dim>; \
  template class PointUtilization<dim>;                                   \
  template class UtilizationPower<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
