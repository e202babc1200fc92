#include "wheelwright/shape/geometry/marching_squares.h"

#include <cmath>

#include "wheelwright/shape/geometry/lagrange.h"

namespace wheelwright {
namespace {

/// Minimum distance of a crossing from the ends of its edge, as a fraction of the edge. It keeps vertices
/// distinct where psi vanishes at a sample.
constexpr double end_margin = 1e-6;

/// The zero in (0, 1) of the parabola through (0, start), (1/2, middle) and (1, end), where start and end
/// differ in sign.
double parabola_zero(double start, double middle, double end) {
  const double a = 2 * (start + end) - 4 * middle;
  const double b = 4 * middle - 3 * start - end;
  const double q = -0.5 * (b + std::copysign(std::sqrt(std::max(0.0, b * b - 4 * a * start)), b));
  const double near = start / q, far = q / a;
  const double t = near >= 0 && near <= 1 ? near : far;
  return std::clamp(t, end_margin, 1 - end_margin);
}

double value_of(const ShapeFunctions<2>& shape, const std::vector<double>& nodal) {
  double value = 0;
  for (std::size_t a = 0; a < nodal.size(); ++a) value += shape.value[a] * nodal[a];
  return value;
}

std::array<SquareVertex, 4> square_corners(int i, int j) {
  const auto corner = [](int k, int l) {
    return SquareVertex{.i = k, .j = l, .site = SquareSite::sample, .t = 0};
  };
  return {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
}

}  // namespace

SquareSamples::SquareSamples(const std::array<int, 2>& cells, int degree,
                             std::vector<std::vector<double>> nodal, int n)
    : n_(n),
      rows_(n * cells[0]),
      columns_(n * cells[1]),
      degree_(degree),
      cells_(cells),
      nodal_(std::move(nodal)) {
  std::vector<ShapeFunctions<2>> at_samples;  // of a cell
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) at_samples.emplace_back(degree_, unit_cell_point({1.0 * i, 1.0 * j}, 0));
  samples_.resize((rows_ + 1) * (columns_ + 1));
  for (int j = 0; j <= columns_; ++j)
    for (int i = 0; i <= rows_; ++i) {
      const int cell = cell_of(i, j), first_row = n_ * (cell % cells_[0]),
                first_column = n_ * (cell / cells_[0]);
      samples_[j * (rows_ + 1) + i] =
          value_of(at_samples[(j - first_column) * (n_ + 1) + i - first_row], nodal_[cell]);
    }
}

std::vector<SquarePolygon> SquareSamples::square_polygons(int i, int j) const {
  const auto crossings = square_crossings(i, j);
  const auto corners = square_corners(i, j);
  const int n_crossings = std::count_if(crossings.begin(), crossings.end(), [](auto& c) { return c.t > 0; });
  if (n_crossings == 4 && polynomial({i + 0.5, j + 0.5}, i, j) >= 0) {
    const int k = material(i, j) ? 0 : 1;
    return {{crossings[(k + 3) % 4], corners[k], crossings[k]},
            {crossings[k + 1], corners[k + 2], crossings[k + 2]}};
  }
  SquarePolygon polygon;
  for (int k = 0; k < 4; ++k) {
    if (material(corners[k].i, corners[k].j)) polygon.push_back(corners[k]);
    if (crossings[k].t > 0) polygon.push_back(crossings[k]);
  }
  if (polygon.empty()) return {};
  return {polygon};
}

bool SquareSamples::full(int cell) const {
  const int row = cell % cells_[0], column = cell / cells_[0];
  for (int j = n_ * column; j <= n_ * (column + 1); ++j)
    for (int i = n_ * row; i <= n_ * (row + 1); ++i)
      if (!material(i, j)) return false;
  return true;
}

/// Zeros on the sides of the square; side k runs from corner k to the next. t = 0 marks a side without a
/// zero.
std::array<SquareVertex, 4> SquareSamples::square_crossings(int i, int j) const {
  return {{crossing(i, j, SquareSite::radial_edge, i, j), crossing(i + 1, j, SquareSite::other_edge, i, j),
           crossing(i, j + 1, SquareSite::radial_edge, i, j), crossing(i, j, SquareSite::other_edge, i, j)}};
}

/// The zero on the edge that starts at sample (i, j), for the polynomial of the cell that contains the
/// square.
SquareVertex SquareSamples::crossing(int i, int j, SquareSite site, int square_i, int square_j) const {
  const int di = site == SquareSite::radial_edge, dj = site == SquareSite::other_edge;
  const double start = sample(i, j), end = sample(i + di, j + dj);
  if ((start < 0) == (end < 0)) return {.i = i, .j = j, .site = site, .t = 0};
  const double middle = polynomial({i + 0.5 * di, j + 0.5 * dj}, square_i, square_j);
  return {.i = i, .j = j, .site = site, .t = parabola_zero(start, middle, end)};
}

double SquareSamples::polynomial(const Vec<2>& position, int square_i, int square_j) const {
  const int cell = cell_of(square_i, square_j);
  return value_of(ShapeFunctions<2>(degree_, unit_cell_point(position, cell)), nodal_[cell]);
}

}  // namespace wheelwright
