// Materials whose axes are radius, azimuth and axle: constants, elements, exact rings, and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/read.h"
#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/mechanics/elasticity/orthotropic_law.h"
#include "wheelwright/mechanics/elasticity/small_hole.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/quantities/analysis/position_deformation.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/rim_quantities.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {
namespace {

using std::numbers::pi;
using testing::paper_model;

/// A band stiff along the azimuth, with three different ratios.
const OrthotropicMaterial band{.modulus_r = 80e6,
                               .modulus_t = 900e6,
                               .modulus_z = 200e6,
                               .ratio_rt = 0.05,
                               .ratio_rz = 0.31,
                               .ratio_tz = 0.42,
                               .shear_rt = 45e6,
                               .shear_rz = 33e6,
                               .shear_tz = 70e6};

OrthotropicMaterial in_plane_stress(OrthotropicMaterial material) {
  material.plane = Plane::stress;
  return material;
}

/// An isotropic material by the constants of an orthotropic one.
OrthotropicMaterial same(const Material& m) {
  const double e = m.youngs_modulus, nu = m.poissons_ratio, g = e / (2 * (1 + nu));
  return {e, e, e, nu, nu, nu, g, g, g, m.plane, m.density};
}

template <int dim>
Materials<dim> of(const OrthotropicMaterial& material) {
  return Materials<dim>(std::make_shared<OrthotropicLaw<dim>>(material));
}

/// The compliance of normal stresses.
Matrix compliance(const OrthotropicMaterial& m) {
  Matrix s(3, 3);
  s(0, 0) = 1 / m.modulus_r;
  s(1, 1) = 1 / m.modulus_t;
  s(2, 2) = 1 / m.modulus_z;
  s(0, 1) = s(1, 0) = -m.ratio_rt / m.modulus_r;
  s(0, 2) = s(2, 0) = -m.ratio_rz / m.modulus_r;
  s(1, 2) = s(2, 1) = -m.ratio_tz / m.modulus_t;
  return s;
}

TEST(OrthotropicMaterial, StrainsUnderOneStressAreThoseOfItsConstants) {
  const Matrix s = compliance(band);
  const OrthotropicLaw<3> law(band);
  for (int axis = 0; axis < 3; ++axis) {
    const Voigt<3> sigma = stress<3>(law, {s(0, axis), s(1, axis), s(2, axis), 0, 0, 0});
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(sigma[k], k == axis ? 1 : 0, 1e-12);
  }
  const Voigt<3> shear = stress<3>(law, {0, 0, 0, 1, 2, 3});
  EXPECT_DOUBLE_EQ(shear[3], band.shear_tz);
  EXPECT_DOUBLE_EQ(shear[4], 2 * band.shear_rz);
  EXPECT_DOUBLE_EQ(shear[5], 3 * band.shear_rt);
}

/// In plane strain the law is that in 3D without strain along the axle, in plane stress without stress there.
TEST(OrthotropicMaterial, InThePlaneIsThatInThreeDimensions) {
  const OrthotropicLaw<3> solid(band);
  const Voigt<2> e{1.3e-3, -0.7e-3, 2.1e-3};
  const auto check = [&](const OrthotropicMaterial& material, double axial_strain) {
    const OrthotropicLaw<2> law(material);
    const Voigt<3> all{e[0], e[1], axial_strain, 0, 0, e[2]}, sigma = stress<3>(solid, all);
    const Voigt<2> plane = stress<2>(law, e);
    for (const auto& [k, l] : {std::pair{0, 0}, {1, 1}, {2, 5}})
      EXPECT_NEAR(plane[k], sigma[l], 1e-11 * band.modulus_t * 1e-3);
    double stress_z = 0, strain_z = 0, square = 0, square_of_solid = 0;
    law.along_axle(one_strain<2>(e), {&stress_z, 1}, {&strain_z, 1});
    EXPECT_NEAR(stress_z, sigma[2], 1e-11 * band.modulus_t * 1e-3);
    EXPECT_NEAR(strain_z, axial_strain, 1e-15);
    law.squared_von_mises(one_strain<2>(e), {&square, 1});
    solid.squared_von_mises(one_strain<3>(all), {&square_of_solid, 1});
    EXPECT_NEAR(square / square_of_solid, 1, 1e-12);
    const double a = sigma[0] - sigma[1], b = sigma[1] - sigma[2], c = sigma[2] - sigma[0];
    EXPECT_NEAR(square / (0.5 * (a * a + b * b + c * c) + 3 * sigma[5] * sigma[5]), 1, 1e-12);
  };
  check(band, 0);
  const auto c = band.stiffness<3>();
  check(in_plane_stress(band), -(c[2][0] * e[0] + c[2][1] * e[1]) / c[2][2]);
}

/// The compliance in the plane is the inverse of the stiffness there.
TEST(OrthotropicMaterial, ComplianceIsTheInverseOfStiffness) {
  for (const OrthotropicMaterial& material : {band, in_plane_stress(band)}) {
    const auto c = material.stiffness<2>();
    const auto [rr, tt, rt, shear] = material.plane_compliance();
    EXPECT_NEAR(c[0][0] * rr + c[0][1] * rt, 1, 1e-12);
    EXPECT_NEAR(c[1][0] * rt + c[1][1] * tt, 1, 1e-12);
    EXPECT_NEAR(c[0][0] * rt + c[0][1] * tt, 0, 1e-12 * material.modulus_t / material.modulus_r);
    EXPECT_NEAR(c[2][2] * shear, 1, 1e-12);
  }
}

/// Against the factorization of random compliances.
TEST(OrthotropicMaterial, IsStableIfItsComplianceIsPositive) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coupling(-1.1, 1.1), exponent(5, 10);
  int stable = 0;
  for (int i = 0; i < 2000; ++i) {
    OrthotropicMaterial m = band;
    m.modulus_r = std::pow(10, exponent(random));
    m.modulus_t = std::pow(10, exponent(random));
    m.modulus_z = std::pow(10, exponent(random));
    const double a = coupling(random), b = coupling(random), c = coupling(random);
    m.ratio_rt = a * std::sqrt(m.modulus_r / m.modulus_t);
    m.ratio_rz = b * std::sqrt(m.modulus_r / m.modulus_z);
    m.ratio_tz = c * std::sqrt(m.modulus_t / m.modulus_z);
    Matrix normalized(3, 3);
    for (int k = 0; k < 3; ++k) normalized(k, k) = 1;
    normalized(0, 1) = normalized(1, 0) = -a;
    normalized(0, 2) = normalized(2, 0) = -b;
    normalized(1, 2) = normalized(2, 1) = -c;
    Matrix factor = normalized;
    EXPECT_EQ(m.is_stable(), cholesky(factor));
    const double least = m.least_compliance();
    for (int k = 0; k < 3; ++k) normalized(k, k) -= least;
    for (int k = 0; k < 3; ++k) normalized(k, k) += 1e-9;
    factor = normalized;
    EXPECT_TRUE(cholesky(factor));  // no eigenvalue is smaller
    for (int k = 0; k < 3; ++k) normalized(k, k) -= 2e-9;
    factor = normalized;
    EXPECT_FALSE(cholesky(factor));
    stable += m.is_stable();
  }
  EXPECT_GT(stable, 200);
  EXPECT_LT(stable, 1800);
}

