#pragma once

#include <vector>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/geometry/zero_set.h"

namespace wheelwright {

/// {psi = 0} in the full ring, evaluated at any point of the plane: on the isoparametric cells of the lattice
/// of psi, in Cartesian coordinates [m] of the body frame.
class ZeroContour final : public ZeroSet {
 public:
  explicit ZeroContour(const LevelSet<2>& psi);

  /// Outside the ring the polynomials of its outermost cells are continued.
  Value at(const Vec<2>& point) const override;

 private:
  /// A point in the cell that contains it: position in the unit cell, and the column of the ring.
  struct Place {
    int row, column;
    Vec<2> xi;
  };
  Place place(const Vec<2>& point) const;
  Vec<2> unit_cell_point(const Vec<2>& in_cell_frame, int row, Vec<2> guess) const;

  PolarGrid<2> grid_;
  int degree_;
  std::vector<std::vector<double>> nodal_;  ///< of psi, one entry per cell of the sector
  std::vector<CellMap<2>> maps_;            ///< one per row
};

}  // namespace wheelwright
