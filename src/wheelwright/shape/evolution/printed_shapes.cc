#include "wheelwright/shape/evolution/printed_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/shape/evolution/redistance.h"

namespace wheelwright {
namespace {

/// Half the width of a hole that no longer narrows, and how far beyond the reach the depth of a hole counts,
/// both in cells.
constexpr double narrowest = 1, beyond = 1.5;

/// Where a layer is so deep in the material, in cells, the next one may be deeper: half way to the second
/// depth, or by as much as it is beyond the third.
constexpr double inside = 0.5, well_inside = 1.5, far_inside = 1.75;

/// Places on the circle around a vertex at which its lowest and highest values are sought.
constexpr int n_directions = 16;

/// The minimum of values and their ceiling, unless they exceed it by less than this.
LevelSet<3> below(LevelSet<3> psi, const std::vector<double>& ceiling, double unchanged) {
  for (std::size_t i = 0; i < psi.values.size(); ++i)
    if (psi.values[i] > ceiling[i] + unchanged) psi.values[i] = ceiling[i];
  return psi;
}

}  // namespace

bool rises_from_the_plate(const LevelSet<3>& psi, SideFace plate) {
  const auto& lattice = psi.lattice;
  const int to = plate == SideFace::smaller_z ? 1 : -1;
  const double rounding = 1e-10 * lattice.grid().resolution();
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    auto place = lattice.node_position(node);
    place[2] += to;
    if (place[2] < 0 || place[2] >= lattice.nodes()[2]) continue;
    if (psi.values[lattice.node_index(place)] < psi.values[node] - rounding) return false;
  }
  return true;
}

PrintedShapes::PrintedShapes(const Lattice<3>& lattice, const Print& print, const Ceiling& ceiling)
    : lattice_(lattice),
      up_(print.plate == SideFace::smaller_z ? 1 : -1),
      cell_(longest_edge_across(lattice.grid())),
      layer_reach_(slope_on(lattice.grid(), print) * lattice.grid().axial_size()),
      unchanged_(1e-10 * lattice.grid().resolution()),
      ceiling_(ceiling.of_level_set.begin(), ceiling.of_level_set.end()),
      ceiling_of_coefficients_(ceiling.of_coefficients.begin(), ceiling.of_coefficients.end()) {}

int PrintedShapes::node_at(int line, int column, int layer) const {
  const int degree = lattice_.degree();
  return lattice_.node_index({degree * line, degree * column, degree * layer});
}

/// The dependence of the spline of a layer on its coefficients at a place in units of cells, or that of the
/// derivative of this order along the lines and the columns.
std::vector<Dependence> PrintedShapes::at(double line, double column, int layer,
                                          std::array<int, 2> order) const {
  const PolarGrid<3>& grid = lattice_.grid();
  const int i = std::min(static_cast<int>(line), grid.cells[0] - 1), j = static_cast<int>(std::floor(column));
  const auto across = spline_support(grid, 0, i), along = spline_support(grid, 1, j);
  const auto x = spline_derivative_weights(grid, 0, i, line - i)[order[0]],
             y = spline_derivative_weights(grid, 1, j, column - j)[order[1]];
  std::vector<Dependence> result;
  for (int b = 0; b < along.count; ++b)
    for (int a = 0; a < across.count; ++a)
      if (const double weight = x[a] * y[b]; weight != 0)
        result.push_back({node_at(across.first + a, along.first + b, layer), weight});
  return result;
}

/// The lengths of a cell of a row across the axle, at a radius [m].
std::array<double, 2> PrintedShapes::cell_lengths(double radius) const {
  const PolarGrid<3>& grid = lattice_.grid();
  return {grid.row_height(grid.row_at(radius)), radius * grid.column_angle()};
}

void PrintedShapes::Value::add(double factor, const Value& other) {
  value += factor * other.value;
  for (const auto& [node, weight] : other.of) of.push_back({node, factor * weight});
}

/// The spline of the coefficients of a layer at a place in units of cells.
PrintedShapes::Value PrintedShapes::spline(std::span<const double> values, const Spot& spot,
                                           int layer) const {
  Value result{0, at(spot.line, spot.column, layer)};
  result.value = sum(result.of, values);
  return result;
}

/// The same where the place moves with the coefficients: by `moves` lines and columns.
PrintedShapes::Value PrintedShapes::spline(std::span<const double> values, const Spot& spot, int layer,
                                           const std::array<Value, 2>& moves) const {
  Value result = spline(values, spot, layer);
  const std::array<std::array<int, 2>, 2> orders{{{1, 0}, {0, 1}}};
  for (int d = 0; d < 2; ++d) {
    const double slope = sum(at(spot.line, spot.column, layer, orders[d]), values);
    for (const auto& [node, weight] : moves[d].of) result.of.push_back({node, slope * weight});
  }
  return result;
}