TEST(OrthotropicMaterial, OfIsotropicConstantsIsIsotropic) {
  for (const Material& m : {Material{200e6, 0.3}, Material{7e6, 0.47}, Material{70e9, 0.33, Plane::stress}}) {
    const OrthotropicMaterial material = same(m);
    EXPECT_NEAR(material.scaling_modulus() / m.scaling_modulus(), 1, 1e-12);
    EXPECT_NEAR(material.contact_modulus() / m.contact_modulus(), 1, 1e-12);
    EXPECT_NEAR(material.radial_stiffness() / (m.lambda() + 2 * m.mu()), 1, 1e-12);
    if (m.plane == Plane::strain) {
      EXPECT_NEAR(material.least_compliance(), 1 - 2 * m.poissons_ratio, 1e-12);
    }
    const Voigt<2> e{1e-3, -2e-3, 0.7e-3}, hole = strain_of_hole<2>(m, e),
                                           found = strain_of_hole(material, e);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], hole[k], 1e-13);
  }
  EXPECT_FALSE(same({200e6, 0.484}).locks());
  EXPECT_TRUE(same({200e6, 0.486}).locks());
  EXPECT_FALSE(same({200e6, 0.49, Plane::stress}).locks());
}

template <int dim>
PolarGrid<dim> coarse_grid() {
  PolarGrid<dim> grid{0.20, 0.34, 0.12, 16, {}};
  grid.cells.fill(2);
  return grid;
}

