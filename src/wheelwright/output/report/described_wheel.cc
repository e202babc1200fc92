#include "wheelwright/output/report/described_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/mechanics/state/layer_measures.h"
#include "wheelwright/output/report/heat_report.h"
#include "wheelwright/quantities/functionals/quantities.h"
#include "wheelwright/shape/evolution/narrowest_place.h"

namespace wheelwright {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

template <int dim>
std::vector<double> of_positions(const LoadedWheel<dim>& wheel, double ContactSummary::*member) {
  std::vector<double> values;
  for (const ContactSummary& position : wheel.rolling.positions) values.push_back(position.*member);
  return values;
}

/// The amplitude of the lowest harmonic possible for a wheel of equal sectors.
double first_harmonic(const std::vector<double>& values) {
  const auto harmonics = rolling_variation(values).harmonics;
  return harmonics.empty() ? 0 : harmonics.front();
}

template <int dim>
std::optional<double> mass(const RollingModel<dim>& model, const LevelSet<dim>& psi, double volume_fraction) {
  const std::optional<double> density = mean_density(model.materials, psi);
  if (!density) return {};
  const PolarGrid<dim>& grid = model.grid;
  const double area =
      std::numbers::pi * (grid.outer_radius * grid.outer_radius - grid.inner_radius * grid.inner_radius);
  return *density * volume_fraction * area * (dim == 3 ? grid.width : 1);
}

/// Tolerance of the curves relative to the tread's radius: that of exported outlines.
constexpr double curve_tolerance = 3e-5;

/// A number of a wheel; nothing if the wheel cannot have one.
using Number = std::optional<KnownNumber>;

/// A value of the fatigue under all load cases, if it is known.
template <int dim, class Value>
Number of_damage(const DescribedWheel<dim>& wheel, const Value& value) {
  if (!wheel.damage) return {};
  if (!*wheel.damage) return to_string(wheel.damage->failure());
  return value(**wheel.damage);
}

/// A value of the wheel under its load.
template <int dim, class Value>
Number under_load(const DescribedWheel<dim>& wheel, const Value& value) {
  if (!wheel.loaded) return to_string(wheel.loaded.failure());
  return value(*wheel.loaded);
}

/// A value of a curve over the load positions, times a factor.
template <int dim, class Value>
Number of_curve(const DescribedWheel<dim>& wheel, Expected<std::vector<double>> RollingAnalysis::*curve,
                double factor, const Value& value) {
  return under_load(wheel, [&](const LoadedWheel<dim>& loaded) -> Number {
    const auto& values = loaded.rolling.*curve;
    if (!values) return to_string(values.failure());
    return factor * value(*values);
  });
}

double peak_to_peak(const std::vector<double>& values) { return rolling_variation(values).peak_to_peak(); }

template <int dim>
double width(const DescribedWheel<dim>& wheel) {
  return whole_width(dim, wheel.grid.width);
}

template <int dim>
Number width_of(const DescribedWheel<dim>& wheel, std::optional<cad::Clearance> cad::Clearances::*which) {
  if (!wheel.outline) return wheel.outline.failure().what;
  const auto& clearance = wheel.outline->clearances.*which;
  return clearance ? Number(clearance->width) : std::nullopt;
}

/// Nothing if there are no holes.
template <int dim>
Number of_edges(const DescribedWheel<dim>& wheel, Number (*value)(const cad::Roughness&)) {
  if (!wheel.outline) return wheel.outline.failure().what;
  return wheel.outline->roughness ? value(*wheel.outline->roughness) : std::nullopt;
}

template <int dim>
Number patch_extent(const DescribedWheel<dim>& wheel) {
  return under_load(wheel, [](const LoadedWheel<dim>& w) -> Number {
    const double length = mean(of_positions(w, &ContactSummary::patch_length)),
                 extent = mean(of_positions(w, &ContactSummary::patch_extent));
    return extent > length ? Number(extent) : std::nullopt;
  });
}

/// A value of the losses, if they are known.
template <int dim, class Value>
Number of_losses(const DescribedWheel<dim>& wheel, const Value& value) {
  return under_load(wheel, [&](const LoadedWheel<dim>& loaded) -> Number {
    if (!loaded.losses) return {};
    if (!*loaded.losses) return to_string(loaded.losses->failure());
    return value(**loaded.losses);
  });
}

/// The number of a layer from the rim; nothing if the wheel, which must be loaded, has none of that name.
template <int dim>
std::optional<std::size_t> index_of_layer(const DescribedWheel<dim>& wheel, const std::string& layer) {
  const auto& layers = wheel.loaded->rolling.layers;
  const auto found = std::ranges::find(layers, layer, &LayerResults::name);
  if (found == layers.end()) return {};
  return found - layers.begin();
}

/// A value of the fatigue results, if they are known.
template <int dim, class Value>
Number of_fatigue(const DescribedWheel<dim>& wheel, const Value& value) {
  return under_load(wheel, [&](const LoadedWheel<dim>& loaded) -> Number {
    if (!loaded.fatigue) return {};
    if (!*loaded.fatigue) return to_string(loaded.fatigue->failure());
    return value(**loaded.fatigue);
  });
}

/// A value of the heat results, if they are known.
template <int dim, class Value>
Number of_heat(const DescribedWheel<dim>& wheel, const Value& value) {
  return under_load(wheel, [&](const LoadedWheel<dim>& loaded) -> Number {
    if (!loaded.heat) return {};
    if (!*loaded.heat) return to_string(loaded.heat->failure());
    return value(**loaded.heat);
  });
}

template <int dim>
Expected<LoadedWheel<dim>> loaded_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                        const SolvedStates<dim>& states) {
  if (!states) return states.failure();
  RollingAnalysis rolling = rolling_analysis(solver, **states);
  const auto deformation = deformation_size<dim>(solver, psi, **states, rolling.deformations);
  return LoadedWheel<dim>{shape_summary(solver, **states),
                          std::move(rolling),
                          deformation,
                          rolling_losses(solver, psi, **states),
                          fatigue_results(solver, psi, **states),
                          heat_results(solver, psi, **states)};
}

