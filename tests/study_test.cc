#include "wheelwright/run/study/study.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "wheelwright/case/read.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

constexpr double tiny = 1e-14;

/// A case in which no two values are equal, none is a default, and nothing is symmetric.
Case uneven_case() {
  Case c;
  c.wheel = {.inner_radius = 0.21, .outer_radius = 0.37, .width = 0.125, .sectors = 12};
  c.material = {{3e6, 0.31, Plane::stress}, {}};
  c.load = {.force = 1000,
            .travel = {},
            .horizontal_force = 70,
            .torque = 11,
            .body_force = {130, -170},
            .hole_pressure = 1900,
            .positions = 5};
  c.contact = {.method = ContactMethod::nitsche,
               .theta = 0.5,
               .gamma_0 = 230,
               .friction = 0.29,
               .quadrature_points = 4};
  c.holes.circles = {{{0.28, 0.03}, 0.031}};
  c.grid = {
      .radial_cells = 16, .angular_cells = 12 * 13, .degree = 1, .level_set_degree = 2, .tread_levels = 3};
  c.ghost_penalty.xi = 0.37;
  c.objective.strain_energy = 41;
  c.volume.target = 0.43;
  c.volume.rate = 0.0071;
  c.optimizer = {.method = OptimizerMethod::descent,
                 .iterations = 47,
                 .velocity = VelocityKind::harmonic,
                 .velocity_length = 2.3,
                 .step = 0.53,
                 .max_halvings = 5,
                 .accepted_increase = 0.0059,
                 .tolerance = 0.0061,
                 .redistance_every = 7,
                 .smoothing = 0.067,
                 .smooth_every = 9,
                 .rim_band = 0.0123,
                 .tread_band = 0.0345,
                 .minimum_wall = 0.0111,
                 .minimum_gap = 0.0222,
                 .minimum_radius = 0.0101};
  return c;
}

template <int dim>
void expect_common_keys(const RollingModel<dim>& model, const Case& c) {
  EXPECT_EQ(model.grid.inner_radius, 0.21);
  EXPECT_EQ(model.grid.outer_radius, 0.37);
  EXPECT_EQ(model.grid.width, 0.125);
  EXPECT_EQ(model.grid.n_sectors, 12);
  EXPECT_EQ(model.grid.cells[0], 16);
  EXPECT_EQ(model.grid.cells[1], 13);
  EXPECT_EQ(model.degree, 1);
  EXPECT_EQ(model.materials.at_tread().isotropic()->youngs_modulus, 3e6);
  EXPECT_EQ(model.materials.at_tread().isotropic()->poissons_ratio, 0.31);
  EXPECT_EQ(model.materials.at_tread().isotropic()->plane, Plane::stress);
  EXPECT_EQ(model.ghost.kind, c.ghost_penalty.kind);
  EXPECT_EQ(model.ghost.xi, 0.37);
  EXPECT_EQ(model.contact.method, ContactMethod::nitsche);
  EXPECT_EQ(model.contact.theta_nitsche, 0.5);
  EXPECT_EQ(model.contact.gamma_0, 230);
  EXPECT_EQ(model.contact.friction, 0.29);
  EXPECT_EQ(model.contact_points, 4);
  EXPECT_EQ(model.tread.rows, 1);
  EXPECT_EQ(model.tread.levels, 3);
  EXPECT_EQ(model.tread.annulus_points, 0);
  EXPECT_FALSE(model.travel);
  // Along the ground and down in the case; component 0 towards the ground in the model. No force along the
  // axle.
  EXPECT_EQ(model.distributed.body_force[0], -170);
  EXPECT_EQ(model.distributed.body_force[1], 130);
  if constexpr (dim == 3) {
    EXPECT_EQ(model.distributed.body_force[2], 0);
  }
  EXPECT_EQ(model.distributed.hole_pressure, 1900);
  EXPECT_EQ(model.n_positions, 5);
  EXPECT_FALSE(model.cut_points);
}

TEST(ModelOfACase, In2DIsPerMetreOfWidth) {
  const Case c = uneven_case();
  const RollingModel<2> model = rolling_model<2>(c);
  expect_common_keys<2>(model, c);
  EXPECT_NEAR(model.load, 1000 / 0.125, tiny * model.load);
  EXPECT_NEAR(model.horizontal_force, 70 / 0.125, tiny * 70 / 0.125);
  EXPECT_NEAR(model.torque, 11 / 0.125, tiny * 11 / 0.125);
}

