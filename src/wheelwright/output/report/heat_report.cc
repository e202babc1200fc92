#include "wheelwright/output/report/heat_report.h"

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "wheelwright/output/report/value_with_error.h"

namespace wheelwright {
namespace {

/// A way out of the wheel.
struct HeatExit {
  const char* name;
  const char* key;
  double power;
};

std::array<HeatExit, 4> exits(const HeatResults& results) {
  return {{{"the rim", "through_rim_W", results.through_rim},
           {"the tread", "through_tread_W", results.through_tread},
           {"the holes", "through_holes_W", results.through_holes},
           {"the side faces", "through_side_faces_W", results.through_side_faces}}};
}

using Json = nlohmann::ordered_json;

Json peak_json(const HeatResults::Peak& peak, int dimension) {
  Json json{{"temperature_deg_C", peak.temperature},
            {"place", {{"radius_m", peak.place[0]}, {"azimuth_rad", peak.place[1]}}}};
  if (dimension == 3) json["place"]["z_m"] = peak.place[2];
  if (peak.limit) {
    json["maximum_temperature_deg_C"] = *peak.limit;
    json["is_too_warm"] = peak.is_too_warm();
  }
  return json;
}

}  // namespace

std::vector<std::string> too_warm(const HeatResults& results, const std::vector<std::string>& layers) {
  std::vector<std::string> sentences;
  const auto add = [&](const HeatResults::Peak& peak, const std::string& name) {
    if (peak.is_too_warm())
      sentences.push_back(
          fmt::format("{} gets {:.1f} deg C warm while it rolls, {:.1f} K more than its maximum_temperature "
                      "of {:g} deg C",
                      name, peak.temperature, peak.temperature - *peak.limit, *peak.limit));
  };
  if (results.by_layer.empty()) add(results.peak, "the material");
  for (std::size_t k = 0; k < results.by_layer.size(); ++k) add(results.by_layer[k], layers[k]);
  return sentences;
}

std::string heat_lines(const HeatResults& results, const HeatContext& context) {
  std::string lines = fmt::format(
      "peak temperature {} deg C, at radius {:.1f} mm, azimuth {:.2f} deg; air {:g} deg C\n",
      context.error ? text_with_error(results.peak.temperature, *context.error)
                    : fmt::format("{:.2f}", results.peak.temperature),
      results.peak.place[0] * 1e3, results.peak.place[1] * 180 / std::numbers::pi, results.ambient);
  lines += fmt::format("heat {:.4g} W", results.heat * context.width_factor);
  const char* separator = ": ";
  for (const HeatExit& way : exits(results)) {
    if (way.power == 0) continue;
    lines += fmt::format("{}{:.4g} W through {}", separator, way.power * context.width_factor, way.name);
    separator = ", ";
  }
  lines += '\n';
  for (std::size_t k = 0; k < results.by_layer.size(); ++k)
    lines += fmt::format("  {}: up to {:.4g} deg C\n", context.layers[k], results.by_layer[k].temperature);
  return lines;
}

Json heat_json(const HeatResults& results, const HeatContext& context) {
  Json json = peak_json(results.peak, context.dimension);
  json["ambient_temperature_deg_C"] = results.ambient;
  json["heat_W"] = results.heat * context.width_factor;
  for (const HeatExit& way : exits(results)) json[way.key] = way.power * context.width_factor;
  for (std::size_t k = 0; k < results.by_layer.size(); ++k)
    json["by_layer"][context.layers[k]] = peak_json(results.by_layer[k], context.dimension);
  if (context.error) json["errors"] = {{"temperature_deg_C", *context.error}};
  return json;
}

}  // namespace wheelwright
