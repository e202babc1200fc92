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
/// what it acts on, one column per load case.
struct FactoredField {
  Matrix map, factors;

  /// One column per load case.
  Matrix by_rows() const { return product(map, Op::none, factors, Op::none); }
  /// One row per load case.
  Matrix by_load_case() const { return product(factors, Op::transpose, map, Op::transpose); }
};

/// The strains of some points of one cell of a sector in all load cases, each as StrainsAtPoint. Not for
/// several threads at once.
template <int dim>
class StrainsInCell {
 public:
  /// `strains`: n_strains rows per point in the map; `cell`: the position of the cell on the grid.
  StrainsInCell(FactoredField strains, int n_sectors, const MaterialLaw<dim>& law,
                const std::array<int, dim>& cell, std::vector<Vec<dim>> points)
      : factored_(std::move(strains)),
        n_sectors_(n_sectors),
        law_(law),
        cell_(cell),
        points_(std::move(points)) {}

  /// From the strains themselves, in the layout of strains().
  StrainsInCell(Matrix strains, int n_sectors, const MaterialLaw<dim>& law, const std::array<int, dim>& cell,
                std::vector<Vec<dim>> points)
      : strains_(std::move(strains)),
        n_sectors_(n_sectors),
        law_(law),
        cell_(cell),
        points_(std::move(points)) {}

  int n_cases() const { return factored_ ? factored_->factors.columns() : strains_->rows(); }
  int n_points() const { return static_cast<int>(points_.size()); }
  int n_sectors() const { return n_sectors_; }
  const MaterialLaw<dim>& law() const { return law_; }
  const std::array<int, dim>& cell() const { return cell_; }
  const std::vector<Vec<dim>>& points() const { return points_; }

  /// One row per load case, n_strains columns per point. The first call multiplies the factors.
  const Matrix& strains() const {
    if (!strains_) strains_ = factored_->by_load_case();
    return *strains_;
  }
  StrainsAtPoint<dim> at(int point) const {
    return {strain_columns<dim>(strains(), n_strains<dim> * point), n_sectors_, law_, cell_, points_[point]};
  }

  /// The map of strains that were given with one.
  const Matrix& map() const { return factored_->map; }

  /// Linear combinations of the load cases, one for every row of `map`: map * strains(), and cheaper.
  Matrix combined(const Matrix& map) const {
    if (!factored_) return product(map, Op::none, *strains_, Op::none);
    const Matrix factors = product(map, Op::none, factored_->factors, Op::transpose);
    return product(factors, Op::none, factored_->map, Op::transpose);
  }

 private:
  std::optional<FactoredField> factored_;
  mutable std::optional<Matrix> strains_;
  int n_sectors_;
  const MaterialLaw<dim>& law_;
  std::array<int, dim> cell_;
  std::vector<Vec<dim>> points_;
};

}  // namespace wheelwright
