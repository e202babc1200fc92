#include "wheelwright/run/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "wheelwright/cad/drawing/composed_level_set.h"
#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/drawn_shapes.h"
#include "wheelwright/case/ground_of.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/objective_weights.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/quantities/functionals/mean_contact_stress.h"
#include "wheelwright/run/study/bounded_functions.h"
#include "wheelwright/run/study/filled_holes.h"
#include "wheelwright/run/study/moved_studies.h"
#include "wheelwright/shape/cut/boundary_kinks.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/regrid.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/shape/geometry/components.h"
#include "wheelwright/shape/geometry/moved_lines.h"
#include "wheelwright/shape/geometry/section.h"
#include "wheelwright/shape/geometry/values_on.h"

namespace wheelwright {
namespace {

/// Converts a value for the whole width to that of the model of this dimension.
template <int dim>
double on_model_width(double on_whole_width, const Case& c) {
  return on_whole_width / whole_width(dim, c.wheel.width);
}

}  // namespace

namespace {

/// The loads of a case with only one load.
template <int dim>
WheelLoads<dim> applied_loads(const Case& c, RollingModel<dim> wheel) {
  WheelLoads<dim> loads{.load = on_model_width<dim>(c.load.force, c),
                        .horizontal_force = on_model_width<dim>(c.load.horizontal_force, c),
                        .lateral_force = c.load.lateral_force,
                        .torque = on_model_width<dim>(c.load.torque, c),
                        .travel = c.load.travel};
  const auto [along_ground, down] = c.load.body_force;
  loads.distributed.body_force[0] = down;
  loads.distributed.body_force[1] = along_ground;
  loads.distributed.hole_pressure = c.load.hole_pressure;
  loads.distributed.angular_speed = c.load.speed / c.wheel.outer_radius;
  loads.ground = ground_of(c.load);
  wheel.loads() = loads;
  for (const auto& [key, value] : c.load.own) key->effect.act(value, std::as_const(wheel), loads);
  return loads;
}

}  // namespace

template <int dim>
RollingModel<dim> rolling_model(const Case& c) {
  RollingModel<dim> model;
  model.grid = polar_grid<dim>(c);
  model.degree = c.grid.degree;
  model.dilatation = c.grid.dilatation;
  model.materials = materials<dim>(c);
  model.ghost = c.ghost_penalty;
  model.side_faces = c.wheel.side_faces;
  model.contact = {.method = c.contact.method,
                   .theta_nitsche = c.contact.theta,
                   .gamma_0 = c.contact.gamma_0,
                   .friction = c.contact.friction,
                   .counterpart = c.contact.with};
  model.contact_points = c.contact.quadrature_points;
  if (optimizes_edges(c))
    model.cut_points = std::max(model.points_in_cut_cells(), points_for_kinks<dim>(level_set_degree(c)));
  model.tread = {tread_rows(c), tread_levels(c), wants_annulus(c) ? c.grid.degree + 1 : 0};
  model.camber = c.load.camber;
  const std::vector<Case> single = single_load_cases(c);
  model.loads() = applied_loads<dim>(single.front(), model);
  model.tread.observes_spin =
      std::ranges::any_of(single, [](const Case& each) { return each.load.speed != 0; });
  model.n_positions = c.load.positions;
  model.design_lines = design_lines(c);
  model.cooling = cooling(c);
  return model;
}

template <int dim>
LoadCases<dim> load_cases(const Case& c) {
  LoadCases<dim> result;
  if (c.load.cases.empty()) return result;
  RollingModel<dim> model = rolling_model<dim>(c);
  const std::vector<Case> single = single_load_cases(c);
  for (std::size_t k = 0; k < single.size(); ++k) {
    model.loads() = applied_loads<dim>(single[k], model);
    result.push_back({c.load.cases[k].name, model, c.load.cases[k].distance_share});
  }
  return result;
}

namespace {

/// alpha_1 from alpha_2 by (83), on the initial shape.
template <int dim>
Expected<double> matching_weight(const Case& c, const StateSolver<dim>& solver) {
  const LevelSet<dim> shape = initial_shape<dim>(c);
  const auto states = solver.states(shape, solver.all_positions(), Interrupt());
  if (!states) return states.failure();
  const Matrix mean = mean_observations(solver.tread_surface(), **states);
  const auto value = [&](std::string_view quantity) -> Expected<double> {
    const auto term = functional_of(built_in(quantity), Over::positions, quantity_context(c, solver));
    if (!term) return term.failure();
    const auto by_position = term->functional->evaluate(solver, shape, **states, mean).by_position;
    return std::accumulate(by_position.begin(), by_position.end(), 0.0);
  };
  const auto dual = value("uniformity_dual"), annulus = value("uniformity_annulus");
  if (!dual) return dual.failure();
  return *c.objective.annulus_matches_dual * *dual / *annulus;
}

/// The terms of the weighted sum with weights > 0.
template <int dim>
Expected<WeightedSum<dim>> objective_terms(const Case& c, const StateSolver<dim>& solver) {
  Objective weights = c.objective;
  if (c.objective.annulus_matches_dual) {
    const auto weight = matching_weight(c, solver);
    if (!weight) return weight.failure();
    weights.uniformity_annulus = *weight;
  }
  WeightedSum<dim> terms;
  for (const auto& [quantity, weight] : objective_weights) {
    if (!(weights.*weight > 0)) continue;
    auto term = functional_of(built_in(quantity), Over::positions, quantity_context(c, solver));
    if (!term) return term.failure();
    term->weight = weights.*weight;
    terms.push_back(*std::move(term));
  }
  WeightedSum<dim> of_shape;  // the same under every load
  for (const ObjectiveTerm& further : c.objective.terms) {
    if (!(further.weight > 0)) continue;
    const Quantity quantity = quantity_of(c, further);
    auto term = functional_of(quantity, quantity->usual, quantity_context(c, solver));
    if (!term) return term.failure();
    term->weight *= further.weight;
    (quantity->of == Positions::none ? of_shape : terms).push_back(*std::move(term));
  }
  terms = in_load_cases(c, std::move(terms));
  terms.insert(terms.end(), of_shape.begin(), of_shape.end());
  return terms;
}

}  // namespace

template <int dim>
Expected<std::shared_ptr<const StateSolver<dim>>> make_solver(const RollingModel<dim>& model) {
  if constexpr (dim == 3)
    if (HalfWidthSolver::can_halve(model)) {
      auto solver = HalfWidthSolver::create(model);
      if (!solver) return solver.failure();
      return std::shared_ptr<const StateSolver<dim>>(*std::move(solver));
    }
  if constexpr (dim == 2)
    if (!model.materials.are_linear()) {
      auto problem = LargeDeformationProblem<dim>::create(model);
      if (!problem) return problem.failure();
      return std::shared_ptr<const StateSolver<dim>>(
          std::make_shared<const LargeDeformationProblem<dim>>(*std::move(problem)));
    }
  auto problem = RollingProblem<dim>::create(model);
  if (!problem) return problem.failure();
  return std::shared_ptr<const StateSolver<dim>>(
      std::make_shared<const RollingProblem<dim>>(*std::move(problem)));
}

template <int dim>
Expected<std::vector<ShapeFunction<dim>>> shape_functions(const Case& c, const StateSolver<dim>& solver) {
  auto terms = objective_terms<dim>(c, solver);
  if (!terms) return terms.failure();
  std::vector<ShapeFunction<dim>> functions;
  if (!minimizes_weighted_sum(c)) {
    terms = minimized_terms(c, solver);
    if (!terms) return terms.failure();
  }
  functions.push_back(objective(*std::move(terms)));
  functions.back().quantity = minimized_quantity(c);
  functions.back().over = minimized_over(c);
  auto volume = functional_of(material_volume(), Over::mean, quantity_context(c, solver));
  if (!volume) return volume.failure();
  functions.push_back({.name = "volume", .terms = {*std::move(volume)}, .quantity = material_volume()});
  auto bounded = bounded_functions(c, solver, initial_shape<dim>(c));
  if (!bounded) return bounded.failure();
  functions.insert(functions.end(), bounded->begin(), bounded->end());
  return functions;
}

template <int dim>
const ShapeFunction<dim>& Study<dim>::function(std::string_view name) const {
  return *std::ranges::find(functions, name, &ShapeFunction<dim>::name);
}

template <int dim>
const ShapeFunction<dim>& Study<dim>::objective() const {
  return function(optimizer.objective);
}

namespace {

/// The shape of another run from which a case starts, on its own grid; null if the case draws its own.
const SavedLevelSet* saved_shape(const Case& c) { return c.saved_shape.shape.contents.get(); }

/// The result of `on_lattice(shape, lattice)` for a saved shape; 2D shapes are extruded.
template <int dim, class OnLattice>
LevelSet<dim> saved_on(const Lattice<dim>& lattice, const SavedLevelSet& saved, OnLattice on_lattice) {
  if constexpr (dim == 3)
    if (const auto* plane = std::get_if<LevelSet<2>>(&saved))
      return extruded(on_lattice(*plane, section_lattice(lattice)), lattice);
  return on_lattice(std::get<LevelSet<dim>>(saved), lattice);
}

/// A saved shape at the nodes of another lattice.
template <int dim>
LevelSet<dim> moved_to(const Lattice<dim>& lattice, const SavedLevelSet& saved) {
  return saved_on(lattice, saved, [](const auto& shape, const auto& nodes) { return regrid(shape, nodes); });
}

/// The volume of a saved shape as a fraction of its ring.
double volume_fraction_of(const SavedLevelSet& saved) {
  return std::visit(
      [](const auto& shape) { return volume_fraction(shape.lattice.grid(), material_measure(shape)); },
      saved);
}

/// The shape drawn by a case, at the nodes of a lattice.
template <int dim>
LevelSet<dim> drawn_on(const Lattice<dim>& lattice, const Case& c) {
  LevelSet<dim> psi = c.shapes == Shapes{} ? make_level_set(lattice, sector_holes(c))
                                           : make_level_set(lattice, Composition(figures(c)));
  if constexpr (dim == 3) {
    for (const Sphere& hole : sector_spheres(c)) psi = with_hole(std::move(psi), hole);
    for (const TaperedHole& hole : sector_tapered_holes(c)) psi = with_hole(std::move(psi), hole);
    for (const Groove& groove : grooves(c)) psi = with_hole(std::move(psi), groove);
  }
  return psi;
}

/// The drawn or saved shape at the nodes of the case's lattice, as it is.
template <int dim>
LevelSet<dim> given_shape(const Case& c) {
  const Lattice<dim> lattice(polar_grid<dim>(c), level_set_degree(c));
  const SavedLevelSet* saved = saved_shape(c);
  return saved ? moved_to(lattice, *saved) : drawn_on(lattice, c);
}

}  // namespace

template <int dim>
LevelSet<dim> shape_before_fitting(const Case& c) {
  LevelSet<dim> given = given_shape<dim>(c);
  const ProtectedBands<dim> limits(given.lattice, bands(c));
  return limits.clip(std::move(given));
}

template <int dim>
LevelSet<dim> initial_shape(const Case& c) {
  LevelSet<dim> given = given_shape<dim>(c);
  const ProtectedBands<dim> limits(given.lattice, bands(c));
  return limits.keep(invariant_part(std::move(given), invariance(c)));
}

template <int dim>
std::optional<VolumeChange> volume_change_of_saved_shape(const Case& c) {
  const SavedLevelSet* saved = saved_shape(c);
  if (!saved) return {};
  const LevelSet<dim> here = initial_shape<dim>(c);
  return VolumeChange{volume_fraction_of(*saved),
                      volume_fraction(here.lattice.grid(), material_measure(here))};
}

std::string text(const VolumeChange& change) {
  return fmt::format(
      "volume of the saved shape: {:.6g} % of the ring on its grid, {:.6g} % on this grid ({:+.2g} %)",
      100 * change.there, 100 * change.here, 100 * (change.here / change.there - 1));
}

template <int dim>
std::vector<ShapeEvent<dim>> lost_on_the_grid(const Case& c) {
  const Lattice<dim> samples(divided(polar_grid<dim>(c), component_samples), 1);
  const auto sampled = [](const auto& shape, const auto& nodes) { return values_on(shape, nodes); };
  const SavedLevelSet* saved = saved_shape(c);
  auto given =
      invariant_part(saved ? saved_on(samples, *saved, sampled) : drawn_on(samples, c), invariance(c));
  // What layers without holes take of them is not lost on the grid.
  const Bands kept{.rim = {}, .tread = {}, .between = solid_layers(c), .mould = mould(c), .print = print(c)};
  if (!kept.between.empty() || kept.mould || kept.print)
    given = ProtectedBands<dim>(samples, kept).keep(std::move(given));
  return topology_changes(components(given, 1), components(initial_shape<dim>(c)));
}

EvolutionOptions evolution_options(const Case& c) {
  EvolutionOptions options;
  const VelocityKind kind = velocity_kind(c);
  options.velocity = {.kind = kind == VelocityKind::harmonic ? ExtensionKind::harmonic : ExtensionKind::h1,
                      .length = velocity_length(c)};
  options.deformation =
      kind == VelocityKind::vector ? DeformationKind::vector_field : DeformationKind::normal_speed;
  options.smoothing = c.optimizer.smoothing;
  options.bands = bands(c);
  options.invariance = invariance(c);
  options.features = {
      .wall = c.optimizer.minimum_wall.value_or(0),
      .gap = std::max(c.optimizer.minimum_gap.value_or(0), 2 * c.optimizer.minimum_radius.value_or(0)),
      .radius = c.optimizer.minimum_radius.value_or(0)};
  return options;
}

/// The widths at the end, unless the case gives them for all shapes: walls of a cell plus a margin, gaps of
/// one and a half cells, and internal corners with a radius of a cell, or of three quarters where the shape
/// has no room for them. A given gap limits the radius to half of it. For level sets of degree 1, no radius
/// and gaps of about a cell.
template <int dim>
void set_final_widths(OptimizerOptions& options, const Case& c) {
  constexpr double wall = 1.05, round_gap = 1.5, gap_of_degree_1 = 1.12, radius = 1, sharper = 0.75;
  const Optimizer& o = c.optimizer;
  const bool is_round = level_set_degree(c) > 1, has_radius = is_round && !o.minimum_radius;
  const double cell = polar_grid<dim>(c).resolution(),
               largest = 0.5 * o.minimum_gap.value_or(2 * radius * cell);
  options.final_widths = {.wall = o.minimum_wall ? 0 : wall * cell,
                          .gap = o.minimum_gap ? 0 : (is_round ? round_gap : gap_of_degree_1) * cell,
                          .radius = has_radius ? std::min(radius * cell, largest) : 0};
  options.sharper_radius = has_radius ? std::min(sharper * cell, largest) : 0;
}

template <int dim>
OptimizerOptions optimizer_options(const Case& c) {
  OptimizerOptions options;
  options.iterations = c.optimizer.iterations;
  const bool descends = optimizer_method(c) == OptimizerMethod::descent;
  options.method = descends ? Method::descent : Method::sequential_quadratic;
  options.step = c.optimizer.step.value_or(descends ? 0.5 : 1.25);
  options.max_halvings = c.optimizer.max_halvings;
  options.accepted_increase = c.optimizer.accepted_increase;
  options.tolerance = convergence_tolerance(c);
  options.redistance_every = c.optimizer.redistance_every;
  options.smooth_every = c.optimizer.smoothing > 0 ? c.optimizer.smooth_every : 0;
  options.measure_control = c.volume.control == VolumeControl::paper ? MeasureControl::proportional
                            : holds_volume(c)                        ? MeasureControl::exact
                                                                     : MeasureControl::free;
  options.measure_rate = c.volume.rate;
  if (!descends) set_final_widths<dim>(options, c);
  const std::vector<int> lines = design_lines(c);
  const std::vector<DesignRadius> radii = design_radii(c);
  for (std::size_t k = 0; k < lines.size(); ++k)
    options.design_lines.push_back({lines[k], radii[k].least, radii[k].most});
  if (c.volume.target) options.target_measure = *c.volume.target * sector_measure<dim>(polar_grid<dim>(c));
  return options;
}

template <int dim>
double volume_fraction(const PolarGrid<dim>& grid, double measure) {
  return measure / sector_measure<dim>(grid);
}

template <int dim>
std::string load_text(const RollingModel<dim>& model) {
  return model.travel ? fmt::format("rim travel {:.6g} mm", *model.travel * 1e3)
                      : shown_text(model.load, shown_unit(UnitKind::force, dim, model.grid.width));
}

template <int dim>
std::optional<int> level_of(const Case& c, const LevelSet<dim>& shape) {
  for (int level = 0; level <= c.optimizer.coarse_levels; ++level) {
    const Case computed = on_coarser_grid(c, level);
    const auto moved = with_radii_of(c, shape.lattice.grid(), level);
    if (moved && shape.lattice.grid() == polar_grid<dim>(on_coarser_grid(*moved, level)) &&
        shape.lattice.degree() == level_set_degree(computed))
      return level;
  }
  return {};
}

template <int dim>
Expected<Study<dim>> make_study(const Case& source, int level) {
  const Case c = on_coarser_grid(source, level);
  auto solver = make_solver(rolling_model<dim>(c));
  if (!solver) return solver.failure();
  auto cases = load_cases<dim>(c);
  auto functions = shape_functions<dim>(c, **solver);
  if (!functions) return functions.failure();
  EvolutionOptions evolution = evolution_options(c);
  evolution.cut_points = (*solver)->model().points_in_cut_cells();
  OptimizerOptions optimizer = optimizer_options<dim>(c);
  if (level > 0) {  // the case's own grid has its own cells
    optimizer.final_widths = {};
    optimizer.sharper_radius = 0;
  }
  return Study<dim>{.source = source,
                    .level = level,
                    .solver = *std::move(solver),
                    .load_cases = std::move(cases),
                    .functions = *std::move(functions),
                    .initial = initial_shape<dim>(c),
                    .evolution = evolution,
                    .optimizer = optimizer};
}

template <int dim>
typename ShapeOptimizer<dim>::Evaluate evaluate_of(const Study<dim>& study, Interrupt interrupt) {
  const bool holds_mean = study.source.objective.mean == MeanStress::held;
  return [solver = study.solver, cases = study.load_cases, functions = study.functions, holds_mean,
          interrupt = std::move(interrupt)](const CutShape<dim>& shape,
                                            const Evaluation<dim>* previous) -> Expected<Evaluated<dim>> {
    const Matrix* held_mean = holds_mean && previous ? &previous->mean_observations : nullptr;
    auto evaluated = evaluate<dim>(*solver, functions, shape, held_mean, interrupt, cases,
                                   previous ? previous->starts : StartDisplacements());
    if (!evaluated) return evaluated;
    if (auto failure = material_overlaps(*solver, shape.psi, *evaluated->state)) return *failure;
    for (const auto& other : evaluated->others)
      if (auto failure = material_overlaps(*solver, shape.psi, *other)) return *failure;
    return evaluated;
  };
}

template <int dim>
ShapeOptimizer<dim> optimizer_of(const Study<dim>& study, Interrupt interrupt) {
  return optimizer_of(study, moved_studies(study), interrupt);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                        \
  template RollingModel<dim> rolling_model(const Case&);                                                    \
  template LoadCases<dim> load_cases<dim>(const Case&);                                                     \
  template LevelSet<dim> initial_shape(const Case&);                                                        \
  template std::optional<VolumeChange> volume_change_of_saved_shape<dim>(const Case&);                      \
  template LevelSet<dim> shape_before_fitting<dim>(const Case&);                                            \
  template OptimizerOptions optimizer_options<dim>(const Case&);                                            \
  template Expected<std::shared_ptr<const StateSolver<dim>>> make_solver(const RollingModel<dim>&);         \
  template Expected<std::vector<ShapeFunction<dim>>> shape_functions(const Case&, const StateSolver<dim>&); \
  template struct Study<dim>;                                                                               \
  template std::vector<ShapeEvent<dim>> lost_on_the_grid(const Case&);                                      \
  template double volume_fraction(const PolarGrid<dim>&, double);                                           \
  template std::string load_text(const RollingModel<dim>&);                                                 \
  template std::optional<int> level_of(const Case&, const LevelSet<dim>&);                                  \
  template Expected<Study<dim>> make_study(const Case&, int);                                               \
  template ShapeOptimizer<dim>::Evaluate evaluate_of(const Study<dim>&, Interrupt);                         \
  template ShapeOptimizer<dim> optimizer_of(const Study<dim>&, Interrupt);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