/// The depth of the hole at a vertex of a layer: the largest value of the spline on the way uphill, as far as
/// its slope times a few cells. Beyond a ridge what is behind a valley does not count: twice the depth of the
/// valley is subtracted.
PrintedShapes::Value PrintedShapes::depth(std::span<const double> values, const Spot& spot, int layer) const {
  constexpr int n_steps = 8;
  constexpr double factor = 2;
  const PolarGrid<3>& grid = lattice_.grid();
  const double radius = grid.radius(spot.line), farthest = layer_reach_ + (narrowest + beyond) * cell_;
  const auto lengths = cell_lengths(radius);
  std::array<Value, 2> uphill;
  uphill[0].of = at(spot.line, spot.column, layer, {1, 0});
  uphill[1].of = at(spot.line, spot.column, layer, {0, 1});
  for (int d = 0; d < 2; ++d) {
    for (auto& one : uphill[d].of) one.weight /= lengths[d];
    uphill[d].value = sum(uphill[d].of, values);
  }
  const auto value_at = [&](int k) {
    const double distance = farthest * k / n_steps, there = radius + distance * uphill[0].value,
                 line = grid.line_at(there);
    std::array<Value, 2> moves;
    // Beyond the rim and the tread is nothing.
    if (line >= 0 && line <= grid.cells[0]) moves[0].add(distance / cell_lengths(there)[0], uphill[0]);
    moves[1].add(distance / lengths[1], uphill[1]);
    return spline(values, {std::clamp(line, 0.0, double(grid.cells[0])), spot.column + moves[1].value}, layer,
                  moves);
  };
  Value deepest = value_at(0), highest = deepest, valley;
  for (int k = 1; k <= n_steps; ++k) {
    const Value value = value_at(k);
    Value behind = value;
    behind.add(-factor, valley);
    if (behind.value > deepest.value) deepest = behind;
    if (value.value > highest.value) highest = value;
    Value valley_here = highest;
    valley_here.add(-1, value);
    if (valley_here.value > valley.value) valley = valley_here;
  }
  return deepest;
}

/// By how much the spline falls from a vertex to the lowest place within a distance, and by how much it rises
/// to the highest one.
PrintedShapes::Fall PrintedShapes::fall(std::span<const double> values, const Spot& spot, int layer,
                                        const Value& distance) const {
  const PolarGrid<3>& grid = lattice_.grid();
  const double radius = grid.radius(spot.line);
  const Value here = spline(values, spot, layer);
  Fall result;
  for (int k = 0; k < n_directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / n_directions;
    const double outwards = radius + distance.value * std::cos(angle),
                 across = distance.value * std::sin(angle), there = std::hypot(outwards, across);
    const Spot point{grid.line_at(there), spot.column + std::atan2(across, outwards) / grid.column_angle()};
    if (point.line < 0 || point.line > grid.cells[0]) continue;
    const double change = sum(at(point.line, point.column, layer), values) - here.value;
    if (change >= -result.down.value && change <= result.up.value) continue;
    const auto lengths = cell_lengths(there);
    std::array<Value, 2> moves;
    moves[0].add((outwards * std::cos(angle) + across * std::sin(angle)) / there / lengths[0], distance);
    moves[1].add((outwards * std::sin(angle) - across * std::cos(angle)) / there / lengths[1], distance);
    Value difference = spline(values, point, layer, moves);
    difference.add(-1, here);
    if (change > 0) {
      result.up = difference;
    } else {
      result.down = {};
      result.down.add(-1, difference);
    }
  }
  return result;
}

