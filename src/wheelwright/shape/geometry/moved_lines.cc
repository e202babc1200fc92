#include "wheelwright/shape/geometry/moved_lines.h"

#include <algorithm>
#include <cassert>

namespace wheelwright {
namespace {

/// Divides a number of rows among annuli of these thicknesses, at least one for each. No row that changed the
/// annulus would bring the heights of two annuli closer to each other in proportion: the method of equal
/// proportions of E. V. Huntington, Trans. Amer. Math. Soc. 30, 1928.
std::vector<int> divided_rows(const std::vector<double>& thicknesses, int rows) {
  std::vector<int> result(thicknesses.size(), 1);
  for (int left = rows - static_cast<int>(result.size()); left > 0; --left) {
    std::size_t next = 0;
    const auto priority = [&](std::size_t k) {
      return thicknesses[k] / std::sqrt(result[k] * (result[k] + 1.0));
    };
    for (std::size_t k = 1; k < result.size(); ++k)
      if (priority(k) > priority(next)) next = k;
    ++result[next];
  }
  return result;
}

/// Whether radii are those of lines of a grid of equal rows, each of another one.
template <int dim>
bool are_on_lines(const PolarGrid<dim>& grid, const std::vector<double>& radii) {
  int last = 0;
  for (const double radius : radii) {
    const auto [line, distance] = grid.nearest_line(radius);
    if (line <= last || line >= grid.cells[0] || std::abs(distance) >= 1e-6 * grid.row_height(0))
      return false;
    last = line;
  }
  return true;
}

}  // namespace

template <int dim>
PolarGrid<dim> with_lines_at(PolarGrid<dim> grid, const std::vector<double>& radii) {
  assert(static_cast<int>(radii.size()) < grid.cells[0]);
  grid.fixed_lines.clear();
  if (are_on_lines(grid, radii)) return grid;
  std::vector<double> thicknesses;
  double last = grid.inner_radius;
  for (const double radius : radii) {
    thicknesses.push_back(radius - last);
    last = radius;
  }
  thicknesses.push_back(grid.outer_radius - last);
  const auto rows = divided_rows(thicknesses, grid.cells[0]);
  int line = 0;
  for (std::size_t k = 0; k < radii.size(); ++k) grid.fixed_lines.push_back({line += rows[k], radii[k]});
  return grid;
}

template <int dim>
PolarGrid<dim> divided(PolarGrid<dim> grid, int parts) {
  for (int& cells : grid.cells) cells *= parts;
  for (FixedLine& fixed : grid.fixed_lines) fixed.line *= parts;
  return grid;
}

template <int dim>
RowsAtLine rows_at_fixed_line(const PolarGrid<dim>& grid, int line) {
  return {grid.equal_rows(line - 1), grid.equal_rows(line)};
}

template <int dim>
double radius_of_fixed_line(const PolarGrid<dim>& grid, int line) {
  return std::ranges::find(grid.fixed_lines, line, &FixedLine::line)->radius;
}

template <int dim>
PolarGrid<dim> with_fixed_line_at(PolarGrid<dim> grid, int line, double radius) {
  std::ranges::find(grid.fixed_lines, line, &FixedLine::line)->radius = radius;
  return grid;
}

template <int dim>
std::array<DifferencePoint<dim>, 4> differences_by_radius(const PolarGrid<dim>& grid, int line) {
  constexpr double relative_step = 1e-3;
  const auto [below, above] = rows_at_fixed_line(grid, line);
  const double radius = below.outer_radius,
               step = relative_step *
                      std::min(radius - below.inner_radius, above.outer_radius - above.inner_radius);
  const auto point = [&](int steps, double factor) {
    return DifferencePoint<dim>{with_fixed_line_at(grid, line, radius + steps * step), factor / (12 * step)};
  };
  return {point(-2, 1), point(-1, -8), point(1, 8), point(2, -1)};
}

template <int dim>
RowRatio largest_row_ratio(const PolarGrid<dim>& grid) {
  RowRatio largest{1, grid.inner_radius};
  const auto all = grid.all_equal_rows();
  for (std::size_t k = 1; k < all.size(); ++k) {
    const double below = all[k - 1].height(), above = all[k].height(),
                 ratio = std::max(below, above) / std::min(below, above);
    if (ratio > largest.ratio) largest = {ratio, all[k].inner_radius};
  }
  return largest;
}

template <int dim>
double largest_row_height(const PolarGrid<dim>& grid) {
  double height = 0;
  for (const EqualRows& rows : grid.all_equal_rows()) height = std::max(height, rows.height());
  return height;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                        \
  template decltype(with_lines_at<dim>) with_lines_at<dim>;                 \
  template decltype(divided<dim>) divided<dim>;                             \
  template decltype(rows_at_fixed_line<dim>) rows_at_fixed_line<dim>;       \
  template decltype(radius_of_fixed_line<dim>) radius_of_fixed_line<dim>;   \
  template decltype(with_fixed_line_at<dim>) with_fixed_line_at<dim>;       \
  template decltype(differences_by_radius<dim>) differences_by_radius<dim>; \
  template decltype(largest_row_ratio<dim>) largest_row_ratio<dim>;         \
  template decltype(largest_row_height<dim>) largest_row_height<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
