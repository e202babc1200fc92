#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "wheelwright/base/units.h"
#include "wheelwright/files/base64.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"
#include "wheelwright/page/assets.h"
#include "wheelwright/page/html_template.h"
#include "wheelwright/page/report_run.h"
#include "wheelwright/report/numbers_json.h"
#include "wheelwright/report/svg.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

/// Points of the material of sector 0 with what it takes to interpolate a field there, and triangles of them.
struct SectorMesh {
  std::vector<Vec<2>> points;             ///< Cartesian [m]
  std::vector<RingCellNodes<2>> nodes;    ///< of the cell of every point
  std::vector<ShapeFunctions<2>> shapes;  ///< of the fields there, in its cell
  std::vector<std::uint32_t> triangles;   ///< corners, counter-clockwise
};

/// Collects the points of a sector's polygons; those that polygons share are one.
class SectorMeshBuilder {
 public:
  SectorMeshBuilder(const LevelSet<2>& psi, const Lattice<2>& field_lattice)
      : psi_(psi), field_lattice_(field_lattice) {}

  std::uint32_t add(int cell, const Vec<2>& xi) {
    const Vec<2> x = position(cell, xi);
    const auto [entry, is_new] = known_.try_emplace(key(x), static_cast<std::uint32_t>(mesh_.points.size()));
    if (is_new) {
      mesh_.points.push_back(x);
      mesh_.nodes.push_back(ring_cell_nodes<2>(field_lattice_, grid().cell_position(cell)));
      mesh_.shapes.emplace_back(field_lattice_.degree(), xi);
    }
    return entry->second;
  }

  /// Whether there is a point here, or in a sector beside it where that shares its edge.
  bool has(int cell, const Vec<2>& xi) const {
    const Vec<2> x = position(cell, xi);
    for (const int sector : {0, 1, -1})
      if (known_.contains(key(rotated<2>(x, sector * grid().sector_angle())))) return true;
    return false;
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
  }

  SectorMesh mesh() && { return std::move(mesh_); }

 private:
  const PolarGrid<2>& grid() const { return psi_.lattice.grid(); }
  Vec<2> position(int cell, const Vec<2>& xi) const {
    const auto place = grid().cell_position(cell);
    const CellMap<2> map(grid(), psi_.lattice.degree(), place);
    return rotated<2>(map.position(ShapeFunctions<2>(psi_.lattice.degree(), xi)),
                      place[1] * grid().cell_size()[1]);
  }
  static std::array<long, 2> key(const Vec<2>& x) {
    constexpr double resolution = 1e7;  // [1/m]
    return {std::lround(x[0] * resolution), std::lround(x[1] * resolution)};
  }

  const LevelSet<2>& psi_;
  const Lattice<2>& field_lattice_;
  std::map<std::array<long, 2>, std::uint32_t> known_;
  SectorMesh mesh_;
};

/// Polygons beside halved ones have the middles of their sides too, so that no gaps open where the mesh is
/// deformed.
SectorMesh sector_mesh(const LevelSet<2>& psi, const Lattice<2>& field_lattice) {
  constexpr int cut_subdivisions = 2;
  const auto polygons = material_polygons(psi, cut_subdivisions);
  SectorMeshBuilder builder(psi, field_lattice);
  const int n_cells = psi.lattice.grid().n_cells();
  for (int cell = 0; cell < n_cells; ++cell)
    for (const MaterialPolygon& polygon : polygons[cell])
      for (const Vec<2>& xi : polygon) builder.add(cell, xi);
  for (int cell = 0; cell < n_cells; ++cell)
    for (const MaterialPolygon& polygon : polygons[cell]) {
      std::vector<std::uint32_t> corners;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec<2>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const Vec<2> middle{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
        corners.push_back(builder.add(cell, a));
        if (builder.has(cell, middle)) corners.push_back(builder.add(cell, middle));
      }
      for (std::size_t k = 2; k < corners.size(); ++k)
        builder.add_triangle(corners[0], corners[k - 1], corners[k]);
    }
  return std::move(builder).mesh();
}

