#include "wheelwright/output/report/cell_means.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace wheelwright {
namespace {

constexpr std::array averaged{
    &ContactPoint::azimuth,       &ContactPoint::x,   &ContactPoint::pressure, &ContactPoint::friction,
    &ContactPoint::normal_stress, &ContactPoint::gap, &ContactPoint::z,        &ContactPoint::axial_friction};

/// Adds a point to the mean of those before.
void add(const ContactPoint& point, ContactPoint& mean) {
  mean.weight += point.weight;
  for (const auto member : averaged)
    mean.*member += point.weight / mean.weight * (point.*member - mean.*member);
}

}  // namespace

std::vector<ContactPoint> cell_means(std::span<const ContactPoint> points) {
  std::map<std::pair<int, int>, ContactPoint> means;
  for (const ContactPoint& point : points)
    if (const auto [mean, is_new] = means.try_emplace({point.position, point.cell}, point); !is_new)
      add(point, mean->second);
  std::vector<ContactPoint> result;
  for (const auto& [place, mean] : means) result.push_back(mean);
  std::ranges::stable_sort(result, [](const ContactPoint& a, const ContactPoint& b) {
    return std::pair(a.position, a.x) < std::pair(b.position, b.x);
  });
  return result;
}

}  // namespace wheelwright
