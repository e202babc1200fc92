#include "wheelwright/optimization/nucleation/hole_places.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/geometry/ball.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {

Vec<2> centre(const Circle& hole) { return {hole.centre_radius, hole.centre_azimuth}; }
Vec<3> centre(const Sphere& hole) { return {hole.centre_radius, hole.centre_azimuth, hole.centre_height}; }

namespace {

/// A candidate position on a lattice of half cells, with the mean of the costs over the hole.
template <int dim>
struct Candidate {
  Vec<dim> polar;
  double cost;
};

Circle round_hole(const Vec<2>& polar, double radius) { return {polar[0], polar[1], radius}; }
Sphere round_hole(const Vec<3>& polar, double radius) { return {polar[0], polar[1], polar[2], radius}; }

/// Signed distance to the holes, of which there is one at least, and their images in all sectors.
double distance_into(const PolarGrid<2>& grid, std::span<const Circle> holes, const Vec<2>& polar) {
  return signed_distance<2>(grid, holes, polar);
}
double distance_into(const PolarGrid<3>& grid, std::span<const Sphere> holes, const Vec<3>& polar) {
  double deepest = -HUGE_VAL;
  for (const Sphere& hole : holes) deepest = std::max(deepest, signed_distance(grid, hole, polar));
  return deepest;
}

template <int dim>
double distance_into(const PolarGrid<dim>& grid, const RoundHole<dim>& hole, const Vec<dim>& polar) {
  return distance_into(grid, std::span(&hole, 1), polar);
}

/// The nodes of a lattice of half cells: on it, the mirror planes of a sector consist of nodes.
template <int dim>
Lattice<dim> half_cells(const PolarGrid<dim>& grid) {
  return {grid, 2};
}

/// Costs by cell, NaN where unknown.
template <int dim>
std::vector<double> by_cell(const PolarGrid<dim>& grid, const HoleCosts<dim>& costs) {
  std::vector<double> result(grid.n_cells(), std::nan(""));
  for (std::size_t i = 0; i < costs.points.size(); ++i) result[costs.points[i].cell] = costs.values[i];
  return result;
}

double largest_cost(std::span<const double> values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

template <int dim>
bool are_mirror_symmetric(const PolarGrid<dim>& grid, const std::vector<double>& of_cells, double largest,
                          MirrorPlane plane) {
  constexpr double rounding = 1e-6;
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    const double a = of_cells[cell], b = of_cells[mirror_image(grid, cell, plane)];
    if (std::isnan(a) != std::isnan(b) || std::abs(a - b) > rounding * largest) return false;
  }
  return true;
}

template <int dim>
std::vector<MirrorPlane> planes() {
  if constexpr (dim == 2)
    return {MirrorPlane::azimuth};
  else
    return {MirrorPlane::azimuth, MirrorPlane::width};
}

/// The cells of the box around a hole, whose columns may lie in the neighbouring sectors.
template <int dim>
struct Box {
  std::array<int, dim> first, last;
};

template <int dim>
Box<dim> box_around(const PolarGrid<dim>& grid, const RoundHole<dim>& hole) {
  const double reach = hole.hole_radius / (hole.centre_radius - hole.hole_radius);
  const auto column_at = [&](double azimuth) {
    return static_cast<int>(std::floor(azimuth / grid.column_angle()));
  };
  Box<dim> box{};
  box.first[0] = grid.row_at(hole.centre_radius - hole.hole_radius);
  box.last[0] = grid.row_at(hole.centre_radius + hole.hole_radius);
  box.first[1] = column_at(hole.centre_azimuth - reach);
  box.last[1] = column_at(hole.centre_azimuth + reach);
  if constexpr (dim == 3) {
    const auto layer_at = [&](double height) {
      return std::clamp(static_cast<int>(std::floor(height / grid.axial_size())), 0, grid.cells[2] - 1);
    };
    box.first[2] = layer_at(hole.centre_height - hole.hole_radius);
    box.last[2] = layer_at(hole.centre_height + hole.hole_radius);
  }
  return box;
}

/// The next cell of a box, the last coordinate first. Returns whether there was one.
template <int dim>
bool to_next(const Box<dim>& box, std::array<int, dim>& place) {
  for (int d = dim - 1; d >= 0; --d) {
    if (place[d] < box.last[d]) return ++place[d], true;
    place[d] = box.first[d];
  }
  return false;
}

/// The mean of the costs of the cells whose centres lie in the hole; NaN if one of them is unknown.
template <int dim>
double mean_cost(const PolarGrid<dim>& grid, const std::vector<double>& of_cells,
                 const RoundHole<dim>& hole) {
  const int columns = grid.columns();
  const Box<dim> box = box_around(grid, hole);
  double sum = 0, measure = 0;
  auto place = box.first;
  do {
    Vec<dim> middle;
    for (int d = 1; d < dim; ++d) middle[d] = (place[d] + 0.5) * grid.cell_size(place[0])[d];
    middle[0] = grid.middle_of_row(place[0]);
    if (distance_into<dim>(grid, hole, middle) < 0) continue;
    auto cell = place;
    cell[1] = ((place[1] % columns) + columns) % columns;
    sum += middle[0] * of_cells[grid.cell_index(cell)];
    measure += middle[0];
  } while (to_next<dim>(box, place));
  return sum / measure;
}

/// Whether a hole is far enough from others, given by their signed distance.
template <int dim>
bool is_apart(const PolarGrid<dim>& grid, std::span<const RoundHole<dim>> others, const Vec<dim>& polar,
              double radius, double wall) {
  return others.empty() || -distance_into(grid, others, polar) >= radius + wall;
}

/// Whether a hole lies between the bands, and apart from the side faces.
template <int dim>
bool is_in_range(const PolarGrid<dim>& grid, const Vec<dim>& polar, const HoleRules& rules) {
  if constexpr (dim == 3)
    if (std::min(polar[2], grid.width - polar[2]) < rules.radius + rules.wall) return false;
  return polar[0] - rules.radius >= rules.range.inner && polar[0] + rules.radius <= rules.range.outer;
}

/// All positions that obey the rules with respect to the shape, best first.
template <int dim>
std::vector<Candidate<dim>> candidates(const LevelSet<dim>& psi, const std::vector<double>& costs,
                                       const HoleRules& rules) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const Lattice<dim> lattice = half_cells(grid);
  const LevelSet<dim> distance = redistance(psi);
  std::vector<Candidate<dim>> result;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const Vec<dim> polar = lattice.polar_point(node);
    if (!is_in_range<dim>(grid, polar, rules)) continue;
    auto at = lattice.node_position(node);
    std::array<int, dim> nearest{};
    for (int d = 0; d < dim; ++d) nearest[d] = at[d] * psi.lattice.degree() / 2;
    if (-distance.values[distance.lattice.node_index(nearest)] < rules.radius + rules.wall) continue;
    const double cost = mean_cost<dim>(grid, costs, round_hole(polar, rules.radius));
    if (std::isfinite(cost)) result.push_back({polar, cost});
  }
  std::ranges::stable_sort(result, {}, &Candidate<dim>::cost);
  return result;
}

