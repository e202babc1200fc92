#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "wheelwright/base/units.h"
#include "wheelwright/files/base64.h"
#include "wheelwright/output/page/assets.h"
#include "wheelwright/output/page/html_template.h"
#include "wheelwright/output/page/report_run.h"
#include "wheelwright/output/report/numbers_json.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/quantities/analysis/discretization_error.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
std::string encoded(const std::vector<T>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values)
    if (std::isfinite(v)) result = std::max(result, std::abs(v));
  return result;
}

double largest(const std::vector<std::vector<double>>& all) {
  double result = 0;
  for (const auto& values : all) result = std::max(result, largest(values));
  return result;
}

std::vector<std::int16_t> as_shorts(const std::vector<double>& values, double full_scale) {
  std::vector<std::int16_t> result;
  for (const double v : values)
    result.push_back(static_cast<std::int16_t>(std::isfinite(v) ? std::lround(32767 * v / full_scale) : 0));
  return result;
}

/// Square roots of fractions of the full scale: small values keep their digits, and the page colours by them.
std::vector<std::uint8_t> as_bytes_of_roots(const std::vector<double>& values, double full_scale) {
  std::vector<std::uint8_t> result;
  for (const double v : values)
    result.push_back(static_cast<std::uint8_t>(
        std::isfinite(v) ? std::lround(255 * std::sqrt(std::clamp(v / full_scale, 0.0, 1.0))) : 0));
  return result;
}

/// The ground of all load positions, unless it is the usual one.
template <class Position>
void add_ground(std::span<const Position> all, Json& json) {
  if (all.empty() || !all.front().ground) return;
  const ShownGround& ground = *all.front().ground;
  json["ground_m"] = ground.outline;
  if (ground.camber != 0) json["camber_rad"] = ground.camber;
}

/// The deformed wheel at its load positions. Displacements are Cartesian, in the body frame.
Json fields_json(const SectorMesh& mesh, std::span<const MeshPosition> all) {
  std::vector<float> points;
  for (const Vec<2>& x : mesh.points) points.insert(points.end(), {float(x[0]), float(x[1])});
  double full_displacement = 0, full_stress = 0;
  for (const MeshPosition& position : all) {
    full_displacement = std::max({full_displacement, largest(position.x), largest(position.y)});
    full_stress = std::max(full_stress, largest(position.von_mises));
  }
  Json positions = Json::array();
  for (const MeshPosition& position : all)
    positions.push_back({{"azimuth_rad", position.ground_azimuth},
                         {"x", encoded(as_shorts(position.x, full_displacement))},
                         {"y", encoded(as_shorts(position.y, full_displacement))},
                         {"root_of_stress", encoded(as_bytes_of_roots(position.von_mises, full_stress))}});
  Json json{{"points", encoded(points)},
            {"triangles", encoded(mesh.triangles)},
            {"full_displacement_m", full_displacement},
            {"full_stress_Pa", full_stress},
            {"positions", std::move(positions)}};
  add_ground(all, json);
  if (!mesh.layer_edges.empty()) json["layer_edges"] = encoded(mesh.layer_edges);
  return json;
}

/// null if it could not be computed.
Json curve_json(const Expected<std::vector<double>>& values, double factor) {
  if (!values) return {};
  Json json = Json::array();
  for (const double value : *values) json.push_back(value * factor);
  return json;
}

Json harmonics_json(const Expected<std::vector<double>>& values, double factor) {
  return values ? curve_json(rolling_variation(*values).harmonics, factor) : Json();
}

std::vector<double> peak_pressures(const RollingAnalysis& a) {
  std::vector<double> values;
  for (const ContactSummary& contact : a.positions) values.push_back(contact.peak_pressure);
  return values;
}

/// null if one of the two could not be computed.
Json errors_json(const Expected<std::vector<double>>& values, const Expected<std::vector<double>>& on_finer,
                 double refinement, double factor) {
  if (!values || !on_finer) return {};
  return curve_json(discretization_errors(*values, *on_finer, refinement), factor);
}

/// The errors of the curves over the load positions; null if they are not known.
template <int dim>
Json rolling_errors_json(const DescribedWheel<dim>& wheel) {
  if (!wheel.finer || !*wheel.finer || !(*wheel.finer)->wheel.loaded) return {};
  const RollingAnalysis &a = wheel.loaded->rolling, &finer = (*wheel.finer)->wheel.loaded->rolling;
  const double width = whole_width(dim, wheel.grid.width), r = (*wheel.finer)->refinement;
  return {{"travel_at_load_m", errors_json(a.travel_at_load, finer.travel_at_load, r, 1)},
          {"force_at_travel_N", errors_json(a.force_at_travel, finer.force_at_travel, r, width)},
          {"peak_von_mises_Pa",
           discretization_errors(a.peak_von_mises, finer.peak_von_mises, r, Converges::as_an_extreme)},
          {"peak_pressure_Pa",
           discretization_errors(peak_pressures(a), peak_pressures(finer), r, Converges::as_an_extreme)}};
}

