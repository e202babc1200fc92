#include "wheelwright/optimization/nucleation/hole_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

/// A candidate position on a lattice of half cells, with the mean of the costs over the hole.
struct Candidate {
  int node;
  Vec<2> polar;
  double cost;
};

Circle circle(const Vec<2>& polar, double radius) { return {polar[0], polar[1], radius}; }

/// The nodes of a lattice of half cells: on it, the mirror planes of a sector are lines of nodes.
Lattice<2> half_cells(const PolarGrid<2>& grid) { return {grid, 2}; }

/// Costs by cell, NaN where unknown.
std::vector<double> by_cell(const PolarGrid<2>& grid, const HoleCosts& costs) {
  std::vector<double> result(grid.n_cells(), std::nan(""));
  for (std::size_t i = 0; i < costs.points.size(); ++i) result[costs.points[i].cell] = costs.values[i];
  return result;
}

double largest_cost(std::span<const double> values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

bool are_mirror_symmetric(const PolarGrid<2>& grid, const std::vector<double>& of_cells, double largest) {
  constexpr double rounding = 1e-6;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const double a = of_cells[cell], b = of_cells[mirror_image(grid, cell)];
    if (std::isnan(a) != std::isnan(b) || std::abs(a - b) > rounding * largest) return false;
  }
  return true;
}

/// The mean of the costs of the cells whose centres lie in the hole; NaN if one of them is unknown.
double mean_cost(const PolarGrid<2>& grid, const std::vector<double>& of_cells, const Circle& hole) {
  const int columns = grid.columns(), first_row = grid.row_at(hole.centre_radius - hole.hole_radius),
            last_row = grid.row_at(hole.centre_radius + hole.hole_radius);
  const double reach = hole.hole_radius / (hole.centre_radius - hole.hole_radius);
  const int first_column = static_cast<int>(std::floor((hole.centre_azimuth - reach) / grid.column_angle())),
            last_column = static_cast<int>(std::floor((hole.centre_azimuth + reach) / grid.column_angle()));
  double sum = 0, area = 0;
  for (int row = first_row; row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column) {
      const Vec<2> middle{grid.middle_of_row(row), (column + 0.5) * grid.column_angle()};
      if (signed_distance<2>(grid, std::span(&hole, 1), middle) < 0) continue;
      const int cell = grid.cell_index({row, ((column % columns) + columns) % columns});
      sum += middle[0] * of_cells[cell];
      area += middle[0];
    }
  return sum / area;
}

/// Whether a hole is far enough from others, given by their signed distance.
bool is_apart(const PolarGrid<2>& grid, std::span<const Circle> others, const Vec<2>& polar, double radius,
              double wall) {
  return others.empty() || -signed_distance<2>(grid, others, polar) >= radius + wall;
}

/// All positions that obey the rules with respect to the shape, best first.
std::vector<Candidate> candidates(const LevelSet<2>& psi, const std::vector<double>& costs,
                                  const HoleRules& rules) {
  const PolarGrid<2>& grid = psi.lattice.grid();
  const Lattice<2> lattice = half_cells(grid);
  const LevelSet<2> distance = redistance(psi);
  std::vector<Candidate> result;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const Vec<2> polar = lattice.polar_point(node);
    if (polar[0] - rules.radius < rules.range.inner || polar[0] + rules.radius > rules.range.outer) continue;
    auto at = lattice.node_position(node);
    std::array<int, 2> nearest{};
    for (int d = 0; d < 2; ++d) nearest[d] = at[d] * psi.lattice.degree() / 2;
    if (-distance.values[distance.lattice.node_index(nearest)] < rules.radius + rules.wall) continue;
    const double cost = mean_cost(grid, costs, circle(polar, rules.radius));
    if (std::isfinite(cost)) result.push_back({node, polar, cost});
  }
  std::ranges::stable_sort(result, {}, &Candidate::cost);
  return result;
}

/// A hole, and its mirror image if it is a different one; empty if the two are too close to each other.
std::vector<Circle> with_image(const PolarGrid<2>& grid, const Candidate& candidate, const HoleRules& rules,
                               bool mirrored) {
  const Circle hole = circle(candidate.polar, rules.radius);
  const double angle = grid.sector_angle();
  const bool on_plane = std::abs(std::remainder(2 * hole.centre_azimuth, angle)) < 1e-9 * angle;
  if (!mirrored || on_plane) return {hole};
  const Circle image{hole.centre_radius, angle - hole.centre_azimuth, hole.hole_radius};
  if (!is_apart(grid, std::span(&image, 1), candidate.polar, rules.radius, rules.wall)) return {};
  return {hole, image};
}

/// Whether the images of a hole in the other sectors leave a wall.
bool is_apart_from_its_images(const PolarGrid<2>& grid, const Circle& hole, double wall) {
  return grid.n_sectors == 1 ||
         2 * hole.centre_radius * std::sin(grid.sector_angle() / 2) >= 2 * hole.hole_radius + wall;
}

}  // namespace

template <int dim>
std::vector<MaterialPoint<dim>> middles_of_full_cells(const CutDomain<dim>& domain, int core_rows) {
  std::vector<MaterialPoint<dim>> points;
  Vec<dim> middle;
  middle.fill(0.5);
  for (int cell = 0; cell < domain.grid.n_cells(); ++cell)
    if (domain.kinds[cell] == CellKind::inside && domain.grid.cell_position(cell)[0] < core_rows)
      points.push_back({cell, middle});
  return points;
}

std::vector<Circle> best_places(const LevelSet<2>& psi, const HoleCosts& costs, const HoleRules& rules) {
  const PolarGrid<2>& grid = psi.lattice.grid();
  const std::vector<double> of_cells = by_cell(grid, costs);
  const bool mirrored =
      is_mirror_symmetric(psi) && are_mirror_symmetric(grid, of_cells, largest_cost(costs.values));
  const double area = std::numbers::pi * rules.radius * rules.radius;
  std::vector<Circle> holes;
  for (const Candidate& candidate : candidates(psi, of_cells, rules)) {
    if (rules.must_pay && candidate.cost >= 0) break;
    const auto added = with_image(grid, candidate, rules, mirrored);
    if (added.empty() || !is_apart(grid, holes, candidate.polar, rules.radius, rules.wall) ||
        !is_apart_from_its_images(grid, added.front(), rules.wall))
      continue;
    if (!holes.empty() && static_cast<double>(holes.size() + added.size()) * area > rules.max_area) continue;
    holes.insert(holes.end(), added.begin(), added.end());
  }
  return holes;
}

LevelSet<2> with_holes(const LevelSet<2>& psi, std::span<const Circle> holes) {
  LevelSet<2> result = redistance(psi);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    result.values[node] = std::max(
        result.values[node], signed_distance<2>(psi.lattice.grid(), holes, psi.lattice.polar_point(node)));
  return is_mirror_symmetric(psi) && is_mirror_symmetric(result) ? mirror_symmetric_part(result) : result;
}

template decltype(middles_of_full_cells<2>) middles_of_full_cells<2>;
template decltype(middles_of_full_cells<3>) middles_of_full_cells<3>;

}  // namespace wheelwright
