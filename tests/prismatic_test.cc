#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/quantities/analysis/position_deformation.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/shape/geometry/shapes.h"

// A wheel whose shape does not change along the axle, in 3D, against the same wheel in 2D.

namespace wheelwright::testing {
namespace {

constexpr double width = 0.12, pi = std::numbers::pi;

RollingModel<2> plane_model(double poissons_ratio) {
  RollingModel<2> model;
  model.grid = {0.20, 0.34, width, 12, {7, 7}};
  model.materials = Material{200e6, poissons_ratio};
  model.load = 2943 / width;
  model.n_positions = 3;
  model.contact_points = 3;
  model.cut_points = 8;  // 2D and 3D integrate cut cells in other ways: both exactly
  return model;
}

RollingModel<3> with_width(const RollingModel<2>& plane, int axial_cells, SideFaces sides) {
  RollingModel<3> model;
  const PolarGrid<2>& grid = plane.grid;
  model.grid = {grid.inner_radius,
                grid.outer_radius,
                grid.width,
                grid.n_sectors,
                {grid.cells[0], grid.cells[1], axial_cells}};
  model.degree = plane.degree;
  model.cut_points = plane.cut_points;
  model.dilatation = plane.dilatation;
  model.materials = *plane.materials.at_tread().isotropic();
  model.ghost = plane.ghost;
  model.side_faces = sides;
  model.contact = plane.contact;
  model.contact_points = plane.contact_points;
  model.tread = plane.tread;
  model.load = plane.load * grid.width;
  model.horizontal_force = plane.horizontal_force * grid.width;
  model.torque = plane.torque * grid.width;
  model.distributed.body_force = {plane.distributed.body_force[0], plane.distributed.body_force[1], 0};
  model.distributed.hole_pressure = plane.distributed.hole_pressure;
  model.n_positions = plane.n_positions;
  return model;
}

template <int dim>
LevelSet<dim> shape(const PolarGrid<dim>& grid, int degree, double radius) {
  const Circle hole{0.2581, 0.47 * grid.sector_angle(), radius};
  return make_level_set<dim>(Lattice<dim>(grid, degree), std::span(&hole, radius > 0 ? 1 : 0));
}

/// What is compared: of one metre of width.
struct Results {
  std::vector<double> energy, travel, peak_pressure, friction, wind_up, neglected, derivative;
};

template <int dim>
Results results(const RollingModel<dim>& model, const WeightedSum<dim>& terms, int level_set_degree,
                double hole) {
  Results found;
  const auto problem = RollingProblem<dim>::create(model);
  if (!problem) throw std::runtime_error(problem.failure().detail);
  const LevelSet<dim> psi = shape<dim>(model.grid, level_set_degree, hole);
  const ShapeFunction<dim> function = objective(terms);
  const auto evaluated = evaluate<dim>(*problem, std::span(&function, 1), psi, nullptr);
  if (!evaluated) throw std::runtime_error(evaluated.failure().detail);
  const double per_metre = dim == 3 ? 1 / model.grid.width : 1;
  for (const double e : evaluated->state->strain_energy()) found.energy.push_back(e * per_metre);
  found.energy.push_back(evaluated->evaluation.function("objective").value * per_metre);
  for (const auto& contact : evaluated->state->contacts()) {
    const ContactSummary seen = contact_summary(contact);
    found.travel.push_back(seen.travel);
    found.peak_pressure.push_back(seen.peak_pressure);
    found.friction.push_back(seen.friction_force * per_metre);
    found.wind_up.push_back(seen.wind_up);
  }
  // The trace of a projected strain is shared by the axes of the plane, or by all.
  const bool has_own_strain = !problem->elements().element(0).projects_dilatation();
  if (has_own_strain)
    for (const auto& position : position_deformations<dim>(*problem, *evaluated->state)) {
      found.neglected.push_back(position.neglected.of_rotation);
      found.neglected.push_back(position.neglected.of_strain);
      found.neglected.push_back(position.neglected.of_bending);
    }
  // The derivative in three directions: the gradient as it is used.
  const auto gradient = evaluated->evaluation.gradient("objective");
  for (int k = 0; k < 3; ++k) {
    double derivative = 0;
    for (const auto& sample : gradient) {
      const auto cell = model.grid.cell_position(sample.cell);
      const double radial = cell[0] + sample.xi[0], azimuthal = cell[1] + sample.xi[1];
      derivative += sample.weight * sample.value * std::cos(k * (radial + 1.3 * azimuthal));
    }
    found.derivative.push_back(derivative * per_metre);
  }
  return found;
}

void expect_equal(const Results& a, const Results& b, double tolerance) {
  EXPECT_LT(relative_difference(a.energy, b.energy), tolerance);
  EXPECT_LT(relative_difference(a.travel, b.travel), tolerance);
  EXPECT_EQ(a.neglected.empty(), b.neglected.empty());
  if (!b.neglected.empty()) {
    EXPECT_LT(relative_difference(a.neglected, b.neglected), 10 * tolerance);
  }
  EXPECT_LT(relative_difference(a.peak_pressure, b.peak_pressure), 10 * tolerance);
  if (norm<1>({b.friction[0]}) > 0) {
    EXPECT_LT(relative_difference(a.friction, b.friction), 10 * tolerance);
  }
  if (b.wind_up[0] != 0) {
    EXPECT_LT(relative_difference(a.wind_up, b.wind_up), 10 * tolerance);
  }
  if (b.derivative[0] != 0) {
    EXPECT_LT(relative_difference(a.derivative, b.derivative), tolerance);
  }
}

template <int dim>
WeightedSum<dim> energy() {
  return {{1, std::make_shared<StrainEnergy<dim>>()}};
}

TEST(Prismatic, WithSymmetricSideFacesAndNoHolesIsThePlaneWheel) {
  for (const int axial_cells : {1, 2})
    for (const double nu : {0.3, 0.48}) {
      SCOPED_TRACE(::testing::Message() << axial_cells << " cells, nu " << nu);
      const auto plane = plane_model(nu);
      expect_equal(results(with_width(plane, axial_cells, SideFaces::symmetric), energy<3>(), 1, 0),
                   results(plane, energy<2>(), 1, 0), 1e-10);
    }
}

TEST(Prismatic, WithSymmetricSideFacesAndHolesIsThePlaneWheel) {
  for (const auto& [level_set_degree, dilatation] : {std::pair{1, DilatationKind::automatic},
                                                     {2, DilatationKind::automatic},
                                                     {2, DilatationKind::pointwise}}) {
    SCOPED_TRACE(level_set_degree);
    auto plane = plane_model(0.48);
    plane.dilatation = dilatation;
    plane.distributed = {{900, 300}, 2e4};
    expect_equal(results(with_width(plane, 2, SideFaces::symmetric), energy<3>(), level_set_degree, 0.0273),
                 results(plane, energy<2>(), level_set_degree, 0.0273), 1e-6);
  }
}

TEST(Prismatic, WithFrictionAndTorqueIsThePlaneWheel) {
  auto plane = plane_model(0.4);
  plane.contact.friction = 0.4;
  plane.torque = 150 / width;
  expect_equal(results(with_width(plane, 1, SideFaces::symmetric), energy<3>(), 1, 0.0273),
               results(plane, energy<2>(), 1, 0.0273), 1e-6);
}

/// Derivative of the strain energy of a wheel that is the same all along the axle, in directions that change
/// along it as the factor does.
double derivative_along(const RollingModel<3>& model, const std::function<double(double z)>& factor) {
  const auto problem = RollingProblem<3>::create(model);
  const LevelSet<3> psi = shape<3>(model.grid, 2, 0.0273);
  const ShapeFunction<3> function = objective(energy<3>());
  const auto evaluated = evaluate<3>(*problem, std::span(&function, 1), psi, nullptr);
  if (!evaluated) throw std::runtime_error(evaluated.failure().detail);
  std::vector<double> direction;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i);
    direction.push_back((1 + 0.4 * std::cos(12 * p[1] + 30 * p[0])) * factor(p[2]));
  }
  return directional_derivative<3>(evaluated->evaluation.gradient("objective"), psi, direction, model.degree);
}

