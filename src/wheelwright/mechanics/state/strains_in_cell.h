#pragma once

#include <array>
#include <optional>
#include <vector>

#include "wheelwright/linalg/dense.h"
#include "wheelwright/mechanics/elasticity/material_law.h"

namespace wheelwright {

/// The strains of one point of a sector in all load cases. Load case i n_sectors + s is position i with the
/// ground turned to it, seen at the point's image in sector s; or the same point with the ground s sectors
/// back. If all positions were solved, the load cases are those of a whole turn of the wheel.
template <int dim>
struct StrainsAtPoint {
  StrainRows<dim> strains;  ///< [component][load case], in the axes that the law wants
  int n_sectors;
  const MaterialLaw<dim>& law;
  std::array<int, dim> cell;  ///< the position of the point's cell on the grid of the sector
  Vec<dim> xi;                ///< the point in the unit cell

  int n_cases() const { return static_cast<int>(strains[0].size()); }
};

/// A field at points of a cell in all load cases, as the product of a linear map, rows for every point, and
/// what it acts on, one column per load case. A field that is no such product is its own map, without
/// factors.
struct FactoredField {
  Matrix map, factors = {};

  bool is_factored() const { return factors.columns() > 0; }
  int n_cases() const { return is_factored() ? factors.columns() : map.columns(); }
  /// One column per load case.
  Matrix by_rows() const { return is_factored() ? product(map, Op::none, factors, Op::none) : map; }
  /// One row per load case.
  Matrix by_load_case() const {
    return is_factored() ? product(factors, Op::transpose, map, Op::transpose) : transposed(map);
  }
};

/// The strains of some points of one cell of a sector in all load cases, each as StrainsAtPoint. Not for
/// several threads at once.
template <int dim>
class StrainsInCell {
 public:
  /// `strains`: n_strains rows per point in the map; `cell`: the position of the cell on the grid.
  StrainsInCell(FactoredField strains, int n_sectors, const MaterialLaw<dim>& law,
                const std::array<int, dim>& cell, std::vector<Vec<dim>> points)
      : field_(std::move(strains)),
        n_sectors_(n_sectors),
        law_(law),
        cell_(cell),
        points_(std::move(points)) {}

  int n_cases() const { return field_.n_cases(); }
  int n_points() const { return static_cast<int>(points_.size()); }
  int n_sectors() const { return n_sectors_; }
  const MaterialLaw<dim>& law() const { return law_; }
  const std::array<int, dim>& cell() const { return cell_; }
  const std::vector<Vec<dim>>& points() const { return points_; }

  /// One row per load case, n_strains columns per point. Computed by the first call.
  const Matrix& strains() const {
    if (!strains_) strains_ = field_.by_load_case();
    return *strains_;
  }
  StrainsAtPoint<dim> at(int point) const {
    return {strain_columns<dim>(strains(), n_strains<dim> * point), n_sectors_, law_, cell_, points_[point]};
  }

  /// The map of factored strains.
  const Matrix& map() const { return field_.map; }

  /// Linear combinations of the load cases, one for every row of `map`: map * strains(), and cheaper.
  Matrix combined(const Matrix& map) const {
    if (!field_.is_factored()) return product(map, Op::none, field_.map, Op::transpose);
    const Matrix factors = product(map, Op::none, field_.factors, Op::transpose);
    return product(factors, Op::none, field_.map, Op::transpose);
  }

 private:
  FactoredField field_;
  mutable std::optional<Matrix> strains_;
  int n_sectors_;
  const MaterialLaw<dim>& law_;
  std::array<int, dim> cell_;
  std::vector<Vec<dim>> points_;
};

}  // namespace wheelwright