/// The curves over the load positions, and their errors; null if the wheel has no solution.
template <int dim>
Json rolling_json(const DescribedWheel<dim>& wheel) {
  if (!wheel.loaded) return {};
  const RollingAnalysis& a = wheel.loaded->rolling;
  const double width = whole_width(dim, wheel.grid.width);
  Json json{{"azimuths_rad", a.azimuths},
            {"travel_at_load_m", curve_json(a.travel_at_load, 1)},
            {"force_at_travel_N", curve_json(a.force_at_travel, width)},
            {"peak_von_mises_Pa", a.peak_von_mises},
            {"peak_pressure_Pa", peak_pressures(a)},
            {"travel_harmonics_m", harmonics_json(a.travel_at_load, 1)},
            {"force_harmonics_N", harmonics_json(a.force_at_travel, width)}};
  if (Json errors = rolling_errors_json(wheel); !errors.is_null()) json["errors"] = std::move(errors);
  return json;
}

/// Values from -32767 to 32767 are fractions of the full scale.
std::vector<double> widened(const std::vector<float>& values) { return {values.begin(), values.end()}; }

/// The surface of sector 0, whose corners beyond its own vertices are those of the next sector, and the
/// deformed wheel in its load positions.
Json fields_json(const LayeredSurface& mesh, std::span<const SurfacePosition> all) {
  const std::size_t n_triangles = mesh.triangles.size() / mesh.n_sectors;
  std::vector<float> points;
  for (int v = 0; v < mesh.sector_points(); ++v)
    for (const double x : mesh.points[v]) points.push_back(static_cast<float>(x));
  std::vector<std::uint32_t> corners;
  std::vector<std::uint8_t> parts;
  for (std::size_t t = 0; t < n_triangles; ++t) {
    corners.insert(corners.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    parts.push_back(static_cast<std::uint8_t>(mesh.parts[t]));
  }
  std::vector<std::uint32_t> edges;
  for (std::size_t k = 0; k < mesh.layer_edges.size() / mesh.n_sectors; ++k)
    edges.insert(edges.end(), mesh.layer_edges[k].begin(), mesh.layer_edges[k].end());
  std::vector<std::vector<double>> displacement, stress;
  for (const SurfacePosition& position : all) {
    for (const auto& component : position.displacement) displacement.push_back(widened(component));
    stress.push_back(widened(position.von_mises));
  }
  const double full_displacement = largest(displacement), full_stress = largest(stress);
  Json positions = Json::array();
  for (std::size_t i = 0; i < all.size(); ++i)
    positions.push_back({{"azimuth_rad", all[i].ground_azimuth},
                         {"x", encoded(as_shorts(displacement[3 * i], full_displacement))},
                         {"y", encoded(as_shorts(displacement[3 * i + 1], full_displacement))},
                         {"z", encoded(as_shorts(displacement[3 * i + 2], full_displacement))},
                         {"root_of_stress", encoded(as_bytes_of_roots(stress[i], full_stress))}});
  Json json{{"is_surface", true},
            {"points", encoded(points)},
            {"triangles", encoded(corners)},
            {"parts", encoded(parts)},
            {"full_displacement_m", full_displacement},
            {"full_stress_Pa", full_stress},
            {"positions", std::move(positions)}};
  add_ground(all, json);
  if (!mesh.layer_edges.empty()) json["layer_edges"] = encoded(edges);
  return json;
}

/// The fields under the load cases after the first one, on its mesh.
template <int dim>
Json other_fields_json(const ReportRun<dim>& run) {
  Json all = Json::array();
  for (const LoadedPositions<dim>& load : run.other_loads) {
    Json fields = fields_json(run.wheel->mesh, load.positions);
    for (const char* of_mesh : {"points", "triangles", "parts", "layer_edges"}) fields.erase(of_mesh);
    all.push_back({{"load_case", load.load_case}, {"fields", std::move(fields)}});
  }
  return all;
}

/// The contact pressures of every position along the ground.
Json pressures_json(const std::vector<ContactPoint>& points) {
  std::map<int, Json> by_position;
  for (const ContactPoint& point : points) {
    Json& curve =
        by_position.try_emplace(point.position, Json{{"x_m", Json::array()}, {"pressure_Pa", Json::array()}})
            .first->second;
    curve["x_m"].push_back(point.x);
    curve["pressure_Pa"].push_back(point.pressure);
  }
  Json all = Json::array();
  for (auto& [position, curve] : by_position) all.push_back(std::move(curve));
  return all;
}

template <int dim>
Json run_json(const ReportRun<dim>& run) {
  Json history = Json::object();
  for (const HistoryCurve& curve : run.history) {
    Json values = Json::array();
    for (const double v : curve.values) values.push_back(std::isfinite(v) ? Json(v) : Json());
    history[curve.name] = std::move(values);
  }
  Json outlines = Json::array();
  for (const ShapeOutline& outline : run.outlines)
    outlines.push_back(
        {{"shape", outline.shape}, {"objective", outline.objective}, {"contours", outline.contours}});
  Json events = Json::array();
  for (const HoleEvents& event : run.events) events.push_back({{"shape", event.shape}, {"text", event.text}});
  Json json{
      {"dimension", dim},
      {"numbers", shown_numbers(run.summary ? numbers_of(run.summary->after.wheel) : wheel_numbers<dim>())},
      {"objective", {{"unit", run.objective.name}, {"factor", run.objective.factor}}},
      {"name", run.name},
      {"title", run.title},
      {"status", run.status},
      {"is_running", run.is_running},
      {"program", run.program},
      {"case", run.case_text},
      {"seconds", run.seconds},
      {"load", run.load},
      {"inner_radius_m", run.grid.inner_radius},
      {"outer_radius_m", run.grid.outer_radius},
      {"width_m", run.grid.width},
      {"sectors", run.grid.n_sectors},
      {"trials", run.trials},
      {"rejected", run.rejected},
      {"events", std::move(events)},
      {"events_omitted", run.events_omitted},
      {"flags", run.flags},
      {"has_rough_edges", run.has_rough_edges},
      {"limits", run.limits},
      {"history", std::move(history)},
      {"outline_units", outline_units},
      {"outlines", std::move(outlines)}};
  if (!run.layers.empty()) json["layers"] = {{"radii_m", run.layers.radii}, {"names", run.layers.names}};
  if (run.given) json["given_contours"] = run.given->contours;
  if (run.summary) {
    json["summary"] = Json::parse(summary_json(*run.summary));
    if (const auto& made = run.summary->made) {
      json["made"] = sentence(*made);
      json["shows_smaller_z"] = made->print && made->print->plate > 0;
    }
    for (const SummarizedBound& bound : run.summary->bounds)
      json["bound_units"].push_back({{"unit", bound.shown.name}, {"factor", bound.shown.factor}});
    json["rolling"] = {{"before", rolling_json(run.summary->before.wheel)},
                       {"after", rolling_json(run.summary->after.wheel)}};
  }
  if (run.wheel) {
    json["fields"] = fields_json(run.wheel->mesh, run.wheel->positions);
    json["other_fields"] = other_fields_json(run);
  }
  if (!run.contact_points.empty()) json["pressures"] = pressures_json(curve_points<dim>(run.contact_points));
  return json;
}

}  // namespace

