#include "wheelwright/analysis/rolling_measures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace wheelwright {
namespace {

/// A contact point along the ground.
struct GroundPoint {
  double along;      ///< [m]
  double augmented;  ///< normal component of z [Pa], negative in contact
};

double zero_between(const GroundPoint& in_contact, const GroundPoint& open) {
  return in_contact.along +
         in_contact.augmented / (in_contact.augmented - open.augmented) * (open.along - in_contact.along);
}

double patch_length(std::vector<GroundPoint> points) {
  std::ranges::sort(points, {}, &GroundPoint::along);
  const auto touches = [](const GroundPoint& p) { return p.augmented < 0; };
  const auto first = std::ranges::find_if(points, touches);
  if (first == points.end()) return 0;
  const auto last = std::find_if(points.rbegin(), points.rend(), touches).base() - 1;
  const double begin = first == points.begin() ? first->along : zero_between(*first, *(first - 1));
  const double end = last + 1 == points.end() ? last->along : zero_between(*last, *(last + 1));
  return end - begin;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

template <int dim>
ContactSummary contact_summary(const ContactPatch<dim>& contact) {
  ContactSummary summary{
      .travel = contact.rim.towards_ground, .radial_force = 0, .peak_pressure = 0, .patch_length = 0};
  std::vector<GroundPoint> points;
  for (const auto& point : contact.points) {
    const double pressure = -point.traction[0];
    summary.radial_force += point.weight * pressure;
    summary.peak_pressure = std::max(summary.peak_pressure, pressure);
    points.push_back({point.position[1], point.augmented[0]});
  }
  summary.patch_length = patch_length(std::move(points));
  return summary;
}

RollingVariation rolling_variation(std::span<const double> values) {
  const int n = static_cast<int>(values.size());
  const auto [least, greatest] = std::ranges::minmax(values);
  RollingVariation variation{mean(values), least, greatest, {}};
  for (int k = 1; 2 * k < n; ++k) {
    std::complex<double> sum = 0;
    for (int j = 0; j < n; ++j)
      sum += (values[j] - variation.mean) * std::polar(1.0, -2 * std::numbers::pi * (k * j % n) / n);
    variation.harmonics.push_back(2 * std::abs(sum) / n);
  }
  return variation;
}

RollingMeasures rolling_measures(std::span<const ContactSummary> positions) {
  std::vector<double> travel, peak;
  for (const ContactSummary& position : positions) {
    travel.push_back(position.travel);
    peak.push_back(position.peak_pressure);
  }
  const auto [least_travel, greatest_travel] = std::ranges::minmax(travel);
  const auto [least_peak, greatest_peak] = std::ranges::minmax(peak);
  return {mean(travel), greatest_travel - least_travel, greatest_peak,
          (greatest_peak - least_peak) / mean(peak)};
}

template ContactSummary contact_summary(const ContactPatch<2>&);
template ContactSummary contact_summary(const ContactPatch<3>&);

}  // namespace wheelwright
