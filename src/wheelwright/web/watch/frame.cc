#include "wheelwright/web/watch/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "wheelwright/base/units.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/load_values.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/commands/command_json.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/results/run_title.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/web/watch/products.h"
#include "wheelwright/web/watch/sector_outline.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// The load of the section [load], which commands modify, and those of all load cases.
Json load_cases_json(const Case& c) {
  Json loads = Json::array();
  const auto singles = single_load_cases(c);
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    loads.push_back({{"name", c.load.cases[k].name}, {"load", Json::parse(load_json(singles[k].load))}});
  return loads;
}

/// The numbers of a load that a page can change, in the units that it displays. Flat ground has none.
Json load_keys_json(const Load& load) {
  constexpr double millimetres = 1e3;
  Json keys = Json::array();
  for (const Key<Load>& key : load_values(load)) {
    const auto* number = std::get_if<NumberField<Load>>(&key.field);
    if (!number && !std::holds_alternative<OptionalNumberField<Load>>(key.field)) continue;
    if (load.ground == "flat" && key.name.starts_with("ground_")) continue;
    const bool is_length = key.unit == "m";
    const double factor = is_length ? millimetres : 1 / (number ? number->factor : 1);
    std::string words(key.name);
    std::ranges::replace(words, '_', ' ');
    keys.push_back({{"id", key.name},
                    {"key", json_name(key)},
                    {"text", fmt::format("{} [{}]", words, is_length ? "mm" : key.unit)},
                    {"factor", factor}});
  }
  return keys;
}

/// The conversion of a number in a case or history to display units.
Json shown_json(UnitKind kind, const Case& c) {
  const ShownUnit shown = shown_unit(kind, c.wheel.dimension, c.wheel.width);
  return {{"unit", shown.name}, {"factor", shown.factor}};
}

Json weights_json(const Objective& objective) {
  Json weights;
  for (const auto& [quantity, weight] : objective_weights) weights[std::string(quantity)] = objective.*weight;
  return weights;
}

/// The bounds of the case, in the units of its sections.
Json bounds_json(const Case& c) {
  Json bounds = Json::array();
  for (const Constraint& bound : c.constraints) {
    Json json{{"quantity", name(quantity_of(c, bound))}, {"shown", shown_json(kind(bound.quantity), c)}};
    if (bound.at_least) json["at_least"] = *bound.at_least;
    if (bound.at_most) json["at_most"] = *bound.at_most;
    if (bound.equals) json["equals"] = *bound.equals;
    bounds.push_back(std::move(json));
  }
  return bounds;
}

template <int dim>
Json settings_json(const WatchedShape<dim>& shape) {
  const Case& c = *shape.source;
  const double ring = sector_measure<dim>(shape.psi.lattice.grid());
  return {{"load", Json::parse(load_json(c.load))},
          {"load_cases", load_cases_json(c)},
          {"load_keys", load_keys_json(c.load)},
          {"weights", weights_json(c.objective)},
          {"volume_target", shape.target_measure / ring},
          {"minimum_wall_m", c.optimizer.minimum_wall.value_or(0)},
          {"minimum_gap_m", c.optimizer.minimum_gap.value_or(0)},
          {"minimum_radius_m", c.optimizer.minimum_radius.value_or(0)},
          {"bounds", bounds_json(c)}};
}

template <int dim>
Json wheel_json(const WatchedShape<dim>& shape) {
  const PolarGrid<dim>& grid = shape.psi.lattice.grid();
  const HoleRange room = free_region(*shape.source);
  Json json{{"dimension", dim},
            {"inner_radius_m", grid.inner_radius},
            {"outer_radius_m", grid.outer_radius},
            {"width_m", grid.width},
            {"sectors", grid.n_sectors},
            {"hole_inner_radius_m", room.inner},
            {"hole_outer_radius_m", room.outer},
            {"cell_m", grid.resolution()},
            {"shows_smaller_z", shown_side_face(*shape.source) == SideFace::smaller_z},
            {"stands_on_ground", shape.source->contact.with == Counterpart::ground}};
  if (const LayerCircles layers = layer_circles(materials<dim>(*shape.source)); !layers.empty())
    json["layers"] = {{"radii_m", layers.radii}, {"names", layers.names}};
  return json;
}

template <int dim>
Json numbers_json(const WatchedShape<dim>& shape) {
  Json numbers{{dim == 2 ? "objective_J_per_m" : "objective_J", number(shape.objective)},
               {"initial_objective", number(shape.initial_objective)},
               {"volume_fraction", shape.measure / sector_measure<dim>(shape.psi.lattice.grid())}};
  for (const TermValue& term : shape.terms) numbers[term.name] = number(term.value);
  for (const MeasureValue& measure : shape.measures) numbers[measure.name] = number(measure.value);
  return numbers;
}

Json outline_json(const LevelSet<2>& psi) {
  Json loops = Json::array();
  for (OutlineLoop& loop : sector_outline(psi))
    loops.push_back(
        {{"in_every_sector", loop.is_in_every_sector}, {"points_um", std::move(loop.micrometres)}});
  return loops;
}

/// The wheel's numbers that follow directly from the contacts, by the keys of wheel_numbers().
template <int dim>
Json contact_numbers_json(const State<dim>& state) {
  const RollingMeasures measures = rolling_measures(contact_summaries(state));
  Json numbers{{"mean_travel_m", measures.mean_travel}, {"peak_pressure_Pa", measures.peak_pressure}};
  if (!state.model().travel) numbers["run_out_m"] = measures.run_out;
  return numbers;
}