// The plane's best shape is stationary among all shapes of the wheel, whichever way it is made.
TEST(Prismatic, ChangesAlongTheAxleHaveNoEffectToFirstOrder) {
  const auto model = with_width(plane_model(0.4), 2, SideFaces::symmetric);
  const double extruded = std::abs(derivative_along(model, [](double) { return 1.0; }));
  EXPECT_GT(extruded, 0);
  for (const auto& factor : {std::function([](double z) { return std::cos(pi * z / width); }),
                             std::function([](double z) { return std::cos(2 * pi * z / width); })})
    EXPECT_LT(std::abs(derivative_along(model, factor)), 1e-6 * extruded);
}

/// A wheel under one load position, with so many cells across a sector each way.
RollingModel<2> plane_wheel(const Material& material, int cells) {
  auto plane = plane_model(0.4);
  plane.materials = material;
  plane.cut_points.reset();
  plane.grid.cells = {cells, cells};
  plane.n_positions = 1;
  return plane;
}

/// Strain energy per metre of width.
template <int dim>
double energy_per_metre(const RollingModel<dim>& model) {
  const auto problem = RollingProblem<dim>::create(model);
  const auto states = all_states<dim>(*problem, shape<dim>(model.grid, 1, 0.0273));
  if (!states) throw std::runtime_error(states.failure().detail);
  return (*states)->strain_energy()[0] / (dim == 3 ? model.grid.width : 1);
}

