#include "wheelwright/mechanics/equilibrium/softening.h"

#include <algorithm>

namespace wheelwright {
namespace {

/// The smallest singular value of F.
double smallest_stretch(const Mat<2>& f) {
  const double sum = std::hypot(f[0][0] + f[1][1], f[1][0] - f[0][1]),
               difference = std::hypot(f[0][0] - f[1][1], f[1][0] + f[0][1]);
  return 0.5 * (sum - difference);
}

}  // namespace

template <int dim>
std::optional<double> smallest_stretch_of_saint_venant(const RingForms<dim>& forms,
                                                       const std::vector<double>& v) {
  static_assert(dim == 2, "the smallest singular value");
  std::optional<double> smallest;
  for (const auto& cell : forms.cells()) {
    const HyperelasticElement<dim>& element = forms.element(cell);
    if (element.stored_energy().form != EnergyForm::saint_venant_kirchhoff) continue;
    for (int sector = 0; sector < forms.domain().grid.n_sectors; ++sector) {
      typename HyperelasticElement<dim>::Dofs dofs;
      forms.space().gather(cell.cell, sector, v.data(), dofs.data());
      const auto u = element.cartesian(dofs.data());
      for (const auto& point : cell.points->points) {
        const double stretch = smallest_stretch(element.deformation(point, u));
        smallest = std::min(smallest.value_or(stretch), stretch);
      }
    }
  }
  return smallest;
}

template decltype(smallest_stretch_of_saint_venant<2>) smallest_stretch_of_saint_venant<2>;

}  // namespace wheelwright