/// The strain as a tensor seen in axes turned about the axle.
template <int dim>
Voigt<dim> turned(const Voigt<dim>& e, double angle) {
  const auto tensor = [&] {
    Mat<dim> t{};
    if constexpr (dim == 2)
      t = {{{e[0], e[2] / 2}, {e[2] / 2, e[1]}}};
    else
      t = {{{e[0], e[5] / 2, e[4] / 2}, {e[5] / 2, e[1], e[3] / 2}, {e[4] / 2, e[3] / 2, e[2]}}};
    return t;
  }();
  std::array<Vec<dim>, dim> axes{};
  for (int d = 0; d < dim; ++d) {
    axes[d][d] = 1;
    axes[d] = rotated<dim>(axes[d], angle);
  }
  const auto seen = [&](int a, int b) {
    double sum = 0;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) sum += axes[a][i] * tensor[i][j] * axes[b][j];
    return sum;
  };
  if constexpr (dim == 2)
    return {seen(0, 0), seen(1, 1), 2 * seen(0, 1)};
  else
    return {seen(0, 0), seen(1, 1), seen(2, 2), 2 * seen(1, 2), 2 * seen(0, 2), 2 * seen(0, 1)};
}

template <class Dimension>
class OrthotropicElement : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(OrthotropicElement, Dimensions);

/// At every point strains are those of other laws, seen in the axes there; tractions are in the cell's frame,
/// and the stiffness is the integral of stress times strain.
TYPED_TEST(OrthotropicElement, StrainsAreInPolarAxes) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  const OrthotropicLaw<dim> law(band);
  const IsotropicLaw<dim> plain({200e6, 0.3});
  const auto at_dof = [](const auto& rows, int dof) {
    Voigt<dim> value;
    for (int k = 0; k < n_strains<dim>; ++k) value[k] = rows[k][dof];
    return value;
  };
  for (const int degree : {1, 2}) {
    const ElasticElement<dim> element(grid, degree, {1}, law), in_cell(grid, degree, {1}, plain);
    const auto rule = unit_cell_rule<dim>(degree + 2);
    Matrix k(element.n_dofs(), element.n_dofs());
    for (const auto& q : rule) {
      const auto at = element.at(q.xi), there = in_cell.at(q.xi);
      const double azimuth = std::atan2(at.position[1], at.position[0]);
      Vec<dim> normal{};
      normal[0] = 0.6;
      normal[1] = 0.8;
      const auto tractions = traction_map<dim>(element, law, at, normal);
      std::vector<Voigt<dim>> strains, stresses;
      for (int dof = 0; dof < element.n_dofs(); ++dof) {
        strains.push_back(turned<dim>(at_dof(there.strain, dof), azimuth));
        stresses.push_back(stress<dim>(law, strains[dof]));
        const Voigt<dim> found = at_dof(at.strain, dof);
        for (int s = 0; s < n_strains<dim>; ++s) EXPECT_NEAR(found[s], strains[dof][s], 1e-11);
        const Vec<dim> seen =
            rotated<dim>(traction<dim>(stresses[dof], rotated<dim>(normal, -azimuth)), azimuth);
        for (int d = 0; d < dim; ++d) EXPECT_NEAR(tractions[d][dof], seen[d], 1e-11 * band.modulus_t);
      }
      for (int i = 0; i < k.rows(); ++i)
        for (int j = 0; j < k.rows(); ++j)
          for (int s = 0; s < n_strains<dim>; ++s)
            k(i, j) += q.weight * at.determinant * strains[i][s] * stresses[j][s];
    }
    const Matrix found = cell_stiffness<dim>(element, law, rule);
    double largest = 0;
    for (const double x : k.entries()) largest = std::max(largest, std::abs(x));
    for (size_t i = 0; i < k.entries().size(); ++i)
      EXPECT_NEAR(found.entries()[i], k.entries()[i], 1e-12 * largest);
  }
}

