#pragma once

#include <span>

#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The quadrature of integrals over the material of one sector, tread included, in the cells of the grid.
template <int dim>
class MaterialRule {
 public:
  /// `degree` of the displacement.
  MaterialRule(const CutDomain<dim>& domain, int degree)
      : domain_(domain), full_(unit_cell_rule<dim>(degree + 2)) {}

  /// Calls visit(cell, points) for every cell that contains material.
  template <class Visit>
  void for_each_cell(Visit visit) const {
    auto cut = domain_.cut.begin();
    for (int cell = 0; cell < domain_.grid.n_cells(); ++cell) {
      const bool is_cut = cut != domain_.cut.end() && cut->cell == cell;
      const std::span<const ReferencePoint<dim>> points = is_cut ? (cut++)->material : full_;
      if (domain_.active(cell) && !points.empty()) visit(cell, points);
    }
  }

 private:
  const CutDomain<dim>& domain_;
  std::vector<ReferencePoint<dim>> full_;
};

}  // namespace wheelwright