template <int dim>
Expected<std::vector<UtilizedPoints>> utilized(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                               const SolvedStates<dim>& states) {
  if (!states) return states.failure();
  return utilized_points(solver, psi, **states);
}

/// The narrowest place of walls or holes in 3D, whose ends are seen along the axle.
std::optional<cad::Clearance> clearance(const MedialBalls<3>& medial, Side side) {
  const auto narrowest = narrowest_place(medial, side);
  if (!narrowest) return {};
  const Vec<2> middle{narrowest->middle[0], narrowest->middle[1]};
  return cad::Clearance{narrowest->width, middle, middle};
}

}  // namespace

template <int dim>
Expected<OutlineMeasures, cad::OutlineFault> outline_measures(const LevelSet<dim>& psi) {
  if constexpr (dim == 2) {
    const PolarGrid<2>& grid = psi.lattice.grid();
    const auto outline = cad::fit_outline(psi, curve_tolerance * grid.outer_radius);
    if (!outline) return outline.failure();
    return OutlineMeasures{cad::clearances(*outline, grid.n_sectors, cad::clearance_step * grid.outer_radius),
                           cad::roughness(*outline, grid.n_sectors, grid.resolution())};
  } else {
    const MedialBalls<3> medial(psi);
    return OutlineMeasures{.clearances = {clearance(medial, Side::material), clearance(medial, Side::holes)},
                           .closed_cavities = closed_cavities(psi)};
  }
}

template <int dim>
std::optional<cad::Roughness> roughness(const DescribedWheel<dim>& wheel) {
  return wheel.outline ? wheel.outline->roughness : std::nullopt;
}

