#include "wheelwright/run/model.h"

#include "wheelwright/case/derived.h"
#include "wheelwright/functionals/mean_contact_stress.h"
#include "wheelwright/functionals/strain_energy.h"
#include "wheelwright/functionals/uniformity_annulus.h"
#include "wheelwright/functionals/uniformity_dual.h"
#include "wheelwright/functionals/uniformity_l2.h"

namespace wheelwright {
namespace {

double sector_area(const PolarGrid<2>& grid) {
  return 0.5 * grid.sector_angle() *
         (grid.outer_radius * grid.outer_radius - grid.inner_radius * grid.inner_radius);
}

}  // namespace

PolarGrid<2> polar_grid(const Case& c) {
  return {c.wheel.inner_radius,
          c.wheel.outer_radius,
          c.wheel.width,
          c.wheel.sectors,
          {c.grid.radial_cells, c.grid.angular_cells / c.wheel.sectors}};
}

RollingModel<2> rolling_model(const Case& c) {
  RollingModel<2> model;
  model.grid = polar_grid(c);
  model.degree = c.grid.degree;
  model.material = c.material;
  model.ghost = c.ghost_penalty;
  model.contact = {.method = c.contact.method,
                   .theta_nitsche = c.contact.theta,
                   .gamma_0 = c.contact.gamma_0,
                   .friction = c.contact.friction};
  model.contact_points = c.contact.quadrature_points;
  model.tread = {tread_rows(c), c.grid.tread_levels, wants_annulus(c) ? c.grid.degree + 1 : 0};
  model.load = load_per_metre(c);
  model.horizontal_force = c.load.horizontal_force / c.wheel.width;
  model.torque = c.load.torque / c.wheel.width;
  model.travel = c.load.travel;
  model.distributed = {{c.load.body_force[1], c.load.body_force[0]}, c.load.hole_pressure};
  model.n_positions = c.load.positions;
  return model;
}

namespace {

/// alpha_1 from alpha_2 by (83), on the initial shape.
Expected<double> matching_weight(const Case& c, const RollingProblem<2>& problem, const Criterion<2>& annulus,
                                 const Criterion<2>& dual) {
  const auto solution = problem.solve(initial_shape(c));
  if (!solution) return solution.failure();
  const Matrix mean = mean_observations(problem, *solution);
  return *c.objective.annulus_matches_dual *
         dual.evaluate(problem, *solution, mean).value(solution->positions) /
         annulus.evaluate(problem, *solution, mean).value(solution->positions);
}

}  // namespace

Expected<Criteria<2>> criteria(const Case& c, const RollingProblem<2>& problem) {
  const Objective& o = c.objective;
  Criteria<2> result;
  const auto add = [&](double weight, std::shared_ptr<const Criterion<2>> criterion) {
    if (weight > 0) result.push_back({weight, std::move(criterion)});
  };
  std::shared_ptr<const Criterion<2>> dual;
  if (o.uniformity_dual > 0 || o.annulus_matches_dual) {
    auto image = NeumannToDirichlet<2>::create(problem.model());
    if (!image) return image.failure();
    dual =
        std::make_shared<UniformityDual<2>>(std::make_shared<const NeumannToDirichlet<2>>(*std::move(image)));
  }
  const auto annulus = std::make_shared<UniformityAnnulus<2>>(characteristic_length(c));
  double annulus_weight = o.uniformity_annulus;
  if (o.annulus_matches_dual) {
    const auto weight = matching_weight(c, problem, *annulus, *dual);
    if (!weight) return weight.failure();
    annulus_weight = *weight;
  }
  add(o.strain_energy, std::make_shared<StrainEnergy<2>>());
  add(annulus_weight, annulus);
  add(o.uniformity_dual, dual);
  add(o.uniformity_l2, std::make_shared<UniformityL2<2>>(characteristic_length(c)));
  return result;
}

LevelSet<2> initial_shape(const Case& c) {
  return make_level_set(Lattice<2>(polar_grid(c), c.grid.level_set_degree), sector_holes(c));
}

std::vector<ShapeEvent<2>> lost_on_the_grid(const Case& c) {
  PolarGrid<2> fine = polar_grid(c);
  for (int& cells : fine.cells) cells *= component_samples;
  const auto given = make_level_set(Lattice<2>(fine, 1), sector_holes(c));
  return topology_changes(components(given, 1), components(initial_shape(c)));
}

EvolutionOptions evolution_options(const Case& c) {
  EvolutionOptions options;
  options.velocity.kind =
      c.optimizer.velocity == VelocityKind::h1 ? ExtensionKind::h1 : ExtensionKind::harmonic;
  options.velocity.length = c.optimizer.velocity_length;
  options.smoothing = c.optimizer.smoothing;
  options.rim_band = rim_band(c);
  options.tread_band = tread_band(c);
  return options;
}

OptimizerOptions optimizer_options(const Case& c) {
  OptimizerOptions options;
  options.iterations = c.optimizer.iterations;
  options.step = c.optimizer.step;
  options.max_halvings = c.optimizer.max_halvings;
  options.accepted_increase = c.optimizer.accepted_increase;
  options.tolerance = c.optimizer.tolerance;
  options.redistance_every = c.optimizer.redistance_every;
  options.smooth_every = c.optimizer.smoothing > 0 ? c.optimizer.smooth_every : 0;
  options.measure_control =
      c.volume.control == VolumeControl::exact ? MeasureControl::exact : MeasureControl::proportional;
  if (c.volume.target) options.target_measure = *c.volume.target * sector_area(polar_grid(c));
  return options;
}

double volume_fraction(const PolarGrid<2>& grid, double measure) { return measure / sector_area(grid); }

}  // namespace wheelwright
