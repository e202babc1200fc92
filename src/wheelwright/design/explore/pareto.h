#pragma once

#include <vector>

namespace wheelwright {

/// Whether costs `a` are nowhere larger than `b` and somewhere smaller.
bool dominates(const std::vector<double>& a, const std::vector<double>& b);

/// The costs of a point, and by how much it violates its bounds: 0 if it keeps them.
struct RatedPoint {
  std::vector<double> costs;
  double violation = 0;
};

/// Whether a point is better than another: it violates its bounds less, or both keep them and its costs
/// dominate (Deb, Computer Methods in Applied Mechanics and Engineering 186, 2000).
bool is_better(const RatedPoint& a, const RatedPoint& b);

/// The front of every point: 1 for the points that no other one is better than, 2 for those that only points
/// of front 1 are better than, and so on; 0 for points with a cost that is NaN. Equal points share a front.
std::vector<int> fronts(const std::vector<RatedPoint>& points);

/// The order in which points are worth more effort: front after front; within a front the ends of every cost
/// come first, then the points farthest from those chosen before (distances relative to the span of each
/// cost). Points of front 0 are omitted. Ties go to the smaller index.
std::vector<int> spread_order(const std::vector<RatedPoint>& points);

}  // namespace wheelwright