template <int dim>
DescribedWheel<dim> described_solution(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                       double volume_fraction, const SolvedStates<dim>& states,
                                       const LoadCases<dim>& cases, const OwnNumbers<dim>& own_numbers) {
  DescribedWheel<dim> wheel{.name = {},
                            .which = {},
                            .grid = solver.model().grid,
                            .volume_fraction = volume_fraction,
                            .mass = mass(solver.model(), psi, volume_fraction),
                            .outline = OutlineMeasures{},
                            .loaded = loaded_wheel(solver, psi, states),
                            .own = own_numbers ? own_numbers(states) : std::vector<OwnNumber>()};
  wheel.layers = layer_circles(solver.model().materials);
  if (!cases.empty()) wheel.load_case = cases.front().name;
  const auto shares = distance_shares(cases);
  const bool sums_damage = !shares.empty() && knows_fatigue_lives(solver.model().materials);
  std::vector<Expected<std::vector<UtilizedPoints>>> by_case;
  if (sums_damage) by_case.push_back(utilized(solver, psi, states));
  for (std::size_t k = 1; k < cases.size(); ++k) {
    DescribedWheel<dim> other = wheel;
    other.others.clear();
    other.load_case = cases[k].name;
    const auto under_load =
        states ? (*states)->under(with_loads((*states)->model(), cases[k].model), Interrupt()) : states;
    other.loaded = loaded_wheel(solver, psi, under_load);
    if (own_numbers) other.own = own_numbers(under_load);
    wheel.others.push_back(std::move(other));
    if (sums_damage) by_case.push_back(utilized(solver, psi, under_load));
  }
  if (sums_damage) wheel.damage = sum_of_damages(solver.model().materials, by_case, shares);
  return wheel;
}

template <int dim>
DescribedWheel<dim> described_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                    double volume_fraction, const SolvedStates<dim>& states,
                                    const LoadCases<dim>& cases, const OwnNumbers<dim>& own_numbers) {
  auto wheel = described_solution(solver, psi, volume_fraction, states, cases, own_numbers);
  wheel.outline = outline_measures(psi);
  for (DescribedWheel<dim>& other : wheel.others) other.outline = wheel.outline;
  return wheel;
}

template <int dim>
DescribedWheel<dim> with_errors(DescribedWheel<dim> wheel, const KnownFinerWheel<dim>& finer) {
  wheel.finer = std::make_shared<const KnownFinerWheel<dim>>(finer);
  for (DescribedWheel<dim>& other : wheel.others) {
    const auto* same = finer ? under_load_case(finer->wheel, other.load_case) : nullptr;
    other.finer =
        same ? std::make_shared<const KnownFinerWheel<dim>>(FinerWheel<dim>{*same, finer->refinement})
             : wheel.finer;
  }
  return wheel;
}

template <int dim>
const DescribedWheel<dim>* under_load_case(const DescribedWheel<dim>& wheel, const std::string& load_case) {
  const auto found = std::ranges::find(wheel.others, load_case, &DescribedWheel<dim>::load_case);
  return found == wheel.others.end() ? nullptr : &*found;
}

template <int dim>
std::vector<std::string> load_cases_of(const DescribedWheel<dim>& wheel) {
  std::vector<std::string> names;
  if (!wheel.load_case.empty()) names.push_back(wheel.load_case);
  for (const DescribedWheel<dim>& other : wheel.others) names.push_back(other.load_case);
  return names;
}

template <int dim>
std::vector<std::string> too_warm(const DescribedWheel<dim>& wheel) {
  if (!wheel.loaded || !wheel.loaded->heat || !*wheel.loaded->heat) return {};
  std::vector<std::string> layers;
  for (const LayerResults& layer : wheel.loaded->rolling.layers) layers.push_back(layer.name);
  return too_warm(**wheel.loaded->heat, layers);
}

template <int dim>
std::optional<double> known_value(const WheelNumber<dim>& number, const DescribedWheel<dim>& wheel) {
  const auto value = number.value(wheel);
  return value && *value ? std::optional(**value) : std::nullopt;
}

