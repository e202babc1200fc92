#include <fmt/format.h>

#include <optional>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/widest_gap.h"

namespace wheelwright {

namespace {

/// Finds minimum widths that contradict the bands or the ring.
void check_feature_size(const Case& c, Conflicts& found) {
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius;
  const auto check = [&](const CaseKey& key, std::optional<double> width) {
    if (width && *width >= ring)
      found.push_back({with_ring_shape({key}), fmt::format("the ring is only {:.6g} m thick", ring),
                       "reduce it" + if_in_millimetres(*width, ring)});
  };
  check(key_of(&Optimizer::minimum_wall), c.optimizer.minimum_wall);
  check(key_of(&Optimizer::minimum_gap), c.optimizer.minimum_gap);
  if (const auto radius = c.optimizer.minimum_radius)
    if (2 * *radius >= ring)
      found.push_back({with_ring_shape({key_of(&Optimizer::minimum_radius)}),
                       fmt::format("gaps are twice as wide, and the ring is only {:.6g} m thick", ring),
                       "reduce it" + if_in_millimetres(*radius, 0.5 * ring)});
  const auto check_band_of = [&](const CaseKey& key, std::optional<double> band) {
    if (band && c.optimizer.minimum_wall && *band < *c.optimizer.minimum_wall)
      found.push_back({{key_of(&Optimizer::minimum_wall), key},
                       fmt::format("the wall between a hole and this edge may be {:.6g} m", *band),
                       "use a band at least as thick as the wall, or omit it"});
  };
  check_band_of(key_of(&Optimizer::rim_band), c.optimizer.rim_band);
  check_band_of(key_of(&Optimizer::tread_band), c.optimizer.tread_band);
}

/// Finds a minimum radius of corners that the method or the shapes do not support.
void check_least_radius(const Case& c, Conflicts& found) {
  if (c.optimizer.minimum_radius.value_or(0) == 0) return;
  if (level_set_degree(c) == 1)
    found.push_back({{key_of(&Optimizer::minimum_radius), key_of(&Grid::level_set_degree)},
                     "edges of degree 1 have a corner in every cell",
                     "use level_set_degree = 2, or omit the radius"});
  if (optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{key_of(&Optimizer::minimum_radius), key_of(&Optimizer::method)},
                     "steepest descent does not move splines, which have rounded corners",
                     "omit optimizer.method, or the radius"});
}

}  // namespace

void width_conflicts(const Case& c, Conflicts& found) {
  check_feature_size(c, found);
  check_least_radius(c, found);
}

void widest_gap_conflicts(const Case& c, Conflicts& found) {
  const bool is_plane_drawing = c.holes.spheres.empty() && c.holes.tapered.empty() &&
                                c.holes.grooves.empty() && !c.saved_shape.shape.contents;
  if (!is_plane_drawing || !(c.optimizer.minimum_gap || c.optimizer.minimum_radius)) return;
  const WidestGap widest = widest_gap(c);
  if (widest.diameter <= 0) return;
  const auto check = [&](const CaseKey& key, std::optional<double> given, double widths_of_a_gap) {
    if (!given || *given <= widths_of_a_gap * widest.at_most) return;
    const double fits = widths_of_a_gap * widest.diameter;
    found.push_back(
        {{key},
         fmt::format("all holes would be filled, because none is wider than {:.4g} m", widest.at_most),
         fmt::format("use less than {:.4g}, or draw wider holes", fits) + if_in_millimetres(*given, fits)});
  };
  check(key_of(&Optimizer::minimum_gap), c.optimizer.minimum_gap, 1);
  check(key_of(&Optimizer::minimum_radius), c.optimizer.minimum_radius, 0.5);
}

}  // namespace wheelwright
