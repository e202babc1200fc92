#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// The place of a polygon vertex: at sample (i, j), or at the fraction t of the edge that starts at the
/// sample and runs along an axis.
enum class SquareSite { sample, radial_edge, other_edge };

struct SquareVertex {
  int i, j;
  SquareSite site;
  double t;

  /// In units of samples.
  Vec<2> position() const {
    return {i + (site == SquareSite::radial_edge ? t : 0), j + (site == SquareSite::other_edge ? t : 0)};
  }
  bool has_row(int row) const { return i == row && site != SquareSite::radial_edge; }
  bool has_column(int column) const { return j == column && site != SquareSite::other_edge; }
};

using SquarePolygon = std::vector<SquareVertex>;

/// Marching squares: a piecewise polynomial psi on a grid of cells, sampled on a grid that is `n` times
/// finer. Axis 0 is the radius, axis 1 the azimuth or the axle. Sample (i, j) is the i-th along the radius
/// and the j-th along the other axis.
class SquareSamples {
 public:
  /// `nodal`: values of psi at the nodes of every cell, axis 0 varying fastest in cells and in their nodes.
  SquareSamples(const std::array<int, 2>& cells, int degree, std::vector<std::vector<double>> nodal, int n);

  int rows() const { return rows_; }        ///< of squares
  int columns() const { return columns_; }  ///< of squares
  bool material(int i, int j) const { return sample(i, j) < 0; }

  /// Whether all corners of the square with the first corner at sample (i, j) lie in the material, or all in
  /// voids: then no zero is on its sides.
  bool is_uniform(int i, int j) const {
    const bool first = material(i, j);
    return material(i + 1, j) == first && material(i, j + 1) == first && material(i + 1, j + 1) == first;
  }

  /// Polygons of the material in the square with the first corner at sample (i, j), counter-clockwise if axis
  /// 1 lies to the left of axis 0. All vertices that are no samples lie on the zero set of the polynomial;
  /// psi at the centre of the square decides the ambiguous case.
  std::vector<SquarePolygon> square_polygons(int i, int j) const;

  /// Whether all samples of the cell lie in the material.
  bool full(int cell) const;

  /// Index of the cell that contains the square (i, j).
  int cell_of(int i, int j) const {
    return std::min(j, columns_ - 1) / n_ * cells_[0] + std::min(i, rows_ - 1) / n_;
  }

  /// Converts a position in units of samples to a point of the unit cell.
  Vec<2> unit_cell_point(const Vec<2>& position, int cell) const {
    return {position[0] / n_ - cell % cells_[0], position[1] / n_ - cell / cells_[0]};
  }

 private:
  double sample(int i, int j) const { return samples_[j * (rows_ + 1) + i]; }
  std::array<SquareVertex, 4> square_crossings(int i, int j) const;
  SquareVertex crossing(int i, int j, SquareSite site, int square_i, int square_j) const;
  double polynomial(const Vec<2>& position, int square_i, int square_j) const;

  int n_, rows_, columns_, degree_;
  std::array<int, 2> cells_;
  std::vector<std::vector<double>> nodal_;
  std::vector<double> samples_;
};

}  // namespace wheelwright
