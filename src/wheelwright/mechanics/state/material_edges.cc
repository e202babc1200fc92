#include "wheelwright/mechanics/state/material_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>

#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {
namespace {

MaterialEdges<2>::Point edge_point(const Vec<2>& x, const Lattice<2>& lattice) {
  const PolarGrid<2>& grid = lattice.grid();
  const double azimuth = std::atan2(x[1], x[0]),
               turn = azimuth < 0 ? azimuth + 2 * std::numbers::pi : azimuth;
  const double along[2] = {grid.line_at(norm<2>(x)), turn / grid.column_angle()};
  const int cells[2] = {grid.cells[0], grid.ring_columns()};
  std::array<int, 2> cell;
  Vec<2> xi;
  for (int d = 0; d < 2; ++d) {
    cell[d] = std::clamp(static_cast<int>(along[d]), 0, cells[d] - 1);
    xi[d] = std::clamp(along[d] - cell[d], 0.0, 1.0);
  }
  return {x, ring_cell_nodes<2>(lattice, cell), ShapeFunctions<2>(lattice.degree(), xi).value};
}

Vec<2> deformed(const MaterialEdges<2>::Point& point, const RingField& u, int n_nodes) {
  const std::span nodes(point.nodes.data(), static_cast<size_t>(n_nodes));
  const std::span shape(point.shape.data(), static_cast<size_t>(n_nodes));
  return {point.x[0] + interpolate(u, nodes, shape, 0), point.x[1] + interpolate(u, nodes, shape, 1)};
}

struct Side {
  Vec<2> from, to;
  size_t curve, index;  ///< of its curve, and along it
};

double turn(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c) { return cross(b - a, c - a); }

/// Whether the inner parts of two sides cross.
bool cross(const Side& a, const Side& b) {
  return turn(a.from, a.to, b.from) * turn(a.from, a.to, b.to) < 0 &&
         turn(b.from, b.to, a.from) * turn(b.from, b.to, a.to) < 0;
}

/// Two sides of closed polylines that cross, other than neighbours. Sides are sorted into squares as wide as
/// the longest of them, so that each meets those of nine squares at most.
std::optional<std::pair<Side, Side>> crossing_sides(const std::vector<std::vector<Vec<2>>>& curves) {
  std::vector<Side> sides;
  double longest = 0;
  for (size_t c = 0; c < curves.size(); ++c)
    for (size_t k = 0; k < curves[c].size(); ++k) {
      const Side side{curves[c][k], curves[c][(k + 1) % curves[c].size()], c, k};
      longest = std::max(longest, distance(side.from, side.to));
      sides.push_back(side);
    }
  const auto square = [&](double x) { return static_cast<std::int64_t>(std::floor(x / longest)); };
  const auto key = [](std::int64_t i, std::int64_t j) { return i * 4294967291 + j; };
  std::unordered_map<std::int64_t, std::vector<size_t>> squares;
  for (size_t s = 0; s < sides.size(); ++s) {
    const std::int64_t i = square(sides[s].from[0]), j = square(sides[s].from[1]);
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        if (const auto found = squares.find(key(i + di, j + dj)); found != squares.end())
          for (const size_t t : found->second)
            if (cross(sides[s], sides[t])) return std::pair(sides[t], sides[s]);
    squares[key(i, j)].push_back(s);
  }
  return {};
}

/// (1 - share) a + share b.
RingField between(const RingField& a, const RingField& b, double share) {
  RingField result = b;
  for (size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = (1 - share) * a.values[i] + share * b.values[i];
  return result;
}

template <int dim>
std::string place_text(const Vec<dim>& x) {
  const double azimuth = std::atan2(x[1], x[0]) * 180 / std::numbers::pi;
  return fmt::format("radius {:.4g} mm, {:.4g} deg", 1e3 * std::hypot(x[0], x[1]),
                     azimuth < 0 ? azimuth + 360 : azimuth);
}

}  // namespace

template <>
MaterialEdges<2>::MaterialEdges(const LevelSet<2>& psi, const Lattice<2>& lattice)
    : nodes_per_cell_(nodes_per_cell<2>(lattice.degree())) {
  for (const Contour& contour : material_contours(psi, 2)) {
    auto& edge = edges_.emplace_back();
    for (const Vec<2>& x : contour.points) edge.push_back(edge_point(x, lattice));
  }
}

template <>
MaterialEdges<3>::MaterialEdges(const LevelSet<3>&, const Lattice<3>& lattice)
    : nodes_per_cell_(nodes_per_cell<3>(lattice.degree())) {}

template <>
std::optional<EdgeCrossing<2>> MaterialEdges<2>::crossing(const RingField& u) const {
  std::vector<std::vector<Vec<2>>> curves;
  for (const auto& edge : edges_) {
    auto& curve = curves.emplace_back();
    for (const Point& point : edge) curve.push_back(deformed(point, u, nodes_per_cell_));
  }
  const auto sides = crossing_sides(curves);
  if (!sides) return {};
  const auto undeformed = [&](const Side& side) {
    const auto& edge = edges_[side.curve];
    return 0.5 * (edge[side.index].x + edge[(side.index + 1) % edge.size()].x);
  };
  return EdgeCrossing<2>{undeformed(sides->first), undeformed(sides->second), 1};
}

template <>
std::optional<EdgeCrossing<3>> MaterialEdges<3>::crossing(const RingField&) const {
  return {};
}

template <int dim>
bool MaterialEdges<dim>::overlap(const RingField& u) const {
  return crossing(u).has_value();
}

template <int dim>
std::optional<EdgeCrossing<dim>> MaterialEdges<dim>::first_crossing(const RingField& from,
                                                                    const RingField& to) const {
  constexpr double accuracy = 1e-3;
  auto found = crossing(to);
  if (!found) return {};
  for (double free = 0; found->share - free > accuracy;) {
    const double share = 0.5 * (free + found->share);
    if (auto earlier = crossing(between(from, to, share))) {
      found = *std::move(earlier);
      found->share = share;
    } else {
      free = share;
    }
  }
  return found;
}

template <int dim>
std::optional<EdgeCrossing<dim>> MaterialEdges<dim>::first_crossing(const RingField& to) const {
  return first_crossing({to.components, std::vector<double>(to.values.size())}, to);
}

template <int dim>
Failure overlap_failure(double travel, const EdgeCrossing<dim>& place, std::optional<double> load) {
  const std::string at_load = load ? fmt::format(", first at about {:.4g} N/m", *load) : "";
  return {FailureReason::material_overlaps,
          fmt::format("deformed edges cross each other at a rim travel of {:.3g} % of the ring's "
                      "thickness{}: the edge at {} meets that at {} (undeformed)",
                      100 * travel, at_load, place_text<dim>(place.on_one), place_text<dim>(place.on_other)),
          load};
}

template class MaterialEdges<2>;
template class MaterialEdges<3>;
template Failure overlap_failure(double, const EdgeCrossing<2>&, std::optional<double>);
template Failure overlap_failure(double, const EdgeCrossing<3>&, std::optional<double>);

}  // namespace wheelwright
