#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/evolution/spline_level_set.h"

namespace wheelwright {

/// Values at nodes that follow others: of each its linear dependence on those that do not, which have an
/// empty one. Empty: none follows.
using Followers = std::vector<std::vector<Dependence>>;

/// The values that follow other values while a shape moves.
struct Following {
  Followers coefficients;    ///< of the level set's spline
  Followers control_points;  ///< of the level set, between the vertices of the cells

  bool any() const { return !coefficients.empty() || !control_points.empty(); }
};

/// Whether a value with this room above its bound is stopped while it approaches the bound: it could make
/// less than a quarter of its move.
bool is_stopped(double room, double approach, double cell, double unchanged);

/// The change of a function of values with these changes.
double sum(const std::vector<Dependence>& dependences, std::span<const double> values);

/// The dependence on those that do not follow others, each once.
std::vector<Dependence> on_roots(const std::vector<Dependence>& dependences, const Followers& followers);

}  // namespace wheelwright