/// The least value that the coefficient of a vertex may have, by those of the layer before it. From one layer
/// to the next it decreases by as much as their spline falls within the reach, and by no more than that rises
/// within it: ridges of holes do not sink, unless the hole is deep.
PrintedShapes::Value PrintedShapes::bound(std::span<const double> values, int line, int column,
                                          int layer) const {
  const Spot spot{double(line), double(column)};
  const int at_vertex = node_at(line, column, layer);
  Value result{values[at_vertex], {{at_vertex, 1}}};
  if (layer_reach_ == 0) return result;
  // A valley in the material may sink: else the edges beside it would lean too far.
  Value sink = spline(values, spot, layer);
  for (auto& one : sink.of) one.weight *= -1;
  sink.value = -sink.value - inside * cell_;
  Value most;
  if (result.value > -well_inside * cell_) {
    most.add(0.5, result);  // never all the way, where the bound has a kink
    most.value += 0.5 * well_inside * cell_;
  } else if (result.value < -far_inside * cell_) {
    most.add(-1, result);
    most.value -= far_inside * cell_;
  }
  if (sink.value > 0) result.add(-1, sink.value < most.value ? sink : most);
  Value room = depth(values, spot, layer);
  room.value -= narrowest * cell_;
  if (room.value <= 0) return result;
  Value rest;  // of a deep hole
  if (room.value > layer_reach_) {
    rest = room;
    rest.value -= layer_reach_;
    room = {layer_reach_, {}};
  }
  auto [down, up] = fall(values, spot, layer, room);
  up.add(1, rest);
  result.add(-1, down.value < up.value ? down : up);
  return result;
}

/// Calls visit(layer, layer before it) for all layers but the first one, from the plate on.
template <class Visit>
void PrintedShapes::for_each_layer(Visit visit) const {
  const int layers = lattice_.grid().cells[2];
  for (int k = 1; k <= layers; ++k)
    if (up_ > 0)
      visit(k, k - 1);
    else
      visit(layers - k, layers - k + 1);
}

/// Calls visit(line, column) for all vertices of a layer.
template <class Visit>
void PrintedShapes::for_each_vertex(Visit visit) const {
  const auto& cells = lattice_.grid().cells;
  for (int column = 0; column < cells[1]; ++column)
    for (int line = 0; line <= cells[0]; ++line) visit(line, column);
}

/// The smallest coefficients above these that rest on those of the layer before them.
LevelSet<3> PrintedShapes::supported(LevelSet<3> coefficients) const {
  auto& c = coefficients.values;
  for_each_layer([&](int layer, int before) {
    for_each_vertex([&](int line, int column) {
      double& value = c[node_at(line, column, layer)];
      if (value >= c[node_at(line, column, before)]) return;  // the bound is not above that
      const double least = bound(c, line, column, before).value;
      if (value < least - unchanged_) value = least;
    });
  });
  return coefficients;
}

LevelSet<3> PrintedShapes::keep_coefficients(LevelSet<3> coefficients) const {
  return supported(below(std::move(coefficients), ceiling_of_coefficients_, unchanged_));
}

LevelSet<3> PrintedShapes::keep(LevelSet<3> psi) const {
  psi = below(std::move(psi), ceiling_, 0);
  const auto coefficients = spline_coefficients(psi);
  // Deep in the material nothing needs support.
  const auto is_kept = [&](double before, double after) {
    return before == after || after < -well_inside * cell_;
  };
  if (std::ranges::equal(coefficients.values, supported(coefficients).values, is_kept)) return psi;
  const auto allowed = [&](LevelSet<3> c) {
    return below(spline_level_set(keep_coefficients(std::move(c))), ceiling_, 0);
  };
  // Nothing hangs over: only the coefficients of a spline oscillate where the level set has kinks.
  if (rises_from_the_plate(psi, up_ > 0 ? SideFace::smaller_z : SideFace::larger_z))
    return allowed(coefficients);
  // The slopes of a drawn level set are not those of a distance, which the spline between layers needs.
  constexpr int rounds = 3;
  psi = allowed(coefficients);
  for (int k = 0; k < rounds; ++k) psi = allowed(redistanced_coefficients(psi));
  return psi;
}

bool PrintedShapes::follow(const LevelSet<3>& coefficients, const LevelSet<3>& moved,
                           Following& following) const {
  const double cell = lattice_.grid().resolution();
  const std::size_t n = coefficients.values.size();
  bool is_more = false;
  auto& followers = following.coefficients;
  followers.resize(n);
  const LevelSet<3> now = keep_coefficients(coefficients);
  std::vector<double> change(n);
  for (std::size_t i = 0; i < n; ++i) change[i] = moved.values[i] - coefficients.values[i];
  for_each_layer([&](int layer, int before) {
    for_each_vertex([&](int line, int column) {
      const int node = node_at(line, column, layer);
      if (!followers[node].empty()) {
        followers[node] = on_roots(followers[node], followers);  // which may follow others by now
        change[node] = sum(followers[node], change);
        return;
      }
      const Value least = bound(now.values, line, column, before);
      const double approach = sum(least.of, change) - change[node];
      if (!is_stopped(coefficients.values[node] - least.value, approach, cell, unchanged_)) return;
      followers[node] = on_roots(least.of, followers);
      change[node] = sum(followers[node], change);
      is_more = true;
    });
  });
  return is_more;
}

}  // namespace wheelwright