/// A wheel without symmetry, with friction, torque, body force and a speed.
template <int dim>
RollingModel<dim> lopsided() {
  RollingModel<dim> model;
  model.grid.inner_radius = 0.20;
  model.grid.outer_radius = 0.34;
  model.grid.width = 0.12;
  model.grid.n_sectors = 8;
  if constexpr (dim == 2)
    model.grid.cells = {14, 24};
  else
    model.grid.cells = {7, 8, 2};
  model.degree = 2;
  model.materials = Material{200e6, 0.3, Plane::strain, 1100};
  model.load = dim == 2 ? 24525 : 2943;
  model.contact.friction = 0.4;
  model.contact_points = 3;
  model.torque = dim == 2 ? 200 : 24;
  model.distributed.body_force = {3e4, 1e4};
  model.distributed.angular_speed = 20;
  model.n_positions = 2;
  return model;
}

template <int dim>
LevelSet<dim> two_holes(const PolarGrid<dim>& grid) {
  const double a = grid.sector_angle();
  const Circle holes[] = {{0.2471, 0.16 * a, 0.0153}, {0.2663, 0.61 * a, 0.0191}};
  auto psi = make_level_set<dim>(Lattice<dim>(grid, dim == 2 ? 2 : 1), holes);
  if constexpr (dim == 3)
    for (int i = 0; i < psi.lattice.n_nodes(); ++i)
      psi.values[i] += 0.003 * std::cos(20 * psi.lattice.polar_point(i)[2]);
  return psi;
}

std::vector<double> finite(std::vector<double> values) {
  for (double& x : values)
    if (std::isnan(x)) x = 0;
  return values;
}

/// Isotropic constants entered as orthotropic ones: all numbers of a wheel.
template <int dim>
void expect_the_same(const Material& isotropic) {
  const auto psi = two_holes<dim>(lopsided<dim>().grid);
  std::vector<std::vector<double>> numbers[2];
  for (const int which : {0, 1}) {
    auto model = lopsided<dim>();
    model.materials = which == 0 ? Materials<dim>(isotropic) : of<dim>(same(isotropic));
    const auto problem = RollingProblem<dim>::create(model);
    ASSERT_TRUE(problem) << problem.failure().detail;
    const std::vector<ShapeFunction<dim>> functions{
        {.name = "energy", .terms = {{1, std::make_shared<StrainEnergy<dim>>()}}},
        {.name = "peak", .terms = {{1, std::make_shared<PeakVonMises<dim>>(0)}}}};
    const auto solved = evaluate<dim>(*problem, functions, psi);
    ASSERT_TRUE(solved) << solved.failure().detail;
    auto& found = numbers[which];
    for (const auto& f : solved->evaluation.functions) {
      found.push_back({f.value});
      found.push_back(f.gradient);
    }
    const State<dim>& state = *solved->state;
    found.push_back(state.strain_peaks().von_mises);
    found.push_back(state.strain_peaks().principal);
    found.push_back(finite(stress_field(model, state.domain(), state.displacement().at_nodes(0)).values));
    for (const auto& position : position_deformations<dim>(*problem, state))
      found.push_back({position.neglected.of_rotation, position.neglected.of_strain,
                       position.neglected.of_bending, position.largest_rotation});
    if (dim == 2) {
      Vec<dim> middle;
      middle.fill(0.5);
      const std::vector<MaterialPoint<dim>> points{{0, middle}};
      const State<dim>* const only = &state;
      const std::vector<ShapeFunction<dim>> energy{functions[0]};
      const auto derivative =
          topological_derivatives<dim>(*problem, {}, energy, psi, std::span(&only, 1), points, 1e-3);
      ASSERT_TRUE(derivative) << derivative.failure().detail;
      found.push_back((*derivative)[0]);
    }
  }
  // Rounding grows with the condition of the stiffness.
  for (size_t i = 0; i < numbers[0].size(); ++i)
    EXPECT_LT(testing::relative_difference(numbers[1][i], numbers[0][i]), 1e-8) << i;
  EXPECT_NEAR(numbers[1][0][0] / numbers[0][0][0], 1, 1e-11);
}