template <int dim>
PageRun page_run(const ReportRun<dim>& run) {
  return {run.title, json_in_script(run_json(run)), dim == 3 && run.wheel};
}

template decltype(page_run<2>) page_run<2>;
template decltype(page_run<3>) page_run<3>;

template <int dim>
std::string loaded_wheel_json(const ShownWheel<dim>& wheel) {
  return fields_json(wheel.mesh, wheel.positions).dump();
}

template decltype(loaded_wheel_json<2>) loaded_wheel_json<2>;
template decltype(loaded_wheel_json<3>) loaded_wheel_json<3>;

std::string report_page(const std::vector<PageRun>& runs) {
  std::string data;
  for (const PageRun& run : runs) data += (data.empty() ? "" : ",\n") + run.json;
  const bool has_surface = std::ranges::any_of(runs, &PageRun::is_solid);
  return filled_template(assets::report_html,
                         {{"@TITLE@", escape_xml(runs.size() == 1 ? runs.front().title : "Wheels compared")},
                          {"@STYLE@", std::string(assets::report_css)},
                          {"@DATA@", "{\"runs\":[" + data + "]}"},
                          {"@CHART_LIBRARY@", std::string(assets::chart_js)},
                          {"@SCENE_LIBRARY@", has_surface ? std::string(assets::three_js) : ""},
                          {"@PARTS@", std::string(assets::formats_js).append(assets::parts_js)},
                          {"@SCRIPT@", std::string(assets::report_js)}});
}

}  // namespace wheelwright