namespace {

Converges convergence(const Quantity& quantity) {
  return quantity->is_maximum ? Converges::as_an_extreme : Converges::as_an_integral;
}

/// A number that is a quantity of cases; by default with its label.
template <int dim>
WheelNumber<dim> number(const Quantity& of,
                        std::function<std::optional<KnownNumber>(const DescribedWheel<dim>&)> value,
                        std::string_view own_label = {}) {
  return {own_label.empty() ? label(of) : std::string(own_label),
          kind(of),
          number_key(of, dim),
          std::move(value),
          of->of == Positions::none,
          convergence(of)};
}

template <int dim>
WheelNumber<dim> number(std::string_view quantity,
                        std::optional<KnownNumber> (*value)(const DescribedWheel<dim>&),
                        std::string own_label = {}) {
  return number<dim>(built_in(quantity), value, std::move(own_label));
}

template <int dim>
std::vector<WheelNumber<dim>> numbers_under_load() {
  using Wheel = DescribedWheel<dim>;
  using Loaded = LoadedWheel<dim>;
  return {{"load", UnitKind::force, "load_N",
           [](const Wheel& w) {
             return under_load(w, [&](const Loaded& l) { return l.rolling.load * width(w); });
           }},
          number<dim>("mean_travel",
                      [](const Wheel& w) {
                        return under_load(w, [](const Loaded& l) {
                          return mean(of_positions(l, &ContactSummary::travel));
                        });
                      }),
          number<dim>("stiffness",
                      [](const Wheel& w) {
                        return under_load(w, [&](const Loaded& l) { return l.summary.stiffness * width(w); });
                      }),
          number<dim>(
              "run_out",
              [](const Wheel& w) { return of_curve(w, &RollingAnalysis::travel_at_load, 1, peak_to_peak); },
              "run-out at fixed load"),
          {"  its first sector harmonic", UnitKind::length, "run_out_first_harmonic_m",
           [](const Wheel& w) { return of_curve(w, &RollingAnalysis::travel_at_load, 1, first_harmonic); },
           false, Converges::as_an_extreme},
          number<dim>(
              "force_variation",
              [](const Wheel& w) {
                return of_curve(w, &RollingAnalysis::force_at_travel, width(w), peak_to_peak);
              },
              "radial force variation at fixed travel"),
          {"  its first sector harmonic", UnitKind::force, "force_first_harmonic_N",
           [](const Wheel& w) {
             return of_curve(w, &RollingAnalysis::force_at_travel, width(w), first_harmonic);
           },
           false, Converges::as_an_extreme},
          number<dim>("peak_pressure",
                      [](const Wheel& w) {
                        return under_load(w, [](const Loaded& l) { return l.summary.rolling.peak_pressure; });
                      }),
          {"mean length of the contact patch", UnitKind::length, "patch_length_m",
           [](const Wheel& w) {
             return under_load(
                 w, [](const Loaded& l) { return mean(of_positions(l, &ContactSummary::patch_length)); });
           },
           false, Converges::as_an_extreme},
          {"  with its gaps", UnitKind::length, "patch_extent_m",
           [](const Wheel& w) { return patch_extent(w); }, false, Converges::as_an_extreme},
          number<dim>("peak_von_mises",
                      [](const Wheel& w) {
                        return under_load(w, [](const Loaded& l) { return l.summary.von_mises.value; });
                      }),
          number<dim>("largest_strain",
                      [](const Wheel& w) {
                        return under_load(w, [](const Loaded& l) { return l.deformation.strain; });
                      }),
          number<dim>("strain_energy", [](const Wheel& w) {
            return under_load(w, [](const Loaded& l) { return l.summary.strain_energy; });
          })};
}

/// Of wheels whose materials have loss factors.
template <int dim>
std::vector<WheelNumber<dim>> numbers_of_losses() {
  using Wheel = DescribedWheel<dim>;
  return {number<dim>("rolling_resistance",
                      [](const Wheel& w) {
                        return of_losses(w, [&](const RollingLosses& l) { return l.resistance * width(w); });
                      }),
          {"  unresolved by the load positions, at most", UnitKind::force, "rolling_resistance_unresolved_N",
           [](const Wheel& w) {
             return of_losses(w, [&](const RollingLosses& l) { return l.beyond * width(w); });
           },
           false, Converges::as_an_extreme},
          number<dim>("rolling_resistance_coefficient", [](const Wheel& w) {
            return of_losses(w, [](const RollingLosses& l) { return l.coefficient; });
          })};
}

/// The worst place of the ring, or of a layer; null if the wheel has no such layer.
template <int dim, class Results>
const FatigueResults::Worst* worst_place(const Results& results, const DescribedWheel<dim>& wheel,
                                         const std::optional<PartOfRing>& part) {
  if (!part) return &results.worst;
  const auto layer = wheel.loaded ? index_of_layer(wheel, part->name) : std::nullopt;
  return layer && *layer < results.by_layer.size() ? &results.by_layer[*layer] : nullptr;
}

template <int dim>
Number utilization_at(const FatigueResults::Worst* place, const DescribedWheel<dim>&) {
  return place ? Number(place->utilization) : std::nullopt;
}

/// As a distance.
template <int dim>
Number life_at(const FatigueResults::Worst* place, const DescribedWheel<dim>& wheel) {
  if (!place || !place->life) return {};
  return *place->life * 2 * std::numbers::pi * wheel.grid.outer_radius;
}

/// Of wheels whose materials have fatigue strengths: of the ring or of a layer, under a load, and under all
/// load cases if their shares of the distance are known.
template <int dim>
std::vector<WheelNumber<dim>> numbers_of_fatigue(const std::optional<PartOfRing>& part = {}) {
  using Wheel = DescribedWheel<dim>;
  using Value = Number (*)(const FatigueResults::Worst*, const Wheel&);
  const Quantity quantity =
      part ? in_part(built_in("fatigue_utilization"), *part) : built_in("fatigue_utilization");
  const std::string life_label = of_part("fatigue life", part), life_key = of_part("fatigue_life_m", part),
                    in_all = " in all load cases";
  const auto under_load = [&](Value value) {
    return [part, value](const Wheel& wheel) {
      return of_fatigue(wheel,
                        [&](const FatigueResults& f) { return value(worst_place(f, wheel, part), wheel); });
    };
  };
  const auto under_all = [&](Value value) {
    return [part, value](const Wheel& wheel) {
      return of_damage(wheel,
                       [&](const FatigueDamage& d) { return value(worst_place(d, wheel, part), wheel); });
    };
  };
  const auto as_extreme = Converges::as_an_extreme, as_power = Converges::as_a_power;
  return {
      number<dim>(quantity, under_load(utilization_at<dim>)),
      {life_label, UnitKind::distance, life_key, under_load(life_at<dim>), false, as_power},
      {label(quantity) + in_all, kind(quantity), number_key(quantity, dim) + in_all,
       under_all(utilization_at<dim>), false, as_extreme},
      {life_label + in_all, UnitKind::distance, life_key + in_all, under_all(life_at<dim>), false, as_power}};
}

/// Of wheels that say how warm they get.
template <int dim>
std::vector<WheelNumber<dim>> numbers_of_heat() {
  using Wheel = DescribedWheel<dim>;
  return {number<dim>("peak_temperature",
                      [](const Wheel& w) {
                        return of_heat(w, [](const HeatResults& h) { return h.peak.temperature; });
                      }),
          {"heat of the rolling wheel", UnitKind::power, "heat_W", [](const Wheel& w) {
             return of_heat(w, [&](const HeatResults& h) { return h.heat * width(w); });
           }}};
}

/// How far the wheel is from what linear elasticity assumes, besides its largest strain.
template <int dim>
std::vector<WheelNumber<dim>> numbers_of_deformation() {
  using Wheel = DescribedWheel<dim>;
  using Loaded = LoadedWheel<dim>;
  return {
      {"largest rotation", UnitKind::angle, "largest_rotation_rad",
       [](const Wheel& w) { return under_load(w, [](const Loaded& l) { return l.deformation.rotation; }); },
       false, Converges::as_an_extreme},
      {"largest travel by the ring's thickness", UnitKind::ratio, "travel_by_ring_thickness",
       [](const Wheel& w) { return under_load(w, [](const Loaded& l) { return l.deformation.travel; }); }},
      {"error of linear theory, estimated", UnitKind::ratio, "linear_theory_error", [](const Wheel& w) {
         return under_load(w, [](const Loaded& l) -> Number {
           return l.deformation.of_linear_theory ? Number(l.deformation.error.size()) : std::nullopt;
         });
       }}};
}

/// Measured on the curves fitted to the edges.
template <int dim>
std::vector<WheelNumber<dim>> numbers_of_outline() {
  using Wheel = DescribedWheel<dim>;
  return {number<dim>("minimum_wall", [](const Wheel& w) { return width_of(w, &cad::Clearances::wall); }),
          number<dim>("minimum_gap", [](const Wheel& w) { return width_of(w, &cad::Clearances::gap); }),
          number<dim>("roughness",
                      [](const Wheel& w) {
                        return of_edges(w, [](const cad::Roughness& r) -> Number { return r.edge.turns; });
                      }),
          {"smallest radius of an internal corner", UnitKind::length, "internal_corner_radius_m",
           [](const Wheel& w) {
             return of_edges(w, [](const cad::Roughness& r) {
               return r.internal_corner ? Number(r.internal_corner->radius) : std::nullopt;
             });
           },
           true}};
}

}  // namespace