TEST(OrthotropicWheel, OfIsotropicConstantsIsTheIsotropicOne) {
  expect_the_same<2>({200e6, 0.3, Plane::strain, 1100});
  expect_the_same<2>({200e6, 0.48, Plane::stress, 1100});
  expect_the_same<3>({200e6, 0.3, Plane::strain, 1100});
}

template <int dim>
Materials<dim> with_cord(const Materials<dim>& materials, double radius, double stiffness) {
  return Materials<dim>(materials.layers(), {{radius, stiffness}});
}

/// With faces that do not move along the axle a wheel of constant section is in plane strain, also with a
/// cord.
TEST(OrthotropicWheel, BetweenFixedFacesIsInPlaneStrain) {
  auto plane = lopsided<2>();
  plane.grid.cells = {7, 8};
  plane.distributed = {};
  plane.cut_points = 8;
  plane.materials = of<2>(band);
  RollingModel<3> solid = lopsided<3>();
  solid.grid.cells = {7, 8, 2};
  solid.distributed = {};
  solid.cut_points = 8;
  solid.side_faces = SideFaces::symmetric;
  solid.materials = of<3>(band);
  solid.load = plane.load * plane.grid.width;
  solid.torque = plane.torque * plane.grid.width;
  plane.materials = with_cord(plane.materials, 0.32, 3e6);
  solid.materials = with_cord(solid.materials, 0.32, 3e6);
  const Circle hole{0.2581, 0.47 * plane.grid.sector_angle(), 0.03};
  const auto of_plane = RollingProblem<2>::create(plane);
  const auto of_solid = RollingProblem<3>::create(solid);
  ASSERT_TRUE(of_plane && of_solid);
  const auto a =
      testing::all_states<2>(*of_plane, make_level_set<2>(Lattice<2>(plane.grid, 1), std::span(&hole, 1)));
  const auto b =
      testing::all_states<3>(*of_solid, make_level_set<3>(Lattice<3>(solid.grid, 1), std::span(&hole, 1)));
  ASSERT_TRUE(a && b);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR((*b)->strain_energy()[i] / (*a)->strain_energy()[i] / plane.grid.width, 1, 1e-6);
    EXPECT_NEAR((*b)->strain_peaks().von_mises[i] / (*a)->strain_peaks().von_mises[i], 1, 1e-3);
  }
}

/// Layers of different axes, of which holes cross the interface; without symmetry, with friction. Stresses
/// are singular where the interface meets the edge of a hole, so that their integrals are taken in one
/// material.
TEST(OrthotropicWheel, ShapeGradientPassesTheTaylorTest) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    OrthotropicMaterial inside = band, outside = band;
    std::swap(inside.modulus_r, inside.modulus_t);
    inside.ratio_rt = 0.4;
    inside.plane = outside.plane = plane;
    inside.density = 1200;
    outside.density = 900;
    auto model = paper_model(14, 192);
    model.n_positions = 3;
    model.contact.friction = 0.3;
    model.horizontal_force = 0.1 * model.load;
    model.distributed.body_force = {3e4, 1e4};
    model.materials =
        Materials<2>(std::vector<Materials<2>::Layer>{{0.27, std::make_shared<OrthotropicLaw<2>>(inside)},
                                                      {0.34, std::make_shared<OrthotropicLaw<2>>(outside)}});
    const auto expect_second_order = [](const RollingModel<2>& wheel, const WeightedSum<2>& terms) {
      const auto problem = RollingProblem<2>::create(wheel);
      ASSERT_TRUE(problem) << problem.failure().detail;
      const auto test = testing::generic_taylor_test(*problem, terms);
      ASSERT_TRUE(test) << test.failure().detail;
      for (const double order : test->orders) EXPECT_GT(order, 1.9) << terms.front().functional->name();
    };
    expect_second_order(model, testing::strain_energy_alone());
    expect_second_order(model, {{1, std::make_shared<Travel<2>>()}});
    model.materials = of<2>(outside);
    model.cut_points = 8;  // the power of the stress has a high degree
    expect_second_order(
        model, {{1, std::make_shared<PeakVonMises<2>>(0.025, PeakNorm{.exponent = 4, .correction = 1})}});
  }
}