TEST(ModelOfACase, In3DIsTheWholeWidth) {
  const Case c = uneven_case();
  const RollingModel<3> model = rolling_model<3>(c);
  expect_common_keys<3>(model, c);
  EXPECT_EQ(model.load, 1000);
  EXPECT_EQ(model.horizontal_force, 70);
  EXPECT_EQ(model.torque, 11);
  EXPECT_GE(model.grid.cells[2], 1);
}

TEST(ModelOfACase, PrescribesAGivenTravel) {
  Case c = uneven_case();
  c.load.travel = 0.0019;
  EXPECT_EQ(rolling_model<2>(c).travel, 0.0019);
}

TEST(ModelOfACase, CondensesTheAnnulusOfItsFunctional) {
  Case c = uneven_case();
  c.objective.uniformity_annulus = 1;
  c.objective.annulus = 3 * (0.37 - 0.21) / 16;
  const RollingModel<2> model = rolling_model<2>(c);
  EXPECT_EQ(model.tread.rows, 3);
  EXPECT_EQ(model.tread.annulus_points, c.grid.degree + 1);
}

TEST(LoopOfACase, HasItsOptions) {
  Case c = uneven_case();
  const OptimizerOptions options = optimizer_options<2>(c);
  EXPECT_EQ(options.iterations, 47);
  EXPECT_EQ(options.method, Method::descent);
  EXPECT_EQ(options.step, 0.53);
  EXPECT_EQ(options.max_halvings, 5);
  EXPECT_EQ(options.accepted_increase, 0.0059);
  EXPECT_EQ(options.tolerance, 0.0061);
  EXPECT_EQ(options.redistance_every, 7);
  EXPECT_EQ(options.smooth_every, 9);
  EXPECT_EQ(options.measure_control, MeasureControl::exact);
  const double ring = std::numbers::pi * (0.37 * 0.37 - 0.21 * 0.21);
  EXPECT_NEAR(*options.target_measure, 0.43 * ring / 12, tiny);
  EXPECT_EQ(options.measure_rate, 0.0071);
  EXPECT_NEAR(*optimizer_options<3>(c).target_measure, 0.43 * ring / 12 * 0.125, tiny);
  const EvolutionOptions evolution = evolution_options(c);
  EXPECT_EQ(evolution.velocity.kind, ExtensionKind::harmonic);
  EXPECT_EQ(evolution.velocity.length, 2.3);
  EXPECT_EQ(evolution.smoothing, 0.067);
  EXPECT_EQ(evolution.bands.rim.thickness, 0.0123);
  EXPECT_EQ(evolution.bands.tread.thickness, 0.0345);
  EXPECT_EQ(evolution.features.wall, 0.0111);
  EXPECT_EQ(evolution.features.gap, 0.0222);
  EXPECT_EQ(evolution.features.radius, 0.0101);

  c.optimizer.velocity = VelocityKind::h1;
  c.volume = {.control = VolumeControl::paper, .target = {}};
  c.optimizer.smoothing = 0;
  EXPECT_EQ(evolution_options(c).velocity.kind, ExtensionKind::h1);
  EXPECT_EQ(optimizer_options<2>(c).measure_control, MeasureControl::proportional);
  EXPECT_FALSE(optimizer_options<2>(c).target_measure);
  EXPECT_EQ(optimizer_options<2>(c).smooth_every, 0);
}

/// Vector fields by default for sequential quadratic steps for a sum without bounds in 2D, smoothed over less
/// where the ring has few cells; speeds along the normal otherwise.
TEST(LoopOfACase, TheVelocityFollowsFromMethodAndDimension) {
  const auto expect = [](const Case& c, DeformationKind kind, double length) {
    const EvolutionOptions options = evolution_options(c);
    EXPECT_EQ(options.deformation, kind);
    EXPECT_EQ(options.velocity.kind, ExtensionKind::h1);
    EXPECT_DOUBLE_EQ(options.velocity.length, length);
  };
  Case c = uneven_case();
  c.volume.control = VolumeControl::exact;
  c.optimizer = {};
  c.wheel.dimension = 2;
  c.grid.radial_cells = 28;
  expect(c, DeformationKind::vector_field, 8);
  c.grid.radial_cells = 12;
  expect(c, DeformationKind::vector_field, 3.6);
  c.optimizer.velocity = VelocityKind::h1;
  expect(c, DeformationKind::normal_speed, 2);
  c.optimizer = {};
  c.optimizer.method = OptimizerMethod::descent;
  expect(c, DeformationKind::normal_speed, 2);
  c.optimizer = {};
  c.constraints.resize(1);
  expect(c, DeformationKind::normal_speed, 2);
  c.constraints.clear();
  c.objective.minimize = built_in("mass");
  expect(c, DeformationKind::normal_speed, 2);
  c.objective.minimize = built_in("objective");
  c.wheel.dimension = 3;
  expect(c, DeformationKind::normal_speed, 2);
  c.optimizer.velocity = VelocityKind::vector;
  c.optimizer.velocity_length = 5;
  expect(c, DeformationKind::vector_field, 5);
}

