#include "wheelwright/report/run_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "wheelwright/base/units.h"
#include "wheelwright/report/comparison_table.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

/// The numbers that depend on the load, under every other load case.
template <int dim>
Json load_cases_json(const DescribedWheel<dim>& wheel) {
  Json json = Json::object();
  for (const DescribedWheel<dim>& other : wheel.others)
    for (const WheelNumber<dim>& number : wheel_numbers<dim>())
      if (const auto value = number.value(other); value && !number.is_of_shape)
        json[other.load_case][number.key] = *value;
  return json;
}

template <int dim>
Json shape_json(const SummarizedShape<dim>& shape, const std::string& minimized) {
  Json json{{"shape", shape.iteration}};
  json[!minimized.empty() ? "objective" : dim == 2 ? "objective_J_per_m" : "objective_J"] = shape.objective;
  for (const WheelNumber<dim>& number : wheel_numbers<dim>())
    if (const auto value = number.value(shape.wheel)) json[number.key] = *value;
  const ShapeSummary<dim>& summary = shape.wheel.summary;
  json["pressure_spread"] = summary.rolling.pressure_spread;
  json["peak_von_mises_place"] = {{"radius_m", summary.von_mises.place[0]},
                                  {"azimuth_rad", summary.von_mises.place[1]},
                                  {"load_position_rad", summary.von_mises.ground_azimuth}};
  if constexpr (dim == 3) json["peak_von_mises_place"]["z_m"] = summary.von_mises.place[2];
  json["largest_rotation_rad"] = summary.deformation.rotation;
  json["travel_by_ring_thickness"] = summary.deformation.travel;
  json["edges_overlap"] = summary.deformation.edges_overlap;
  if (!shape.wheel.load_case.empty()) json["load_case"] = shape.wheel.load_case;
  if (!shape.wheel.others.empty()) json["load_cases"] = load_cases_json(shape.wheel);
  return json;
}

}  // namespace

template <int dim>
std::string summary_table(const RunSummary<dim>& summary) {
  constexpr double mm = 1e3, degree = 180 / std::numbers::pi;
  std::vector<ComparedRow> rows{{summary.minimized.empty()
                                     ? fmt::format("objective [{}]", unit<dim>(UnitKind::energy))
                                     : "objective: " + summary.minimized,
                                 {summary.before.objective, summary.after.objective}}};
  for (ComparedRow& row : compared_rows<dim>({&summary.before.wheel, &summary.after.wheel}))
    rows.push_back(std::move(row));
  const StressPeak<dim>& peak = summary.after.wheel.summary.von_mises;
  return comparison_table({"before", "after"}, rows) +
         fmt::format(
             "the stress is largest at radius {:.1f} mm, azimuth {:.2f} deg, with the ground at {:.2f} deg\n",
             peak.place[0] * mm, peak.place[1] * degree, peak.ground_azimuth * degree);
}

template <int dim>
std::string summary_json(const RunSummary<dim>& summary) {
  Json json{{"title", summary.title},
            {"width_m", summary.after.wheel.grid.width},
            {"before", shape_json(summary.before, summary.minimized)},
            {"after", shape_json(summary.after, summary.minimized)}};
  for (const SummarizedBound& bound : summary.bounds)
    json["bounds"].push_back({{"name", bound.name},
                              {"value", bound.value},
                              {"relation", std::string(1, bound.relation)},
                              {"bound", bound.bound},
                              {"multiplier", bound.multiplier},
                              {"is_kept", bound.is_kept}});
  return json.dump(2) + '\n';
}

template std::string summary_table(const RunSummary<2>&);
template std::string summary_table(const RunSummary<3>&);
template std::string summary_json(const RunSummary<2>&);
template std::string summary_json(const RunSummary<3>&);

}  // namespace wheelwright