/// A shape turned by a column, seen from positions that are one column apart.
TEST(OrthotropicWheel, TurnedByAColumnIsTheSame) {
  auto model = paper_model(7, 128);
  model.grid.n_sectors = 16;
  model.grid.cells = {7, 8};
  model.n_positions = 8;
  model.contact.friction = 0.3;
  model.torque = 100;
  model.materials = of<2>(band);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const double column = model.grid.column_angle();
  std::vector<double> energies[2];
  for (const int by : {0, 1}) {
    const auto psi =
        testing::holes(model.grid, 2, {{0.2581, 0.47 * model.grid.sector_angle() + by * column, 0.021}});
    const auto state = testing::all_states<2>(*problem, psi);
    ASSERT_TRUE(state) << state.failure().detail;
    energies[by] = (*state)->strain_energy();
    std::ranges::sort(energies[by]);
  }
  EXPECT_LT(testing::relative_difference(energies[1], energies[0]), 1e-9);
  EXPECT_GT(energies[0].back(), 1.001 * energies[0].front());
}

/// A bush between rigid rings that turn against each other: sigma_rt = T / (2 pi r^2), whatever the moduli.
TEST(OrthotropicWheel, TwistsAsItsShearModulusSays) {
  auto model = paper_model(16, 128);
  model.grid.n_sectors = 8;
  model.grid.cells[1] = 16;
  model.contact.counterpart = Counterpart::ring;
  model.contact_points = 3;
  model.n_positions = 1;
  model.torque = 1000;
  model.materials = of<2>(band);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto state = testing::all_states<2>(*problem, testing::holes(model.grid, 2, {}));
  ASSERT_TRUE(state);
  const double exact = 4 * pi * band.shear_rt / (1 / (0.2 * 0.2) - 1 / (0.34 * 0.34));
  EXPECT_NEAR(model.torque / (*state)->contacts()[0].rim.rotation / exact, 1, 1e-4);
}

/// The peak pressure under a load by Hertz's theory with the contact modulus of an orthotropic half-plane.
TEST(OrthotropicWheel, PressesTheGroundAsItsContactModulusSays) {
  for (const double moduli : {0.2, 6.0}) {
    OrthotropicMaterial material = band;
    material.modulus_t = material.modulus_r * moduli;
    material.ratio_rt = 0.2;
    material.ratio_tz = 0.2;
    material.shear_rt = 30e6;
    auto model = paper_model(28, 384);
    model.n_positions = 1;
    model.load = 2000;
    model.tread.levels = 4;
    model.materials = of<2>(material);
    const auto problem = RollingProblem<2>::create(model);
    ASSERT_TRUE(problem) << problem.failure().detail;
    const auto state = testing::all_states<2>(*problem, testing::holes(model.grid, 2, {}));
    ASSERT_TRUE(state);
    const auto& patch = (*state)->contacts()[0];
    const double modulus = material.contact_modulus(),
                 half_width = 2 * std::sqrt(model.load * 0.34 / (pi * modulus)),
                 exact = 2 * model.load / (pi * half_width);
    double peak = 0;
    for (size_t q = 0; q < patch.points.size(); ++q)
      if (std::abs(patch.points[q].position[1]) < 0.5 * half_width)
        peak = std::max(peak, -patch.points[q].traction[0]);
    EXPECT_NEAR(peak / exact, 1, 0.03) << moduli;
  }
}

