#include "wheelwright/shape/evolution/deformation_space.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>

#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/spline_level_set.h"
#include "wheelwright/shape/evolution/transport.h"
#include "wheelwright/shape/geometry/shapes.h"

using namespace wheelwright;

namespace {

template <int dim>
Lattice<dim> lattice_of(int degree, int cells = 24) {
  if constexpr (dim == 2)
    return {{0.20, 0.34, 0.12, 12, {cells, 28 * cells / 24}}, degree};
  else
    return {{0.20, 0.34, 0.12, 12, {cells / 2, cells / 2, cells / 3}}, degree};
}

/// Three holes without any symmetry; one crosses the face of the sector.
template <int dim>
LevelSet<dim> some_holes(const Lattice<dim>& lattice) {
  return make_level_set<dim>(
      lattice, std::vector<Circle>{{0.235, 0.03, 0.018}, {0.30, 0.21, 0.022}, {0.262, 0.40, 0.03}});
}

std::vector<double> random_field(int size, std::mt19937& random) {
  std::vector<double> field(size);
  for (double& x : field) x = std::normal_distribution<double>()(random);
  return field;
}

double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

template <class Lattice>
std::vector<bool> inner_edge(const Lattice& lattice) {
  std::vector<bool> fixed(lattice.n_nodes());
  for (int node = 0; node < lattice.n_nodes(); ++node) fixed[node] = lattice.polar_point(node)[0] < 0.207;
  return fixed;
}

/// The nodal field whose value at a point, given as (radius, azimuth[, axial]), is that of the function.
template <int dim, class Function>
std::vector<double> field_of(const Lattice<dim>& lattice, Function function) {
  std::vector<double> field(dim * lattice.n_nodes());
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const Vec<dim> value = function(lattice.polar_point(node));
    for (int axis = 0; axis < dim; ++axis) field[axis * lattice.n_nodes() + node] = value[axis];
  }
  return field;
}

template <int dim>
std::vector<SurfacePoint<dim>> points_of(const std::vector<SurfaceSample<dim>>& samples) {
  return {samples.begin(), samples.end()};
}

template <int dim>
std::vector<double> normal_load(const DeformationSpace<dim>& space, const LevelSet<dim>& psi,
                                const std::vector<SurfaceSample<dim>>& samples) {
  std::vector<double> density;
  for (const auto& sample : samples) density.push_back(sample.value);
  return space.motion_of(psi, points_of<dim>(samples)).load(density);
}

template <int space_dim, DeformationKind deformation_kind>
struct Setting {
  static constexpr int dim = space_dim;
  static constexpr DeformationKind kind = deformation_kind;
};
template <class Setting>
class DeformationSpaces : public testing::Test {};
using Settings =
    testing::Types<Setting<2, DeformationKind::vector_field>, Setting<2, DeformationKind::normal_speed>,
                   Setting<3, DeformationKind::vector_field>, Setting<3, DeformationKind::normal_speed>>;
TYPED_TEST_SUITE(DeformationSpaces, Settings);

/// (t, w) = load . w for the representative t, and load() is its inverse where nodes are not fixed.
TYPED_TEST(DeformationSpaces, RepresentativesMakeLoadsToInnerProducts) {
  constexpr int dim = TypeParam::dim;
  const auto lattice = lattice_of<dim>(1);
  const DeformationSpace<dim> space(lattice, inner_edge(lattice), 0.03, TypeParam::kind);
  std::mt19937 random(5);
  const auto load = random_field(space.n_components() * lattice.n_nodes(), random),
             any = random_field(space.n_components() * lattice.n_nodes(), random);
  const auto deformation = space.representative(load);
  const auto admissible = space.representative(space.load(any));  // `any` with zeros at the fixed nodes
  EXPECT_NEAR(dot_product(space.load(deformation), admissible), dot_product(load, admissible),
              1e-9 * std::sqrt(dot_product(load, load) * dot_product(admissible, admissible)));
  for (int node = 0; node < lattice.n_nodes(); ++node)
    for (int component = 0; component < space.n_components(); ++component) {
      const int k = component * lattice.n_nodes() + node;
      EXPECT_NEAR(admissible[k], inner_edge(lattice)[node] ? 0 : any[k], 1e-9);
    }
}

/// A density's load is the integral of the density times the speed of the boundary.
TYPED_TEST(DeformationSpaces, LoadsOfDensitiesAreIntegralsOfSpeeds) {
  constexpr int dim = TypeParam::dim;
  for (const int degree : {1, 2}) {
    const auto lattice = lattice_of<dim>(degree);
    const DeformationSpace<dim> space(lattice, std::vector<bool>(lattice.n_nodes(), false), 0.02,
                                      TypeParam::kind);
    std::mt19937 random(7);
    const auto psi = some_holes<dim>(lattice);
    auto samples = boundary_samples<dim>(psi);
    const auto deformation = random_field(space.n_components() * lattice.n_nodes(), random);
    const auto speeds = space.motion_of(psi, points_of<dim>(samples)).speeds(deformation);
    double sum = 0;
    for (std::size_t q = 0; q < samples.size(); ++q) {
      samples[q].value = std::normal_distribution<double>()(random);
      sum += samples[q].weight * samples[q].value * speeds[q];
    }
    EXPECT_NEAR(dot_product(normal_load(space, psi, samples), deformation), sum, 1e-10);
  }
}