/// The mirror image of a place in the same sector; empty if it is the place itself.
template <int dim>
std::optional<Vec<dim>> image_in(const PolarGrid<dim>& grid, Vec<dim> polar, MirrorPlane plane) {
  const int axis = plane == MirrorPlane::azimuth ? 1 : dim - 1;
  const double extent = axis == 1 ? grid.sector_angle() : grid.width;
  const double off = 2 * polar[axis] - (axis == 1 ? 0 : extent);
  if (std::abs(std::remainder(off, extent)) < 1e-9 * extent) return {};
  polar[axis] = extent - polar[axis];
  return polar;
}

/// A hole, and those of its mirror images that are different ones; empty if they are too close to each other.
template <int dim>
std::vector<RoundHole<dim>> with_images(const PolarGrid<dim>& grid, const Candidate<dim>& candidate,
                                        const HoleRules& rules, const std::vector<MirrorPlane>& mirrors) {
  std::vector<RoundHole<dim>> holes{round_hole(candidate.polar, rules.radius)};
  for (const MirrorPlane plane : mirrors)
    for (std::size_t k = 0, n = holes.size(); k < n; ++k)
      if (const auto image = image_in<dim>(grid, centre(holes[k]), plane))
        holes.push_back(round_hole(*image, rules.radius));
  const std::span<const RoundHole<dim>> images = std::span(holes).subspan(1);
  if (!is_apart<dim>(grid, images, candidate.polar, rules.radius, rules.wall)) return {};
  return holes;
}

/// Whether the images of a hole in the other sectors leave a wall.
template <int dim>
bool is_apart_from_its_images(const PolarGrid<dim>& grid, const RoundHole<dim>& hole, double wall) {
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

template <int dim>
std::vector<RoundHole<dim>> best_places(const LevelSet<dim>& psi, const HoleCosts<dim>& costs,
                                        const HoleRules& rules) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const std::vector<double> of_cells = by_cell(grid, costs);
  std::vector<MirrorPlane> mirrors;
  for (const MirrorPlane plane : planes<dim>())
    if (is_mirror_symmetric(psi, plane) &&
        are_mirror_symmetric(grid, of_cells, largest_cost(costs.values), plane))
      mirrors.push_back(plane);
  const double measure = ball_measure<dim>(rules.radius);
  std::vector<RoundHole<dim>> holes;
  for (const Candidate<dim>& candidate : candidates(psi, of_cells, rules)) {
    if (rules.must_pay && candidate.cost >= 0) break;
    const auto added = with_images(grid, candidate, rules, mirrors);
    if (added.empty() || !is_apart<dim>(grid, holes, candidate.polar, rules.radius, rules.wall) ||
        !is_apart_from_its_images<dim>(grid, added.front(), rules.wall))
      continue;
    if (!holes.empty() && static_cast<double>(holes.size() + added.size()) * measure > rules.max_measure)
      continue;
    holes.insert(holes.end(), added.begin(), added.end());
  }
  return holes;
}

template <int dim>
LevelSet<dim> with_holes(const LevelSet<dim>& psi, std::span<const RoundHole<dim>> holes) {
  LevelSet<dim> result = redistance(psi);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    result.values[node] = std::max(result.values[node],
                                   distance_into(psi.lattice.grid(), holes, psi.lattice.polar_point(node)));
  for (const MirrorPlane plane : planes<dim>())
    if (is_mirror_symmetric(psi, plane) && is_mirror_symmetric(result, plane))
      result = mirror_symmetric_part(result, plane);
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                        \
  template decltype(middles_of_full_cells<dim>) middles_of_full_cells<dim>; \
  template decltype(best_places<dim>) best_places<dim>;                     \
  template decltype(with_holes<dim>) with_holes<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