/// Of a wheel with a cord in the band above its holes: cords do not end at edges of holes.
TEST(Cord, DoesNotSpoilTheShapeGradient) {
  auto model = paper_model(14, 192);
  model.n_positions = 3;
  model.contact.friction = 0.3;
  model.torque = 100;
  const auto without = RollingProblem<2>::create(model);
  model.materials = with_cord<2>(model.materials, 0.32, 2e7);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem && without);
  for (const WeightedSum<2>& terms :
       {testing::strain_energy_alone(), WeightedSum<2>{{1, std::make_shared<Travel<2>>()}}}) {
    const auto test = testing::generic_taylor_test(*problem, terms);
    ASSERT_TRUE(test) << test.failure().detail;
    for (const double order : test->orders) EXPECT_GT(order, 1.9);
  }
  const auto psi = testing::generic_hole(model.grid);
  const auto stiff = testing::all_states<2>(*problem, psi), soft = testing::all_states<2>(*without, psi);
  ASSERT_TRUE(stiff && soft);
  EXPECT_LT((*stiff)->contacts()[0].travel(), 0.95 * (*soft)->contacts()[0].travel());
}

TEST(Cord, MustLieInMaterialBelowTheCondensedRows) {
  auto model = paper_model(14, 192);
  const auto materials = model.materials;
  model.materials = with_cord<2>(materials, 0.34, 1e6);
  EXPECT_FALSE(RollingProblem<2>::create(model));
  model.materials = with_cord<2>(materials, 0.3211, 1e6);
  EXPECT_FALSE(RollingProblem<2>::create(model));
  model.materials = with_cord<2>(materials, 0.27, 1e6);
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto state = testing::all_states<2>(*problem, testing::generic_hole(model.grid));
  ASSERT_FALSE(state);
  EXPECT_EQ(state.failure().reason, FailureReason::protected_band);
}

constexpr const char* some_band =
    "youngs_modulus_radial = 80e6\nyoungs_modulus_azimuthal = 900e6\nyoungs_modulus_axial = 200e6\n"
    "poissons_ratio_radial_azimuthal = 0.05\npoissons_ratio_radial_axial = 0.31\n"
    "poissons_ratio_azimuthal_axial = 0.42\nshear_modulus_radial_azimuthal = 45e6\n";

CaseResult case_of(const std::string& material, const std::string& more = "") {
  return parse_case(
      "[wheel]\ninner_radius = 0.05\nouter_radius = 0.1\nwidth = 0.05\nsectors = 8\n[load]\n"
      "force = 500\n" +
          material + more,
      "band.toml");
}

TEST(OrthotropicCase, HasItsConstants) {
  const auto good = case_of(std::string("[material]\n") + some_band +
                            "[[material.layer]]\ninner_radius = 0.09\nyoungs_modulus = 30e6\n"
                            "poissons_ratio = 0.4\n[[material.layer]]\nouter_radius = 0.06\n" +
                            some_band);
  ASSERT_TRUE(good.value) << good.problems.front().text();
  const auto ring = placed_materials(*good.value);
  ASSERT_EQ(ring.size(), 3u);
  ASSERT_TRUE(ring[0].orthotropic() && ring[1].orthotropic());
  EXPECT_EQ(ring[0].orthotropic()->modulus_t, 900e6);
  EXPECT_EQ(ring[1].orthotropic()->ratio_tz, 0.42);
  EXPECT_EQ(ring[2].isotropic()->youngs_modulus, 30e6);
  const auto laws = materials<2>(*good.value);
  EXPECT_EQ(*laws.at_radius(0.07).orthotropic(), *ring[1].orthotropic());
}

