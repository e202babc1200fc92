#include "wheelwright/case/ground_of.h"

#include <fmt/format.h>

namespace wheelwright {

bool has_ground(const Load& load) {
  if (load.ground == "flat") return true;
  if (load.ground == "kerb") return load.ground_height.has_value();
  if (load.ground == "profile") return !load.ground_profile.empty();
  return load.ground_radius.has_value();
}

Ground ground_of(const Load& load) {
  if (load.ground == "flat" || !has_ground(load)) return {};
  if (load.ground == "drum") return Ground::drum(*load.ground_radius);
  if (load.ground == "internal_drum") return Ground::internal_drum(*load.ground_radius);
  if (load.ground == "bar")
    return Ground::bar(load.ground_place, *load.ground_radius,
                       load.ground_height.value_or(2 * *load.ground_radius));
  if (load.ground == "kerb")
    return Ground::kerb(load.ground_place, *load.ground_height, load.ground_radius.value_or(0));
  std::vector<Vec<2>> points;
  for (const auto& [along, height] : load.ground_profile)
    points.push_back({load.ground_place + along, height});
  return Ground::profile(points);
}

std::string ground_text(const Load& load) {
  std::string text = load.ground;
  const auto add = [&](const char* name, std::optional<double> value) {
    if (value) text += fmt::format(", {} {:.6g} mm", name, *value * 1e3);
  };
  if (load.ground == "profile") text += fmt::format(" of {} points", load.ground_profile.size());
  if (load.ground != "flat" && load.ground != "profile") add("radius", load.ground_radius);
  if (load.ground == "bar" || load.ground == "kerb") add("height", load.ground_height);
  if (!ground_of(load).is_even()) add("place", load.ground_place);
  return text;
}

}  // namespace wheelwright