template <class T>
std::string encoded(const std::vector<T>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

/// Visits a field's components at the points of a mesh in all sectors, in the order point + n_points *
/// sector.
template <class Visit>
void for_each_point(const SectorMesh& mesh, const Lattice<2>& lattice, const RingField& field,
                    const Visit& visit) {
  std::vector<double> components(field.components);
  const int n_nodes = nodes_per_cell<2>(lattice.degree()), n_sectors = lattice.grid().n_sectors;
  const std::size_t sector_nodes = lattice.n_nodes(), ring_nodes = sector_nodes * n_sectors;
  for (int sector = 0; sector < n_sectors; ++sector)
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
      RingCellNodes<2> nodes = mesh.nodes[k];
      for (int a = 0; a < n_nodes; ++a) {
        nodes[a] += sector * sector_nodes;
        if (nodes[a] >= ring_nodes) nodes[a] -= ring_nodes;
      }
      const std::span shape(mesh.shapes[k].value.data(), n_nodes);
      for (int c = 0; c < field.components; ++c) components[c] = interpolate(field, nodes, shape, c);
      visit(std::span<const double>(components));
    }
}

double largest(const std::vector<std::vector<double>>& all) {
  double result = 0;
  for (const auto& values : all)
    for (const double v : values)
      if (std::isfinite(v)) result = std::max(result, std::abs(v));
  return result;
}

std::vector<std::int16_t> as_shorts(const std::vector<double>& values, double full_scale) {
  std::vector<std::int16_t> result;
  for (const double v : values)
    result.push_back(static_cast<std::int16_t>(std::isfinite(v) ? std::lround(32767 * v / full_scale) : 0));
  return result;
}

/// Square roots of shares of the full scale: small values keep their digits, and the page colours by them.
std::vector<std::uint8_t> as_bytes_of_roots(const std::vector<double>& values, double full_scale) {
  std::vector<std::uint8_t> result;
  for (const double v : values)
    result.push_back(static_cast<std::uint8_t>(
        std::isfinite(v) ? std::lround(255 * std::sqrt(std::clamp(v / full_scale, 0.0, 1.0))) : 0));
  return result;
}

/// The deformed wheel in its load positions. Displacements are Cartesian, in the body frame.
Json fields_json(const LevelSet<2>& shape, std::span<const PositionFields<2>> all) {
  const SectorMesh mesh = sector_mesh(shape, all.front().lattice);
  std::vector<float> points;
  for (const Vec<2>& x : mesh.points) points.insert(points.end(), {float(x[0]), float(x[1])});
  std::vector<std::vector<double>> x, y, stress;
  for (const PositionFields<2>& position : all) {
    const NamedField von_mises = von_mises_field(position.stress);
    auto &at_x = x.emplace_back(), &at_y = y.emplace_back(), &at_stress = stress.emplace_back();
    for_each_point(mesh, position.lattice, position.displacement, [&](auto u) {
      at_x.push_back(u[0]);
      at_y.push_back(u[1]);
    });
    for_each_point(mesh, position.lattice, von_mises.field,
                   [&](auto components) { at_stress.push_back(von_mises.scalar(components)); });
  }
  const double full_displacement = std::max(largest(x), largest(y)), full_stress = largest(stress);
  Json positions = Json::array();
  for (std::size_t i = 0; i < all.size(); ++i)
    positions.push_back({{"azimuth_rad", all[i].ground_azimuth},
                         {"x", encoded(as_shorts(x[i], full_displacement))},
                         {"y", encoded(as_shorts(y[i], full_displacement))},
                         {"root_of_stress", encoded(as_bytes_of_roots(stress[i], full_stress))}});
  return {{"points", encoded(points)},
          {"triangles", encoded(mesh.triangles)},
          {"full_displacement_m", full_displacement},
          {"full_stress_Pa", full_stress},
          {"positions", std::move(positions)}};
}

Json fields_json(const ReportRun<2>& run, std::span<const PositionFields<2>> positions) {
  return fields_json(*run.shape, positions);
}

/// null where it could not be computed.
Json curve_json(const Expected<std::vector<double>>& values, double factor) {
  if (!values) return {};
  Json json = Json::array();
  for (const double value : *values) json.push_back(value * factor);
  return json;
}