/// Whether bounds of the case are met.
template <int dim>
Json bound_states_json(const WatchedShape<dim>& shape) {
  Json bounds = Json::array();
  for (const BoundState& bound : shape.bounds)
    bounds.push_back({{"name", bound.name},
                      {"shown", shown_json(bound.unit, *shape.source)},
                      {"value", number(bound.value)},
                      {"relation", std::string(1, bound.relation)},
                      {"limit", bound.bound},
                      {"is_kept", bound.is_kept()},
                      {"kept_within", bound.kept_within()}});
  return bounds;
}

/// The travel of the rim at all load positions of a sector.
template <int dim>
Json travel_json(const State<dim>& state) {
  std::vector<double> travel;
  for (const auto& contact : state.contacts()) travel.push_back(contact.travel());
  return of_all(state.positions(), travel);
}

template <int dim>
Json pressure_json(const StateSolver<dim>& solver, const State<dim>& state, int position) {
  Json x = Json::array(), pressure = Json::array();
  for (const ContactPoint& point : curve_points<dim>(contact_points(solver, state))) {
    if (point.position != position) continue;
    x.push_back(point.x);
    pressure.push_back(point.pressure);
  }
  return {{"position", position}, {"x_m", std::move(x)}, {"pressure_Pa", std::move(pressure)}};
}

/// The mean travel of the rim under forces up to one and a half times the present one; omitting forces for
/// which it cannot be computed.
template <int dim>
Json force_curve_json(const State<dim>& state, double width) {
  double force = 0;
  for (const auto& contact : state.contacts()) force += contact.rim_force.towards_ground;
  force /= static_cast<double>(state.contacts().size());
  std::vector<double> loads;
  for (const double factor : {0.25, 0.5, 0.75, 1.0, 1.25, 1.5}) loads.push_back(factor * force);
  const auto under = under_loads<dim>(state, loads);
  Json forces{0.0}, travels{0.0};
  for (std::size_t k = 0; k < loads.size(); ++k) {
    if (!under[k]) continue;
    std::vector<double> travel;
    for (const ContactSummary& summary : *under[k]) travel.push_back(summary.travel);
    forces.push_back(loads[k] * whole_width(dim, width));
    travels.push_back(rolling_variation(of_all(state.positions(), travel)).mean);
  }
  return {{"force_N", std::move(forces)}, {"travel_m", std::move(travels)}};
}

}  // namespace

template <int dim>
std::string frame_json(const BoardView<dim>& view, const std::vector<HistoryPoint>& curve,
                       const FrameQuery& query) {
  Json json{{"version", view.version},
            {"activity", to_string(view.activity)},
            {"reason", view.reason ? Json(to_string(*view.reason)) : Json()},
            {"can_undo", view.can_undo},
            {"message", view.message},
            {"is_refusal", view.is_refusal}};
  Json points = Json::array();
  for (const HistoryPoint& p : curve)
    points.push_back({p.shape, number(p.objective), number(p.mean_travel), number(p.run_out),
                      p.volume_fraction, number(p.initial_objective)});
  json["curve"] = std::move(points);
  if (view.shape) {
    const WatchedShape<dim>& shape = *view.shape;
    const int load_case = query.load_case < std::ssize(shape.solutions) ? query.load_case : 0;
    const State<dim>& state = *shape.solutions[load_case];
    json["title"] = run_title(*shape.source);
    json["shape"] = shape.number;
    json["shape_version"] = view.shape_version;
    json["wheel"] = wheel_json(shape);
    json["settings"] = settings_json(shape);
    json["numbers"] = numbers_json(shape);
    json["load_case"] = load_case;
    json["contact_numbers"] = contact_numbers_json(state);
    json["bounds"] = bound_states_json(shape);
    json["is_proposed"] = view.proposed != nullptr;
    if constexpr (dim == 2) json["outline"] = outline_json(view.proposed ? *view.proposed : shape.psi);
    if constexpr (dim == 2)
      if (query.wants_initial_outline) json["initial_outline"] = outline_json(view.first->psi);
    json["travel_m"] = travel_json(state);
    json["pressure"] = pressure_json(*shape.solver, state, query.position);
    if (query.wants_force_curve) json["force_curve"] = force_curve_json(state, shape.source->wheel.width);
  }
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

template <int dim>
std::string loaded_json(const BoardView<dim>& view, int load_case, int position) {
  const WatchedShape<dim>& shape = *view.shape;
  double travel = 0;
  for (const auto& contact : shape.solutions[load_case]->contacts())
    travel = std::max(travel, std::abs(contact.travel()));
  Json json{{"shape_version", view.shape_version},
            {"shape", shape.number},
            {"load_case", load_case},
            {"position", position},
            {"n_positions", shape.solver->model().n_positions},
            {"travel_m", travel}};
  if constexpr (dim == 2) json["outline"] = outline_json(shape.psi);
  std::string text = json.dump();
  text.back() = ',';
  return text + "\"fields\":" + loaded_wheel(solved(shape, load_case), position) + '}';
}

template decltype(loaded_json<2>) loaded_json<2>;
template decltype(loaded_json<3>) loaded_json<3>;
template decltype(frame_json<2>) frame_json<2>;
template decltype(frame_json<3>) frame_json<3>;

}  // namespace wheelwright
