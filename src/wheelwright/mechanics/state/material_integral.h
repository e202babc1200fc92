#pragma once

#include "wheelwright/mechanics/state/material_rule.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// int M(u_i) dx over the material of the whole ring, tread included, of every position that was solved for.
/// With MaterialRule's points and the strains of Displacement::strains().
template <int dim>
std::vector<double> material_integral(const StateSolver<dim>& solver, const State<dim>& state,
                                      const MaterialDensity<dim>& density);

/// The points of the same quadrature in one cell, and their strains.
template <int dim>
struct StrainedCell : StrainsInCell<dim> {
  int cell_index;
  std::vector<double> weights;  ///< of the points [m^2, or m^3 when dim = 3]
};

/// The cells with material in the rows that a density covers.
template <int dim>
class StrainedCells {
 public:
  StrainedCells(const StateSolver<dim>& solver, const State<dim>& state, const MaterialDensity<dim>& covered);
  StrainedCells(const StrainedCells&) = delete;
  StrainedCells& operator=(const StrainedCells&) = delete;

  int size() const { return static_cast<int>(cells_.size()); }
  /// One of them, computed for each call.
  StrainedCell<dim> operator[](int k) const;

 private:
  const RollingModel<dim>& model_;
  const Displacement<dim>& displacement_;
  MaterialRule<dim> rule_;
  std::vector<typename MaterialRule<dim>::Cell> cells_;
};

/// Calls visit(cell) for all of them in their order.
template <int dim>
void for_each_cell(const StateSolver<dim>& solver, const State<dim>& state,
                   const MaterialDensity<dim>& covered,
                   const std::function<void(const StrainedCell<dim>&)>& visit);

}  // namespace wheelwright