/// How far a wheel with free side faces is off one in the plane, under the same load per metre of width.
double off_plane(Plane assumption, double wide, int axial_cells, int cells) {
  Material material{200e6, 0.4};
  material.plane = assumption;
  auto plane = plane_wheel(material, cells);
  const double in_plane = energy_per_metre(plane);
  plane.materials = Material{200e6, 0.4};
  plane.grid.width = wide;
  plane.contact.gamma_0 *= material.scaling_modulus() / 200e6;  // gamma is that of the wheel in the plane
  return energy_per_metre(with_width(plane, axial_cells, SideFaces::free)) / in_plane - 1;
}

// The energy tends to a limit as the width falls, and the limit to plane stress as the cells do: a continuous
// displacement along the axle cannot follow the jumps of the strain in the plane between cells, most of all
// at the contact.
TEST(Prismatic, AThinDiscTendsToPlaneStress) {
  const double limit = off_plane(Plane::stress, 1e-3, 1, 28);
  double farther = 0.1;
  for (const double wide : {4e-2, 2e-2, 1e-2}) {
    const double off = std::abs(off_plane(Plane::stress, wide, 1, 28) - limit);
    EXPECT_LT(off, 0.7 * farther);
    farther = off;
  }
  EXPECT_LT(std::abs(limit), 0.006);
  EXPECT_LT(std::abs(limit), 0.4 * std::abs(off_plane(Plane::stress, 1e-3, 1, 7)));
}

// Links of such sheets are badly conditioned: cells are 30 to 35 times as high as thick. From about 40 times
// on, rounding decides whether the stiffness of the ring is positive definite: it differs between the
// kernels that BLAS has for processors.
TEST(Prismatic, AVeryThinDiscIsNotRefused) {
  const double limit = off_plane(Plane::stress, 1e-3, 1, 7);
  for (const double wide : {7e-4, 6e-4}) EXPECT_NEAR(off_plane(Plane::stress, wide, 1, 7), limit, 1e-4);
}

// What the side faces take away stays while the width grows: it is inversely proportional to the width.
TEST(Prismatic, ADrumTendsToPlaneStrain_Slow) {
  const double off_1 = off_plane(Plane::strain, 1, 4, 7), off_2 = off_plane(Plane::strain, 2, 8, 7);
  EXPECT_LT(off_2, 0.02);
  EXPECT_NEAR(off_2 / off_1, 0.5, 0.06);
}

}  // namespace
}  // namespace wheelwright::testing