/// The hole of the case lies where the case says, and psi is positive in it.
template <int dim>
void expect_the_hole(const LevelSet<dim>& psi) {
  EXPECT_EQ(psi.lattice.degree(), 2);
  const double sector = psi.lattice.grid().sector_angle();
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    const auto p = psi.lattice.polar_point(node);
    double distance = 1;
    for (int turn : {-1, 0, 1}) {
      const double azimuth = p[1] + turn * sector;
      distance =
          std::min(distance, std::hypot(p[0] * std::cos(azimuth) - 0.28, p[0] * std::sin(azimuth) - 0.03));
    }
    if (std::abs(distance - 0.031) > 1e-9) {
      EXPECT_EQ(psi.values[node] > 0, distance < 0.031) << p[0] << ' ' << p[1];
    }
  }
}

TEST(ShapeOfACase, HasItsHole) {
  expect_the_hole<2>(initial_shape<2>(uneven_case()));
  expect_the_hole<3>(initial_shape<3>(uneven_case()));
}

/// Without a phase the first hole lies in the middle of its share of the wheel: with as many holes as
/// sectors, in the middle of a sector.
TEST(ShapeOfACase, HasHolesAtHalfTheirSpacingByDefault) {
  Case c;
  c.wheel.dimension = 3;
  c.holes.rings = {{.count = c.wheel.sectors, .center_radius = 0.27, .radius = 0.01},
                   {.count = 2 * c.wheel.sectors, .center_radius = 0.3, .radius = 0.01, .phase = 0.0}};
  c.holes.spheres = {{.count = 2 * c.wheel.sectors, .center_radius = 0.24, .radius = 0.01}};
  const std::vector<Circle> circles = sector_holes(c);
  const std::vector<Sphere> spheres = sector_spheres(c);
  ASSERT_EQ(circles.size(), 3u);
  EXPECT_DOUBLE_EQ(circles[0].centre_azimuth, 0.5 * sector_angle(c));
  EXPECT_EQ(circles[1].centre_azimuth, 0);
  EXPECT_DOUBLE_EQ(circles[2].centre_azimuth, 0.5 * sector_angle(c));
  ASSERT_EQ(spheres.size(), 2u);
  EXPECT_DOUBLE_EQ(spheres[0].centre_azimuth, 0.25 * sector_angle(c));
  EXPECT_DOUBLE_EQ(spheres[1].centre_azimuth, 0.75 * sector_angle(c));
}

TEST(ObjectiveOfACase, IsTheWeightedSumOfItsFunctionals) {
  Case c = uneven_case();
  c.objective.strain_energy = 2;
  c.objective.uniformity_dual = 30;
  c.objective.uniformity_l2 = 5;
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  ASSERT_EQ(study->objective().terms.size(), 3u);
  const auto evaluated = evaluate_of(*study)(study->initial, nullptr);
  ASSERT_TRUE(evaluated) << evaluated.failure().detail;
  const Evaluation<2>& e = evaluated->evaluation;
  double sum = 0;
  for (const auto& value : e.terms)
    if (value.name != "volume")
      sum += value.value * (value.name == name(built_in("strain_energy"))     ? 2
                            : value.name == name(built_in("uniformity_dual")) ? 30
                                                                              : 5);
  EXPECT_NEAR(e.function("objective").value, sum, 1e-13 * sum);
  ASSERT_TRUE(evaluated->state);
  EXPECT_EQ(evaluated->state->positions().size(), 5);
}

// (83): on the initial shape the term of the annulus is the given multiple of the dual one, whatever their
// sizes.
TEST(ObjectiveOfACase, MatchesTheAnnulusWithTheDualTerm) {
  Case c = uneven_case();
  c.objective.strain_energy = 0;
  c.objective.uniformity_dual = 0.7;
  c.objective.annulus = 3 * (0.37 - 0.21) / 16;
  c.objective.annulus_matches_dual = 23;
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  const auto evaluated = evaluate_of(*study)(study->initial, nullptr);
  ASSERT_TRUE(evaluated) << evaluated.failure().detail;
  const Evaluation<2>& e = evaluated->evaluation;
  const auto dual = std::ranges::find(e.terms, name(built_in("uniformity_dual")), &TermValue::name);
  ASSERT_NE(dual, e.terms.end());
  ASSERT_GT(dual->value, 0);
  EXPECT_NEAR(e.function("objective").value, (0.7 + 23) * dual->value, 1e-10 * dual->value);
}

