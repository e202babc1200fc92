#include "wheelwright/report/run_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "wheelwright/base/units.h"
#include "wheelwright/report/comparison_table.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, MPa = 1e-6, N_per_mm = 1e-3, percent = 100, degree = 180 / std::numbers::pi;

template <int dim>
double whole_width(const RunSummary<dim>& summary) {
  return dim == 2 ? summary.width : 1;
}

/// One line of the table.
template <int dim>
struct Line {
  const char* name;
  const char* unit;
  double factor;  ///< from SI to that unit
  double (*value)(const SummarizedShape<dim>&);
};

template <int dim>
std::vector<Line<dim>> lines(const RunSummary<dim>& summary) {
  using Shape = SummarizedShape<dim>;
  const char* energy = unit<dim>(UnitKind::energy);
  return {
      {"objective", energy, 1, [](const Shape& s) { return s.objective; }},
      {"volume of the ring", "%", percent, [](const Shape& s) { return s.volume_fraction; }},
      {"strain energy per position", energy, 1, [](const Shape& s) { return s.measured.strain_energy; }},
      {"mean travel", "mm", mm, [](const Shape& s) { return s.measured.rolling.mean_travel; }},
      {"stiffness", "N/mm", N_per_mm * whole_width(summary),
       [](const Shape& s) { return s.measured.stiffness; }},
      {"run-out", "mm", mm, [](const Shape& s) { return s.measured.rolling.run_out; }},
      {"peak contact pressure", "MPa", MPa, [](const Shape& s) { return s.measured.rolling.peak_pressure; }},
      {"peak von Mises stress", "MPa", MPa, [](const Shape& s) { return s.measured.von_mises.value; }},
      {"largest strain", "%", percent, [](const Shape& s) { return s.measured.deformation.strain; }},
  };
}

using Json = nlohmann::ordered_json;

template <int dim>
Json shape_json(const SummarizedShape<dim>& shape, double width) {
  const ShapeSummary<dim>& m = shape.measured;
  const std::string energy = dim == 2 ? "_J_per_m" : "_J";
  Json json{{"shape", shape.iteration}};
  json["objective" + energy] = shape.objective;
  json["volume_fraction"] = shape.volume_fraction;
  json["strain_energy_per_position" + energy] = m.strain_energy;
  json["mean_travel_m"] = m.rolling.mean_travel;
  json["stiffness_N_per_m"] = m.stiffness * width;
  json["run_out_m"] = m.rolling.run_out;
  json["peak_pressure_Pa"] = m.rolling.peak_pressure;
  json["pressure_spread"] = m.rolling.pressure_spread;
  json["peak_von_mises_Pa"] = m.von_mises.value;
  json["peak_von_mises_place"] = {{"radius_m", m.von_mises.place[0]},
                                  {"azimuth_rad", m.von_mises.place[1]},
                                  {"load_position_rad", m.von_mises.ground_azimuth}};
  if constexpr (dim == 3) json["peak_von_mises_place"]["z_m"] = m.von_mises.place[2];
  json["largest_strain"] = m.deformation.strain;
  json["largest_rotation_rad"] = m.deformation.rotation;
  json["travel_by_ring_thickness"] = m.deformation.travel;
  json["edges_overlap"] = m.deformation.edges_overlap;
  return json;
}

}  // namespace

template <int dim>
std::string summary_table(const RunSummary<dim>& summary) {
  std::vector<ComparedRow> rows;
  for (const Line<dim>& line : lines(summary))
    rows.push_back({fmt::format("{} [{}]", line.name, line.unit),
                    {line.value(summary.before) * line.factor, line.value(summary.after) * line.factor}});
  const StressPeak<dim>& peak = summary.after.measured.von_mises;
  return comparison_table({"before", "after"}, rows) +
         fmt::format(
             "the stress is largest at radius {:.1f} mm, azimuth {:.2f} deg, with the ground at {:.2f} deg\n",
             peak.place[0] * mm, peak.place[1] * degree, peak.ground_azimuth * degree);
}

template <int dim>
std::string summary_json(const RunSummary<dim>& summary) {
  const double width = whole_width(summary);
  return Json{{"title", summary.title},
              {"load", summary.load},
              {"width_m", summary.width},
              {"before", shape_json(summary.before, width)},
              {"after", shape_json(summary.after, width)}}
             .dump(2) +
         '\n';
}

template std::string summary_table(const RunSummary<2>&);
template std::string summary_table(const RunSummary<3>&);
template std::string summary_json(const RunSummary<2>&);
template std::string summary_json(const RunSummary<3>&);

}  // namespace wheelwright
