#include "wheelwright/design/explore/pareto.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

using Costs = std::vector<std::vector<double>>;

bool is_known(const std::vector<double>& costs) {
  return std::ranges::none_of(costs, [](double cost) { return std::isnan(cost); });
}

/// The costs, scaled to [0, 1] over all known points.
Costs scaled(const std::vector<RatedPoint>& points) {
  Costs costs;
  for (const RatedPoint& point : points) costs.push_back(point.costs);
  const std::size_t n = costs.empty() ? 0 : costs.front().size();
  for (std::size_t d = 0; d < n; ++d) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& point : costs)
      if (is_known(point)) low = std::min(low, point[d]), high = std::max(high, point[d]);
    for (auto& point : costs) point[d] = high > low ? (point[d] - low) / (high - low) : 0;
  }
  return costs;
}

double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < a.size(); ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

/// The point in the list farthest from all chosen ones.
std::size_t farthest(const Costs& points, const std::vector<int>& list, const std::vector<int>& chosen) {
  std::size_t best = 0;
  double best_distance = -1;
  for (std::size_t k = 0; k < list.size(); ++k) {
    double nearest = HUGE_VAL;
    for (const int other : chosen)
      nearest = std::min(nearest, squared_distance(points[list[k]], points[other]));
    if (nearest > best_distance) best = k, best_distance = nearest;
  }
  return best;
}

}  // namespace

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool is_smaller = false;
  for (std::size_t d = 0; d < a.size(); ++d) {
    if (a[d] > b[d]) return false;
    is_smaller = is_smaller || a[d] < b[d];
  }
  return is_smaller;
}

bool is_better(const RatedPoint& a, const RatedPoint& b) {
  if (a.violation > 0 || b.violation > 0) return a.violation < b.violation;
  return dominates(a.costs, b.costs);
}

std::vector<int> fronts(const std::vector<RatedPoint>& points) {
  std::vector<int> front(points.size(), 0);
  std::vector<int> left;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_known(points[i].costs)) left.push_back(static_cast<int>(i));
  for (int number = 1; !left.empty(); ++number) {
    std::vector<int> dominated;
    for (const int i : left)
      if (std::ranges::any_of(left, [&](int other) { return is_better(points[other], points[i]); }))
        dominated.push_back(i);
      else
        front[i] = number;
    left = std::move(dominated);
  }
  return front;
}

std::vector<int> spread_order(const std::vector<RatedPoint>& points) {
  const Costs costs = scaled(points);
  const std::vector<int> front = fronts(points);
  std::vector<int> order;
  const int last = costs.empty() ? 0 : std::ranges::max(front);
  for (int number = 1; number <= last; ++number) {
    std::vector<int> members;
    for (std::size_t i = 0; i < costs.size(); ++i)
      if (front[i] == number) members.push_back(static_cast<int>(i));
    const auto choose = [&](std::size_t k) {
      order.push_back(members[k]);
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(k));
    };
    for (std::size_t d = 0; d < costs.front().size() && !members.empty(); ++d)
      choose(std::ranges::min_element(members, {}, [&](int i) { return costs[i][d]; }) - members.begin());
    while (!members.empty()) choose(farthest(costs, members, order));
  }
  return order;
}

}  // namespace wheelwright
