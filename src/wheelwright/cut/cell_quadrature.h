#pragma once

#include <memory>
#include <optional>
#include <span>

#include "wheelwright/cut/cut_domain.h"

namespace wheelwright {

/// Splits unit cells along the zero set of their polynomial level set.
template <int dim>
class CellQuadrature {
 public:
  /// `points` Gauss points a direction on every smooth piece; `degree` (1 or 2) of the level set.
  CellQuadrature(int degree, int points);
  ~CellQuadrature();

  /// Sign pattern of a cell's polynomial from its Bernstein coefficients: `inside` and `outside` are certain,
  /// `cut` means that the zero set may cross the cell.
  CellKind classify(std::span<const double> nodal_values) const;

  /// Quadrature of a cell whose classify() is `cut`; its parts may be empty. Nothing when the measures of
  /// both sides do not add up to the cell's to 1e-6.
  std::optional<CutCell<dim>> split(int cell, std::span<const double> nodal_values);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace wheelwright
