#pragma once

#include <vector>

namespace wheelwright {

/// Whether costs `a` are nowhere larger than `b` and somewhere smaller.
bool dominates(const std::vector<double>& a, const std::vector<double>& b);

/// The front of every point, by its costs: 1 for the points that no other one dominates, 2 for those that
/// only points of front 1 dominate, and so on; 0 for points with a cost that is NaN. Equal points share a
/// front.
std::vector<int> fronts(const std::vector<std::vector<double>>& costs);

/// The order in which points are worth more effort: front after front; within a front the ends of every cost
/// come first, then the points farthest from those chosen before (distances relative to the span of each
/// cost). Points of front 0 are left out. Ties go to the smaller index.
std::vector<int> spread_order(const std::vector<std::vector<double>>& costs);

}  // namespace wheelwright
