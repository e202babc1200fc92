#include "wheelwright/shape/evolution/followers.h"

#include <algorithm>

namespace wheelwright {

bool is_stopped(double room, double approach, double cell, double unchanged) {
  constexpr double part = 0.25, minimum = 0.01;  // of the motion; of a cell
  if (room < -unchanged) return true;
  return approach > std::max(room, 0.0) + unchanged && room < std::max(part * approach, minimum * cell);
}

double sum(const std::vector<Dependence>& dependences, std::span<const double> values) {
  double total = 0;
  for (const auto& [node, weight] : dependences) total += weight * values[node];
  return total;
}

std::vector<Dependence> on_roots(const std::vector<Dependence>& dependences, const Followers& followers) {
  std::vector<Dependence> all, result;
  for (const auto& [node, weight] : dependences)
    if (followers[node].empty())
      all.push_back({node, weight});
    else
      for (const auto& [root, share] : followers[node]) all.push_back({root, weight * share});
  std::ranges::stable_sort(all, {}, &Dependence::node);
  for (const auto& one : all)
    if (!result.empty() && result.back().node == one.node)
      result.back().weight += one.weight;
    else
      result.push_back(one);
  return result;
}

}  // namespace wheelwright
