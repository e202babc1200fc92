#include "wheelwright/quantities/analysis/rolling_measures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <numeric>

namespace wheelwright {
namespace {

/// A contact point along the ground.
struct GroundPoint {
  double along;      ///< [m]
  double augmented;  ///< normal component of z [Pa], negative in contact
};

bool touches(const GroundPoint& p) { return p.augmented < 0; }

/// The centre of the pressure.
double centre_of_pressure(std::span<const GroundPoint> points) {
  double sum = 0, moment = 0;
  for (const GroundPoint& p : points) {
    const double pressure = std::max(-p.augmented, 0.0);
    sum += pressure;
    moment += pressure * p.along;
  }
  return moment / sum;
}

/// The end of a lobe beyond its last point in contact. The square of Hertz's pressure is a straight line over
/// the square of the distance to the centre: here the one through the outer points with 0.1 to 0.6 of the
/// peak, because the discrete pressure is smeared in the last cell. Where this line ends more than a cell
/// from the last point, the pressure is not Hertz's, and the end is halfway to the next point.
double end_of_lobe(std::span<const GroundPoint> points) {
  constexpr std::ptrdiff_t points_of_cell = 5;  // as many as a contact face has by default
  const auto last = std::find_if(points.rbegin(), points.rend(), touches).base() - 1;
  if (last + 1 == points.end()) return last->along;
  const double halfway = 0.5 * (last->along + (last + 1)->along);
  const double cell = last->along - (last - std::min(points_of_cell, last - points.begin()))->along;
  const double peak = -std::ranges::min(points, {}, &GroundPoint::augmented).augmented;
  const double centre = centre_of_pressure(points);
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (auto p = std::reverse_iterator(last + 1); p != points.rend() && -p->augmented < 0.6 * peak; ++p) {
    if (-p->augmented < 0.1 * peak) continue;
    const double x = (p->along - centre) * (p->along - centre), y = p->augmented * p->augmented;
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double spread = n * sxx - sx * sx, slope = (n * sxy - sx * sy) / spread;
  if (!(n >= 2 && slope < 0)) return halfway;
  const double end = centre + std::sqrt((sx - sy / slope) / n);
  return std::abs(end - halfway) <= cell ? end : halfway;
}

/// For each place along the ground, the point across the width with the highest pressure.
std::vector<GroundPoint> most_pressed(std::vector<GroundPoint> points) {
  std::ranges::sort(points, {}, &GroundPoint::along);
  const double same = 1e-9 * (points.back().along - points.front().along);
  std::vector<GroundPoint> result;
  for (const GroundPoint& p : points) {
    if (result.empty() || p.along - result.back().along > same)
      result.push_back(p);
    else
      result.back().augmented = std::min(result.back().augmented, p.augmented);
  }
  return result;
}

/// The places where contact starts and ends.
struct Lobe {
  double begin, end;  ///< along the ground [m]
};

/// The arguments are the points of a lobe, in their order along the ground, and the next one on either side.
Lobe lobe_of(std::vector<GroundPoint> points) {
  const double end = end_of_lobe(points);
  for (GroundPoint& p : points) p.along = -p.along;
  std::ranges::reverse(points);
  return {-end_of_lobe(points), end};
}

/// The lobes of the patch in their order along the ground. An end that faces another lobe lies no farther
/// than the first point that does not touch.
std::vector<Lobe> lobes(std::vector<GroundPoint> points) {
  std::vector<Lobe> result;
  if (std::ranges::none_of(points, touches)) return result;
  points = most_pressed(std::move(points));
  const auto all_begin = points.begin(), all_end = points.end();
  for (auto first = std::find_if(all_begin, all_end, touches); first != all_end;) {
    const auto behind = std::find_if_not(first, all_end, touches);
    const auto from = first == all_begin ? first : first - 1, to = behind == all_end ? behind : behind + 1;
    const auto next = std::find_if(behind, all_end, touches);
    Lobe lobe = lobe_of({from, to});
    if (!result.empty()) lobe.begin = std::max(lobe.begin, from->along);
    if (next != all_end) lobe.end = std::min(lobe.end, behind->along);
    result.push_back(lobe);
    first = next;
  }
  return result;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

template <int dim>
ContactSummary contact_summary(const ContactPatch<dim>& contact) {
  ContactSummary summary{.travel = contact.travel(),
                         .radial_force = 0,
                         .peak_pressure = 0,
                         .patch_length = 0,
                         .patch_extent = 0,
                         .travel_along_ground = contact.rim.along_ground,
                         .wind_up = contact.rim.rotation,
                         .descent = contact.rim.towards_ground,
                         .stiffness = contact.stiffness};
  std::vector<GroundPoint> points;
  for (const auto& point : contact.points) {
    const Vec<dim> on_ground = point.ground_traction();
    summary.radial_force -= point.weight * on_ground[0];
    summary.peak_pressure = std::max(summary.peak_pressure, point.pressure());
    summary.friction_force += point.weight * on_ground[1];
    summary.peak_friction = std::max(summary.peak_friction, std::abs(point.stress()[1]));
    points.push_back({point.place()[1], point.augmented[0] / point.stretch});
  }
  const auto patch = lobes(std::move(points));
  for (const Lobe& lobe : patch) summary.patch_length += lobe.end - lobe.begin;
  if (!patch.empty()) summary.patch_extent = patch.back().end - patch.front().begin;
  return summary;
}

ContactSummary mirror_image(ContactSummary position) {
  for (double* value : {&position.friction_force, &position.travel_along_ground, &position.wind_up})
    *value = 0 - *value;  // zero stays positive
  return position;
}

RollingVariation rolling_variation(std::span<const double> values) {
  const int n = static_cast<int>(values.size());
  const auto [minimum, maximum] = std::ranges::minmax(values);
  RollingVariation variation{mean(values), minimum, maximum, {}};
  for (int k = 1; 2 * k < n; ++k) {
    std::complex<double> sum = 0;
    for (int j = 0; j < n; ++j)
      sum += (values[j] - variation.mean) * std::polar(1.0, -2 * std::numbers::pi * (k * j % n) / n);
    variation.harmonics.push_back(2 * std::abs(sum) / n);
  }
  return variation;
}

RollingMeasures rolling_measures(std::span<const ContactSummary> positions) {
  std::vector<double> travel, descent, peak;
  for (const ContactSummary& position : positions) {
    travel.push_back(position.travel);
    descent.push_back(position.descent);
    peak.push_back(position.peak_pressure);
  }
  const auto [highest, lowest] = std::ranges::minmax(descent);
  const auto [least_peak, greatest_peak] = std::ranges::minmax(peak);
  return {mean(travel), lowest - highest, greatest_peak, (greatest_peak - least_peak) / mean(peak)};
}

template decltype(contact_summary<2>) contact_summary<2>;
template decltype(contact_summary<3>) contact_summary<3>;

}  // namespace wheelwright