// With a held mean the objective depends only on the previous shape's mean, and on nothing that was
// evaluated before.
TEST(ObjectiveOfACase, ComparesWithThePreviousMeanIfHeld) {
  Case c = uneven_case();
  c.objective.strain_energy = 0;
  c.objective.uniformity_dual = 1;
  c.objective.mean = MeanStress::held;
  const auto study = make_study<2>(c);
  ASSERT_TRUE(study);
  LevelSet<2> other = study->initial;
  for (double& value : other.values) value -= 0.004;
  const auto held = evaluate_of(*study);
  const auto first = held(study->initial, nullptr);
  ASSERT_TRUE(first) << first.failure().detail;
  const auto own = held(other, nullptr), compared = held(other, &first->evaluation);
  ASSERT_TRUE(own && compared);
  EXPECT_EQ(held(other, nullptr)->evaluation.function("objective").value,
            own->evaluation.function("objective").value);
  // The own mean is the best one in the norm of the functional.
  EXPECT_GT(compared->evaluation.function("objective").value, own->evaluation.function("objective").value);
  const auto direct =
      evaluate<2>(*study->solver, study->functions, other, &first->evaluation.mean_observations);
  EXPECT_EQ(compared->evaluation.function("objective").value, direct->evaluation.function("objective").value);
  c.objective.mean = MeanStress::exact;
  EXPECT_EQ(evaluate_of(*make_study<2>(c))(other, &first->evaluation)->evaluation.function("objective").value,
            own->evaluation.function("objective").value);
}

TEST(ObjectiveOfACase, EndsEarlyWhenItIsInterrupted) {
  const auto study = make_study<2>(uneven_case());
  ASSERT_TRUE(study);
  const auto evaluated = evaluate_of(*study, Interrupt([] { return true; }))(study->initial, nullptr);
  ASSERT_FALSE(evaluated);
  EXPECT_EQ(evaluated.failure().reason, FailureReason::interrupted);
}

/// The place where an interrupt ends an evaluation, for each poll that can be the first that asks.
template <int dim>
std::vector<std::string> ends_of(const Study<dim>& study) {
  std::vector<std::string> ends;
  for (int first = 0;; ++first) {
    int polls = 0;
    const Interrupt from_then_on([&] { return polls++ >= first; });
    const auto evaluated = evaluate_of(study, from_then_on)(study.initial, nullptr);
    if (evaluated) return ends;
    EXPECT_EQ(evaluated.failure().reason, FailureReason::interrupted);
    const bool is_between_phases = evaluated.failure().detail.starts_with("before");
    EXPECT_TRUE(polls == first + 1 || !is_between_phases) << evaluated.failure().detail;
    if (ends.empty() || ends.back() != evaluated.failure().detail) ends.push_back(evaluated.failure().detail);
  }
}

/// So a stop takes at most one phase.
TEST(ObjectiveOfACase, CanBeInterruptedBeforeEveryPhase) {
  const std::vector<std::string> before_phases{"before the phase assembly", "before the phase factorization",
                                               "before the phase contact",  "while the contact was solved",
                                               "before the phase recovery", "before the phase adjoint"};
  const Case c = uneven_case();
  EXPECT_EQ(ends_of(*make_study<2>(c)), before_phases);
}

TEST(VolumeFraction, IsOneForTheWholeSector) {
  const auto plane = polar_grid<2>(uneven_case());
  const auto solid = polar_grid<3>(uneven_case());
  EXPECT_NEAR(volume_fraction(plane, sector_measure<2>(plane)), 1, tiny);
  EXPECT_NEAR(volume_fraction(solid, sector_measure<3>(solid)), 1, tiny);
}

TEST(Units, OfA2DModelArePerMetreOfWidth) {
  EXPECT_STREQ(unit<2>(UnitKind::energy), "J/m");
  EXPECT_STREQ(unit<3>(UnitKind::energy), "J");
  EXPECT_STREQ(unit<2>(UnitKind::force), "N/m");
  EXPECT_STREQ(unit<3>(UnitKind::force), "N");
}

}  // namespace
}  // namespace wheelwright
