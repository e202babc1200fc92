#include "wheelwright/output/report/run_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "wheelwright/base/units.h"
#include "wheelwright/output/report/comparison_table.h"
#include "wheelwright/output/report/numbers_json.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

/// Facts about the load that the numbers do not contain.
template <int dim>
void add_details(const LoadedWheel<dim>& loaded, Json& json) {
  const ShapeSummary<dim>& summary = loaded.summary;
  json["pressure_spread"] = summary.rolling.pressure_spread;
  json["peak_von_mises_place"] = {{"radius_m", summary.von_mises.place[0]},
                                  {"azimuth_rad", summary.von_mises.place[1]},
                                  {"load_position_rad", summary.von_mises.ground_azimuth}};
  if constexpr (dim == 3) json["peak_von_mises_place"]["z_m"] = summary.von_mises.place[2];
  json["largest_rotation_rad"] = summary.deformation.rotation;
  json["travel_by_ring_thickness"] = summary.deformation.travel;
  json["edges_overlap"] = summary.deformation.edges_overlap;
}

template <int dim>
Json shape_json(const SummarizedShape<dim>& shape, const std::string& minimized) {
  Json json{{"shape", shape.iteration}};
  const char* objective = !minimized.empty() ? "objective" : dim == 2 ? "objective_J_per_m" : "objective_J";
  json[objective] = shape.objective ? Json(*shape.objective) : Json();
  add_numbers(shape.wheel, json);
  if (!shape.objective) json["missing"][objective] = shape.objective.failure();
  if (const auto& error = shape.objective_error) {
    json["errors"][objective] = *error ? Json(**error) : Json();
    if (!*error) json["missing_errors"][objective] = error->failure();
  }
  if (shape.wheel.loaded) add_details(*shape.wheel.loaded, json);
  if (const auto rough = roughness(shape.wheel)) {
    const Vec<2>& place = rough->edge.sharpest.place;
    json["roughness_place"] = {{"radius_m", norm<2>(place)}, {"azimuth_rad", std::atan2(place[1], place[0])}};
  }
  return json;
}

/// Where the stress of the last shape is largest; empty if unknown.
template <int dim>
std::string stress_line(const DescribedWheel<dim>& wheel) {
  if (!wheel.loaded) return "";
  constexpr double mm = 1e3, degree = 180 / std::numbers::pi;
  const StressPeak<dim>& peak = wheel.loaded->summary.von_mises;
  return fmt::format(
      "the stress is largest at radius {:.1f} mm, azimuth {:.2f} deg, with the ground at {:.2f} deg\n",
      peak.place[0] * mm, peak.place[1] * degree, peak.ground_azimuth * degree);
}

template <int dim>
std::vector<ComparedRow> rows(const RunSummary<dim>& summary) {
  const auto shown = [&](const KnownNumber& value) -> std::optional<KnownNumber> {
    return value ? KnownNumber(*value * summary.objective.factor) : value;
  };
  const auto shown_error = [&](const SummarizedShape<dim>& shape) -> std::optional<double> {
    const auto& error = shape.objective_error;
    return error && *error ? std::optional(**error * summary.objective.factor) : std::nullopt;
  };
  std::vector<ComparedRow> result{{summary.minimized.empty()
                                       ? fmt::format("objective [{}]", unit<dim>(UnitKind::energy))
                                       : "objective: " + summary.minimized,
                                   {shown(summary.before.objective), shown(summary.after.objective)},
                                   {shown_error(summary.before), shown_error(summary.after)}}};
  for (ComparedRow& row : compared_rows<dim>({&summary.before.wheel, &summary.after.wheel}))
    result.push_back(std::move(row));
  return result;
}

}  // namespace

template <int dim>
std::vector<std::string> missing_lines(const RunSummary<dim>& summary) {
  return missing_lines({"before", "after"}, rows(summary));
}

template <int dim>
std::string summary_table(const RunSummary<dim>& summary) {
  const std::string remarks = remarks_text(summary.remarks);
  return comparison_table({"before", "after"}, rows(summary)) + stress_line(summary.after.wheel) +
         (remarks.empty() ? "" : "\nworse than before:\n" + remarks) +
         (summary.changed_start.empty() ? "" : "\n" + summary.changed_start + "\n");
}

template <int dim>
std::string summary_json(const RunSummary<dim>& summary) {
  Json json{{"title", summary.title},
            {"width_m", summary.after.wheel.grid.width},
            {"before", shape_json(summary.before, summary.minimized)},
            {"after", shape_json(summary.after, summary.minimized)}};
  for (const SummarizedBound& bound : summary.bounds) {
    json["bounds"].push_back({{"name", bound.name},
                              {"value", bound.value},
                              {"relation", std::string(1, bound.relation)},
                              {"bound", bound.bound},
                              {"unit", bound.unit},
                              {"multiplier", bound.multiplier},
                              {"is_kept", bound.is_kept}});
    if (bound.kept_within > 0) json["bounds"].back()["kept_within"] = bound.kept_within;
  }
  json["remarks"] = Json::array();
  for (const Remark& remark : summary.remarks)
    json["remarks"].push_back({{"key", remark.key},
                               {"load_case", remark.load_case},
                               {"before", remark.before},
                               {"after", remark.after},
                               {"text", remark.text},
                               {"constraint", remark.constraint}});
  if (!summary.changed_start.empty()) json["changed_start"] = summary.changed_start;
  return json.dump(2) + '\n';
}

std::string failure_json(const std::string& title, const Failure& failure) {
  const Json json{{"title", title},
                  {"failure", {{"reason", to_string(failure.reason)}, {"detail", failure.detail}}}};
  return json.dump(2) + '\n';
}

template decltype(missing_lines<2>) missing_lines<2>;
template decltype(missing_lines<3>) missing_lines<3>;
template decltype(summary_table<2>) summary_table<2>;
template decltype(summary_table<3>) summary_table<3>;
template decltype(summary_json<2>) summary_json<2>;
template decltype(summary_json<3>) summary_json<3>;

}  // namespace wheelwright
