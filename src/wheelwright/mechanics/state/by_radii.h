#pragma once

#include "wheelwright/mechanics/state/rolling_model.h"
#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {

/// The derivatives of number(domain), a smooth function of a shape's cells, with respect to the radii of the
/// model's design lines, as ShapeGradients::by_radius; empty without such lines.
template <int dim, class Number>
std::vector<double> by_radii(const RollingModel<dim>& model, const CutDomain<dim>& domain, Number number) {
  std::vector<double> derivatives;
  for (const int line : model.design_lines) {
    CutDomain<dim> stretched = domain;
    double sum = 0;
    for (const auto& [grid, factor] : differences_by_radius(model.grid, line)) {
      stretched.grid = grid;
      sum += factor * number(stretched);
    }
    derivatives.push_back(sum);
  }
  return derivatives;
}

}  // namespace wheelwright