template <int dim>
const std::vector<WheelNumber<dim>>& wheel_numbers() {
  using Wheel = DescribedWheel<dim>;
  static const std::vector<WheelNumber<dim>> numbers = [] {
    std::vector<WheelNumber<dim>> all{
        number<dim>("volume_fraction", [](const Wheel& w) -> Number { return w.volume_fraction; }),
        number<dim>("mass", [](const Wheel& w) -> Number {
          return w.mass ? Number(*w.mass * width(w)) : std::nullopt;
        })};
    for (const auto& more :
         {numbers_under_load<dim>(), numbers_of_losses<dim>(), numbers_of_fatigue<dim>(),
          numbers_of_heat<dim>(), numbers_of_deformation<dim>(), numbers_of_outline<dim>()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return numbers;
}

template <int dim>
std::vector<WheelNumber<dim>> layer_numbers(const std::string& layer) {
  using Value = std::optional<double> (*)(const LayerResults&, double width);
  const auto of_layer = [&](std::string_view quantity, Value value) {
    const auto of_wheel = [layer, value](const DescribedWheel<dim>& wheel) {
      return under_load(wheel, [&](const LoadedWheel<dim>& loaded) -> Number {
        const auto k = index_of_layer(wheel, layer);
        const auto known = k ? value(loaded.rolling.layers[*k], width(wheel)) : std::nullopt;
        return known ? Number(*known) : std::nullopt;
      });
    };
    return number<dim>(in_part(built_in(quantity), {layer, 0, 0}), of_wheel);
  };
  const auto resistance = [layer](const DescribedWheel<dim>& wheel) {
    return of_losses(wheel, [&](const RollingLosses& losses) -> Number {
      const auto k = index_of_layer(wheel, layer);
      return k ? Number(losses.by_layer[*k] * width(wheel)) : std::nullopt;
    });
  };
  const auto temperature = [layer](const DescribedWheel<dim>& wheel) {
    return of_heat(wheel, [&](const HeatResults& heat) -> Number {
      const auto& layers = wheel.loaded->rolling.layers;
      const auto found = std::ranges::find(layers, layer, &LayerResults::name);
      if (found == layers.end()) return {};
      return heat.by_layer[found - layers.begin()].temperature;
    });
  };
  std::vector<WheelNumber<dim>> numbers{
      number<dim>(in_part(built_in("rolling_resistance"), {layer, 0, 0}), resistance),
      number<dim>(in_part(built_in("peak_temperature"), {layer, 0, 0}), temperature),
      of_layer("mass", [](const LayerResults& l,
                          double width) { return l.mass ? std::optional(*l.mass * width) : std::nullopt; }),
      of_layer("peak_von_mises",
               [](const LayerResults& l, double) { return std::optional(l.peak_von_mises); }),
      of_layer("largest_strain",
               [](const LayerResults& l, double) { return std::optional(l.largest_strain); })};
  std::ranges::copy(numbers_of_fatigue<dim>(PartOfRing{layer, 0, 0}), std::back_inserter(numbers));
  return numbers;
}

template <int dim>
std::vector<WheelNumber<dim>> numbers_of(const DescribedWheel<dim>& wheel) {
  std::vector<WheelNumber<dim>> all = wheel_numbers<dim>();
  for (const std::string& layer : wheel.layers.names)
    std::ranges::copy(layer_numbers<dim>(layer), std::back_inserter(all));
  for (const OwnNumber& own : wheel.own)
    all.push_back(
        number<dim>(own.quantity, [quantity = own.quantity](const DescribedWheel<dim>& of) -> Number {
          const auto found = std::ranges::find(of.own, quantity, &OwnNumber::quantity);
          return found == of.own.end() ? std::nullopt : Number(found->value);
        }));
  return all;
}

namespace {

/// The estimate of an error that uses no other number.
template <int dim>
double by_two_grids(const WheelNumber<dim>& number, double value, double on_finer, double refinement) {
  return discretization_error(value, on_finer, refinement, number.converges);
}

/// The largest relative error among the numbers that measure the displacements as a whole.
template <int dim>
double error_of_displacements(const DescribedWheel<dim>& wheel, const FinerWheel<dim>& finer) {
  double largest = 0;
  for (const WheelNumber<dim>& number : wheel_numbers<dim>()) {
    const auto is = [&](std::string_view quantity) {
      return number.key == number_key(built_in(quantity), dim);
    };
    if (!is("mean_travel") && !is("stiffness") && !is("strain_energy")) continue;
    const auto value = known_value(number, wheel), on_finer = known_value(number, finer.wheel);
    if (!value || !on_finer || *value == 0) continue;
    largest = std::max(largest, by_two_grids(number, *value, *on_finer, finer.refinement) / std::abs(*value));
  }
  return largest;
}

/// Whether a number depends on the displacements: a given load, for example, does not.
template <int dim>
bool depends_on_displacements(const WheelNumber<dim>& number, double value, double on_finer) {
  constexpr double rounding = 1e-9;
  return !number.is_of_shape && std::abs(value - on_finer) > rounding * std::abs(value);
}

}  // namespace

template <int dim>
std::optional<KnownNumber> error_of(const WheelNumber<dim>& number, const DescribedWheel<dim>& wheel) {
  const auto value = known_value(number, wheel);
  if (!value || !wheel.finer) return {};
  const KnownFinerWheel<dim>& finer = *wheel.finer;
  if (!finer) return finer.failure();
  const auto on_finer = number.value(finer->wheel);
  if (!on_finer) return {};
  if (!*on_finer) return "on the finer grid: " + on_finer->failure();
  if (!std::isfinite(**on_finer)) return std::string("it is not finite on the finer grid");
  const double error = by_two_grids(number, *value, **on_finer, finer->refinement);
  if (!depends_on_displacements(number, *value, **on_finer)) return error;
  return std::max(error, least_share_of_error * error_of_displacements(wheel, *finer) * std::abs(*value));
}

template decltype(described_wheel<2>) described_wheel<2>;
template decltype(described_solution<2>) described_solution<2>;
template decltype(with_errors<2>) with_errors<2>;
template decltype(error_of<2>) error_of<2>;
template decltype(under_load_case<2>) under_load_case<2>;
template decltype(load_cases_of<2>) load_cases_of<2>;
template decltype(load_cases_of<3>) load_cases_of<3>;
template decltype(outline_measures<2>) outline_measures<2>;
template decltype(roughness<2>) roughness<2>;
template decltype(known_value<2>) known_value<2>;
template std::vector<std::string> too_warm(const DescribedWheel<2>&);
template decltype(wheel_numbers<2>) wheel_numbers<2>;
template decltype(layer_numbers<2>) layer_numbers<2>;
template decltype(numbers_of<2>) numbers_of<2>;
template decltype(described_wheel<3>) described_wheel<3>;
template decltype(described_solution<3>) described_solution<3>;
template decltype(with_errors<3>) with_errors<3>;
template decltype(error_of<3>) error_of<3>;
template decltype(under_load_case<3>) under_load_case<3>;
template decltype(outline_measures<3>) outline_measures<3>;
template decltype(roughness<3>) roughness<3>;
template decltype(known_value<3>) known_value<3>;
template std::vector<std::string> too_warm(const DescribedWheel<3>&);
template decltype(wheel_numbers<3>) wheel_numbers<3>;
template decltype(layer_numbers<3>) layer_numbers<3>;
template decltype(numbers_of<3>) numbers_of<3>;

}  // namespace wheelwright