Json harmonics_json(const Expected<std::vector<double>>& values, double factor) {
  return values ? curve_json(rolling_variation(*values).harmonics, factor) : Json();
}

/// The curves over the load positions; null where the wheel has no solution.
template <int dim>
Json rolling_json(const DescribedWheel<dim>& wheel) {
  if (!wheel.loaded) return {};
  const RollingAnalysis& a = wheel.loaded->rolling;
  const double width = whole_width(dim, wheel.grid.width);
  Json json{{"azimuths_rad", a.azimuths},
            {"travel_at_load_m", curve_json(a.travel_at_load, 1)},
            {"force_at_travel_N", curve_json(a.force_at_travel, width)},
            {"peak_von_mises_Pa", a.peak_von_mises},
            {"peak_pressure_Pa", Json::array()},
            {"travel_harmonics_m", harmonics_json(a.travel_at_load, 1)},
            {"force_harmonics_N", harmonics_json(a.force_at_travel, width)}};
  for (const ContactSummary& contact : a.positions) json["peak_pressure_Pa"].push_back(contact.peak_pressure);
  return json;
}

/// A value of -32767 to 32767 is a share of the full scale.
std::vector<double> widened(const std::vector<float>& values) { return {values.begin(), values.end()}; }

/// The surface of sector 0, whose corners beyond its own vertices are those of the next sector, and the
/// deformed wheel in its load positions.
Json fields_json(const SurfaceMesh& mesh, std::span<const SurfacePosition> all) {
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
  return {{"is_surface", true},
          {"points", encoded(points)},
          {"triangles", encoded(corners)},
          {"parts", encoded(parts)},
          {"full_displacement_m", full_displacement},
          {"full_stress_Pa", full_stress},
          {"positions", std::move(positions)}};
}

Json fields_json(const ReportRun<3>& run, std::span<const SurfacePosition> positions) {
  return fields_json(run.surface, positions);
}

/// The fields under the load cases after the first one, on its mesh.
template <int dim>
Json other_fields_json(const ReportRun<dim>& run) {
  Json all = Json::array();
  for (const LoadedPositions<dim>& load : run.other_loads) {
    Json fields = fields_json(run, load.positions);
    for (const char* of_mesh : {"points", "triangles", "parts"}) fields.erase(of_mesh);
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
  Json json{{"dimension", dim},
            {"numbers", shown_numbers<dim>()},
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
            {"events_left_out", run.events_left_out},
            {"flags", run.flags},
            {"limits", run.limits},
            {"history", std::move(history)},
            {"outline_units", outline_units},
            {"outlines", std::move(outlines)}};
  if (run.given) json["given_contours"] = run.given->contours;
  if (run.summary) {
    json["summary"] = Json::parse(summary_json(*run.summary));
    for (const SummarizedBound& bound : run.summary->bounds)
      json["bound_units"].push_back({{"unit", bound.shown.name}, {"factor", bound.shown.factor}});
    json["rolling"] = {{"before", rolling_json(run.summary->before.wheel)},
                       {"after", rolling_json(run.summary->after.wheel)}};
  }
  if (run.shape) {
    json["fields"] = fields_json(run, run.positions);
    json["other_fields"] = other_fields_json(run);
  }
  if (!run.contact_points.empty()) json["pressures"] = pressures_json(curve_points<dim>(run.contact_points));
  return json;
}

}  // namespace

template <int dim>
PageRun page_run(const ReportRun<dim>& run) {
  return {run.title, json_in_script(run_json(run)), dim == 3 && run.shape};
}

template PageRun page_run(const ReportRun<2>&);
template PageRun page_run(const ReportRun<3>&);

std::string loaded_wheel_json(const LevelSet<2>& shape, std::span<const PositionFields<2>> positions) {
  return fields_json(shape, positions).dump();
}

std::string loaded_wheel_json(const SurfaceMesh& surface, std::span<const SurfacePosition> positions) {
  return fields_json(surface, positions).dump();
}

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
                          {"@PARTS@", std::string(assets::parts_js)},
                          {"@SCRIPT@", std::string(assets::report_js)}});
}

}  // namespace wheelwright