TEST(OrthotropicCase, ThatCannotBeIsRefusedByKey) {
  const auto refuses = [](const std::string& text, const std::string& key, const std::string& names) {
    const auto result = case_of(text);
    EXPECT_FALSE(result.value) << text;
    ASSERT_FALSE(result.problems.empty());
    EXPECT_EQ(result.problems.front().key, key) << result.problems.front().text();
    EXPECT_NE(result.problems.front().text().find(names), std::string::npos)
        << result.problems.front().text();
  };
  const auto with = [](std::string text, const std::string& key, const std::string& value) {
    const size_t begin = text.find(key + " = "), end = text.find('\n', begin);
    return "[material]\n" +
           text.replace(begin, end - begin + 1, value.empty() ? "" : key + " = " + value + "\n");
  };
  for (const char* key : {"youngs_modulus_azimuthal", "youngs_modulus_axial", "poissons_ratio_radial_axial",
                          "poissons_ratio_azimuthal_axial", "shear_modulus_radial_azimuthal"})
    refuses(with(some_band, key, ""), "material.youngs_modulus_radial", key);
  refuses(with(some_band, "youngs_modulus_radial", ""), "material.youngs_modulus_azimuthal",
          "youngs_modulus_radial");
  refuses("[[material.layer]]\ninner_radius = 0.09\nyoungs_modulus_azimuthal = 3e6\n",
          "material.layer[1].youngs_modulus", "youngs_modulus_radial");
  refuses(std::string("[material]\nyoungs_modulus = 3e6\n") + some_band, "material.youngs_modulus_radial",
          "youngs_modulus is given too");
  refuses(with(some_band, "poissons_ratio_radial_azimuthal", "-0.3"),
          "material.poissons_ratio_radial_azimuthal", "youngs_modulus_radial / youngs_modulus_azimuthal");
  refuses(with(some_band, "poissons_ratio_azimuthal_axial", "2.1"),
          "material.poissons_ratio_radial_azimuthal", "nu_rt nu_tr");
  refuses(with(some_band, "poissons_ratio_azimuthal_axial", "1.63"),
          "material.poissons_ratio_radial_azimuthal", "lock");
  const auto solid =
      parse_case(std::string("[wheel]\ndimension = 3\n[material]\n") + some_band, "solid.toml");
  EXPECT_FALSE(solid.value);
  EXPECT_NE(solid.problems.front().text().find("shear_modulus_azimuthal_axial"), std::string::npos);
}

TEST(OrthotropicCase, HasCordsWhereThereAreNoHoles) {
  const auto cord = [](const std::string& radius) {
    return "[[material.cord]]\nradius = " + radius + "\nstiffness = \"2 kN/mm\"\n";
  };
  const std::string grid = "[grid]\nradial_cells = 20\n[optimizer]\ntread_band = 0.01\n",
                    layer =
                        "[[material.layer]]\ninner_radius = 0.07\nouter_radius = 0.08\nyoungs_modulus = "
                        "3e6\npoissons_ratio = 0.4\nholes = \"none\"\n";
  const auto good = case_of(layer + cord("0.0775") + cord("0.095"), grid);
  ASSERT_TRUE(good.value) << good.problems.front().text();
  const auto found = materials<2>(*good.value);
  ASSERT_EQ(found.cords().size(), 2u);
  EXPECT_EQ(found.cords()[0].stiffness, 2e6);
  // The rows move to radii that do not fit.
  for (const char* radius : {"0.0771", "0.0999"})
    EXPECT_TRUE(materials<2>(*case_of(layer + cord(radius), grid).value)
                    .fit(polar_grid<2>(*case_of(layer + cord(radius), grid).value)));
  for (const char* radius : {"0.07", "0.085", "0.1", "0.05"}) {
    const auto refused = case_of(layer + cord(radius), grid);
    EXPECT_FALSE(refused.value) << radius;
    EXPECT_EQ(refused.problems.front().key, "material.cord[1].radius") << refused.problems.front().text();
  }
}

/// New holes change stresses in a way that is known only in isotropic materials.
TEST(OrthotropicCase, NucleatesHolesForOtherQuantitiesThanStresses) {
  const std::string material = std::string("[material]\n") + some_band,
                    nucleation =
                        "[optimizer]\nnucleation = \"converged\"\n[[holes.ring]]\ncount = 8\n"
                        "center_radius = 0.075\nradius = 0.005\n";
  EXPECT_TRUE(case_of(material, nucleation).value);
  const auto refused = case_of(material, "[objective]\nminimize = \"peak_von_mises\"\n" + nucleation);
  EXPECT_FALSE(refused.value);
  EXPECT_EQ(refused.problems.front().key, "optimizer.nucleation");
}

}  // namespace
}  // namespace wheelwright
