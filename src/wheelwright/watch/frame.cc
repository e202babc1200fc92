#include "wheelwright/watch/frame.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "wheelwright/analysis/rolling_analysis.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/evolution/volume.h"
#include "wheelwright/report/solution_fields.h"
#include "wheelwright/watch/sector_outline.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json settings_json(const WatchedShape& shape) {
  const Case& c = *shape.source;
  const double ring = sector_measure<2>(shape.psi.lattice.grid());
  return {{"load",
           {{"force_N", c.load.force},
            {"travel_m", c.load.travel ? Json(*c.load.travel) : Json()},
            {"horizontal_force_N", c.load.horizontal_force},
            {"torque_N_m", c.load.torque},
            {"body_force_N_per_m3", c.load.body_force},
            {"hole_pressure_Pa", c.load.hole_pressure},
            {"positions", c.load.positions}}},
          {"weights",
           {{"strain_energy", c.objective.strain_energy},
            {"uniformity_annulus", c.objective.uniformity_annulus},
            {"uniformity_dual", c.objective.uniformity_dual},
            {"uniformity_l2", c.objective.uniformity_l2}}},
          {"volume_target", shape.target_measure / ring}};
}

Json wheel_json(const WatchedShape& shape) {
  const PolarGrid<2>& grid = shape.psi.lattice.grid();
  const HoleRange room = free_region(*shape.source);
  return {{"inner_radius_m", grid.inner_radius},
          {"outer_radius_m", grid.outer_radius},
          {"width_m", grid.width},
          {"sectors", grid.n_sectors},
          {"hole_inner_radius_m", room.inner},
          {"hole_outer_radius_m", room.outer},
          {"cell_m", grid.resolution()}};
}

Json numbers_json(const WatchedShape& shape) {
  Json numbers{{"objective_J_per_m", number(shape.objective)},
               {"volume_fraction", shape.measure / sector_measure<2>(shape.psi.lattice.grid())}};
  for (const TermValue& term : shape.terms) numbers[term.name] = number(term.value);
  for (const MeasureValue& measure : shape.measures) numbers[measure.name] = number(measure.value);
  return numbers;
}

Json outline_json(const WatchedShape& shape) {
  Json loops = Json::array();
  for (OutlineLoop& loop : sector_outline(shape.psi))
    loops.push_back(
        {{"in_every_sector", loop.is_in_every_sector}, {"points_um", std::move(loop.micrometres)}});
  return loops;
}

/// The travel of the rim at all load positions of a sector.
Json travel_json(const WatchedShape& shape) {
  std::vector<double> travel;
  for (const auto& contact : shape.solution->contacts()) travel.push_back(contact.rim.towards_ground);
  return of_all(shape.solution->positions(), travel);
}

Json pressure_json(const WatchedShape& shape, int position) {
  Json x = Json::array(), pressure = Json::array();
  for (const ContactPoint& point : contact_points(*shape.solver, *shape.solution)) {
    if (point.position != position) continue;
    x.push_back(point.x);
    pressure.push_back(point.pressure);
  }
  return {{"position", position}, {"x_m", std::move(x)}, {"pressure_Pa", std::move(pressure)}};
}

/// The mean travel of the rim under forces up to one and a half times the present one.
Json force_curve_json(const WatchedShape& shape) {
  double force = 0;
  for (const auto& contact : shape.solution->contacts()) force += contact.rim_force.towards_ground;
  force /= static_cast<double>(shape.solution->contacts().size());
  std::vector<double> loads;
  for (const double factor : {0.25, 0.5, 0.75, 1.0, 1.25, 1.5}) loads.push_back(factor * force);
  const auto under = under_loads<2>(*shape.solution, loads);
  if (!under) return Json();
  Json forces{0.0}, travels{0.0};
  for (std::size_t k = 0; k < loads.size(); ++k) {
    std::vector<double> travel;
    for (const ContactSummary& summary : (*under)[k]) travel.push_back(summary.travel);
    forces.push_back(loads[k] * shape.source->wheel.width);
    travels.push_back(rolling_variation(of_all(shape.solution->positions(), travel)).mean);
  }
  return {{"force_N", std::move(forces)}, {"travel_m", std::move(travels)}};
}

}  // namespace

std::string frame_json(const BoardView& view, const std::vector<CurvePoint>& curve, const FrameQuery& query) {
  Json json{{"version", view.version},
            {"activity", to_string(view.activity)},
            {"reason", view.reason ? Json(to_string(*view.reason)) : Json()},
            {"can_undo", view.can_undo},
            {"message", view.message},
            {"is_refusal", view.is_refusal}};
  Json points = Json::array();
  for (const CurvePoint& p : curve)
    points.push_back(
        {p.shape, number(p.objective), number(p.mean_travel), number(p.run_out), p.volume_fraction});
  json["curve"] = std::move(points);
  if (view.shape) {
    const WatchedShape& shape = *view.shape;
    json["shape"] = shape.number;
    json["wheel"] = wheel_json(shape);
    json["settings"] = settings_json(shape);
    json["numbers"] = numbers_json(shape);
    json["outline"] = outline_json(shape);
    json["travel_m"] = travel_json(shape);
    json["pressure"] = pressure_json(shape, query.position);
    if (query.wants_force_curve) json["force_curve"] = force_curve_json(shape);
  }
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace wheelwright