/// The derivative of the measure along any deformation is that of the shapes that its speeds lead to.
TYPED_TEST(DeformationSpaces, SpeedsMoveTheBoundaryByTheNormalPart) {
  constexpr int dim = TypeParam::dim;
  const auto lattice = lattice_of<dim>(2, dim == 2 ? 48 : 24);
  const DeformationSpace<dim> space(lattice, std::vector<bool>(lattice.n_nodes(), false), 0.02,
                                    TypeParam::kind);
  const auto psi = spline_level_set(spline_coefficients(some_holes<dim>(lattice)));
  auto deformation = field_of<dim>(lattice, [](const Vec<dim>& x) {
    Vec<dim> value{};
    value[0] = 0.3 + std::sin(12 * x[1]) + 2 * x[0];
    value[1] = std::cos(12 * x[1]) - 3 * x[0];
    return value;
  });
  deformation.resize(space.n_components() * lattice.n_nodes());  // a speed: the first component
  auto samples = boundary_samples<dim>(psi);
  for (auto& sample : samples) sample.value = 1;
  const double slope = dot_product(normal_load(space, psi, samples), deformation);
  const auto speeds = space.speeds(psi, deformation);
  const double time = 1e-5;
  std::vector<double> opposite = speeds;
  for (double& v : opposite) v = -v;
  const auto measure = [&](const std::vector<double>& velocity) {
    return material_measure(
        spline_level_set(smooth_transport<dim>(spline_coefficients(psi), velocity, time)));
  };
  const double change = (measure(speeds) - measure(opposite)) / (2 * time);
  double size = 0;
  for (const auto& sample : samples) size += sample.weight;
  EXPECT_NEAR(change, slope, (dim == 2 ? 2e-3 : 2e-2) * size);
}

/// A shift of the whole wheel shifts a hole as it is, but for what is quadratic in the shift: transport()
/// keeps the speeds that the normals had in the beginning.
TEST(DeformationSpace, AUniformFieldShiftsAHole) {
  const auto lattice = lattice_of<2>(2, 48);
  const DeformationSpace<2> space(lattice, std::vector<bool>(lattice.n_nodes(), false), 0.02,
                                  DeformationKind::vector_field);
  const Circle hole{0.27, std::numbers::pi / 12, 0.025};
  const auto psi = make_level_set<2>(lattice, std::vector<Circle>{hole});
  const double angle = 0.7;
  const auto uniform = field_of<2>(lattice, [&](const Vec<2>& x) {
    return Vec<2>{std::cos(angle - x[1]), std::sin(angle - x[1])};
  });
  for (const double cells : {0.5, 1.5}) {
    const double distance = cells * lattice.grid().resolution();
    const auto moved = transport<2>(psi, space.speeds(psi, uniform), distance);
    const Vec<2> centre = cartesian<2>({hole.centre_radius, hole.centre_azimuth}),
                 shifted{centre[0] + distance * std::cos(angle), centre[1] + distance * std::sin(angle)};
    for (const auto& sample : boundary_samples<2>(moved)) {
      const auto cell = lattice.grid().cell_position(sample.cell);
      const Vec<2> size = lattice.grid().cell_size(0);
      const Vec<2> x = cartesian<2>({lattice.grid().inner_radius + (cell[0] + sample.xi[0]) * size[0],
                                     (cell[1] + sample.xi[1]) * size[1]});
      EXPECT_NEAR(std::hypot(x[0] - shifted[0], x[1] - shifted[1]), hole.hole_radius,
                  distance * distance / (2 * hole.hole_radius) + 1e-3 * lattice.grid().resolution());
    }
  }
}

/// The purpose of vector fields: to move a thin wall costs less than to make it as much thicker.
TEST(DeformationSpace, MovingAThinWallCostsLessThanThickeningIt) {
  const auto lattice = lattice_of<2>(2, 48);
  const double cell = lattice.grid().resolution();
  const DeformationSpace<2> space(lattice, std::vector<bool>(lattice.n_nodes(), false), 8 * cell,
                                  DeformationKind::vector_field);
  const double middle = 0.27, azimuth = std::numbers::pi / 12;
  const auto psi = make_level_set<2>(
      lattice, std::vector<Circle>{{middle - 0.031, azimuth, 0.03}, {middle + 0.031, azimuth, 0.03}});
  auto samples = boundary_samples<2>(psi);
  const auto cost = [&](double lower_edge) {
    for (auto& sample : samples) {
      const auto position = lattice.grid().cell_position(sample.cell);
      const double radius = 0.20 + (position[0] + sample.xi[0]) * lattice.grid().row_height(0);
      const bool is_near = std::abs(radius - middle) < 3 * cell;
      sample.value = !is_near ? 0 : radius < middle ? lower_edge : 1;
    }
    const auto load = normal_load(space, psi, samples);
    return 1 / dot_product(load, space.representative(load));  // of the unit of motion with this pattern
  };
  EXPECT_LT(3 * cost(-1), cost(1));
}

}  // namespace
