// Wheels that come out of a mould, and stay so.

#include "wheelwright/shape/geometry/mould.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/made_shapes.h"
#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/control_points.h"
#include "wheelwright/shape/geometry/shapes.h"
#include "wheelwright/shape/surface/axial_angles.h"

namespace wheelwright {
namespace {

constexpr double degree = std::numbers::pi / 180;

PolarGrid<3> grid() { return {0.20, 0.34, 0.12, 12, {14, 12, 6}}; }

/// Holes without any symmetry: through, closed, and at one side face.
LevelSet<3> shape_on(const Lattice<3>& lattice) {
  auto psi = make_level_set<3>(lattice, std::vector<Circle>{{0.24, 0.1, 0.016}, {0.30, 0.4, 0.014}});
  psi = with_hole(std::move(psi), Sphere{0.27, 0.26, 0.052, 0.027});
  return with_hole(std::move(psi), Groove{0.283, 0.311, 0, 0.021, 0.007});
}

Bands bands_with(const Mould& mould) {
  return {.rim = {0.01, 1}, .tread = {0.02, 1}, .between = {}, .mould = mould};
}

std::vector<double> random_field(std::size_t size, std::mt19937& random) {
  std::vector<double> field(size);
  for (double& x : field) x = std::normal_distribution<double>()(random);
  return field;
}

double at(const LevelSet<3>& psi, const std::array<int, 3>& cell, const Vec<3>& xi) {
  return testing::both_at(psi, cell, xi).value;
}

/// The least rise per length away from the plane, on lines parallel to the axle anywhere in the sector.
double least_slope(const LevelSet<3>& psi, int plane) {
  constexpr int per_cell = 7;
  const PolarGrid<3>& g = psi.lattice.grid();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> in_cell(0, 1);
  double least = 1e9;
  for (int radial = 0; radial < g.cells[0]; ++radial)
    for (int column = 0; column < g.cells[1]; ++column)
      for (int line = 0; line < 8; ++line) {
        const double x = in_cell(random), y = in_cell(random);
        for (int axial = 0; axial < g.cells[2]; ++axial)
          for (int k = 0; k < per_cell; ++k) {
            const std::array<int, 3> cell{radial, column, axial};
            const double low = double(k) / per_cell, high = double(k + 1) / per_cell;
            const double rise = at(psi, cell, {x, y, high}) - at(psi, cell, {x, y, low});
            least = std::min(least, (axial >= plane ? rise : -rise) / ((high - low) * g.axial_size()));
          }
      }
  return least;
}

TEST(ControlPoints, BoundTheLevelSetAndGiveItBack) {
  std::mt19937 random(2);
  for (const int of_degree : {1, 2}) {
    const Lattice<3> lattice(grid(), of_degree);
    const LevelSet<3> psi{lattice, random_field(lattice.n_nodes(), random)};
    const auto points = control_points(psi);
    const auto again = of_control_points(lattice, points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(again.values[i], psi.values[i], 1e-12);
    const LevelSet<3> net{lattice, points};
    for (int cell = 0; cell < lattice.grid().n_cells(); cell += 7) {
      const auto around = net.cell_values(cell);
      const auto [low, high] = std::ranges::minmax(around);
      for (const Vec<3> xi : {Vec<3>{0.3, 0.9, 0.6}, {0.1, 0.5, 0.2}, {0.77, 0.2, 0.9}}) {
        const double value = at(psi, lattice.grid().cell_position(cell), xi);
        EXPECT_GE(value, low);
        EXPECT_LE(value, high);
      }
    }
  }
}

TEST(Mould, AMouldedShapeRisesAlongEveryLineAwayFromThePartingPlane) {
  for (const int of_degree : {1, 2})
    for (const double draft : {0.0, 3.0})
      for (const int plane : {0, 2, 6}) {
        const Lattice<3> lattice(grid(), of_degree);
        const double slope = std::tan(draft * degree);
        const ProtectedBands<3> limits(lattice, bands_with({plane * 0.02, slope}));
        const auto psi = shape_on(lattice);
        const auto kept = limits.keep(psi);
        EXPECT_GE(least_slope(kept, plane), slope - 1e-9);
        EXPECT_LT(least_slope(psi, plane), -0.5);
        EXPECT_LT(material_measure(kept), material_measure(psi));
        const auto again = limits.keep(kept);
        for (std::size_t i = 0; i < kept.values.size(); ++i)
          ASSERT_EQ(again.values[i], kept.values[i]) << i << ' ' << of_degree << ' ' << draft << ' ' << plane;
        const auto clipped = limits.clip(kept);
        for (std::size_t i = 0; i < kept.values.size(); ++i)
          EXPECT_NEAR(clipped.values[i], kept.values[i], 1e-3 * grid().resolution());
      }
}

TEST(AxialAngles, AreThoseOfAConeAndASphere) {
  const Lattice<3> lattice(grid(), 2);
  const auto full = make_level_set<3>(lattice, std::span<const Circle>{});
  const double angle = 5 * degree;
  const auto cone =
      with_hole(full, TaperedHole{0.27, 0.26, {{0.0, 0.02}, {0.12, 0.02 + 0.12 * std::tan(angle)}}});
  const auto surface = material_surface(cone, 2, 2);
  EXPECT_NEAR(smallest_draft(surface, 0).angle, angle, 0.6 * degree);
  EXPECT_NEAR(smallest_draft(surface, 0.12).angle, -angle, 0.6 * degree);
  EXPECT_NEAR(largest_overhang(surface, SideFace::smaller_z).angle, -angle, 0.6 * degree);
  EXPECT_NEAR(largest_overhang(surface, SideFace::larger_z).angle, angle, 0.6 * degree);
  const auto ball = material_surface(with_hole(full, Sphere{0.27, 0.26, 0.06, 0.03}), 2, 2);
  EXPECT_GT(largest_overhang(ball, SideFace::smaller_z).angle, 75 * degree);
  const auto overhang = largest_overhang(ball, SideFace::smaller_z).place;
  EXPECT_NEAR(overhang[2], 0.09, 0.003);
  EXPECT_NEAR(largest_overhang(ball, SideFace::larger_z).place[2], 0.03, 0.003);
  EXPECT_NEAR(overhang[0], 0.27, 0.01);
}

/// Measured on triangles, whose vertices keep a small distance from the nodes.
TEST(Mould, TheSurfaceHasTheDraft) {
  const Lattice<3> lattice(grid(), 2);
  for (const double draft : {0.0, 2.0, 5.0}) {
    const ProtectedBands<3> limits(lattice, bands_with({0.04, std::tan(draft * degree)}));
    const auto surface = material_surface(limits.keep(shape_on(lattice)), 2, 2);
    const double found = smallest_draft(surface, 0.04).angle / degree;
    EXPECT_GT(found, 0.75 * draft - 0.01);
    EXPECT_LT(found, 1.05 * draft + 0.01);
  }
}

TEST(Mould, AnExtrudedShapeNeedsNoChangeWithoutDraft) {
  const Lattice<3> lattice(grid(), 2);
  const ProtectedBands<3> limits(lattice, bands_with({0.06, 0}));
  const auto psi = limits.clip(make_level_set<3>(lattice, std::vector<Circle>{{0.26, 0.2, 0.02}}));
  EXPECT_EQ(limits.keep(psi).values, psi.values);
}

TEST(Mould, CasesNeedAPlaneBetweenCellsAndThreeDimensions) {
  const auto problem = [](const std::string& text) {
    const CaseResult result = parse_case(text, "case.toml");
    return result.value ? std::string() : result.problems.front().problem;
  };
  const std::string wheel = "[wheel]\ndimension = 3\nwidth = 0.12\n[grid]\naxial_cells = 6\n[optimizer]\n",
                    made = "made = \"moulded\"\n";
  EXPECT_EQ(problem(wheel + made + "draft = 2\nparting_plane = 0.08\n"), "");
  EXPECT_EQ(problem(wheel + made + "parting_plane = 0.07\n"), "no plane between cells lies at 0.07 m");
  EXPECT_EQ(problem(wheel + "draft = 2\n"), "the wheel is not moulded");
  EXPECT_EQ(problem("[optimizer]\n" + made), "a 2D wheel has one section");
  EXPECT_NE(problem(wheel + made + "draft = 60\n"), "");
}

/// A cone narrows towards z = 0: it comes out of a mould that parts there, and not of one that parts at its
/// wide end.
TEST(MadeWheel, HasTheSmallestDraftAndThePartingPlaneOfItsCase) {
  Case c;
  c.wheel.dimension = 3;
  c.wheel.width = 0.12;
  c.grid.axial_cells = 6;
  c.optimizer.made = Manufacture::moulded;
  c.optimizer.draft = 3 * degree;
  const auto full = make_level_set<3>(Lattice<3>(grid(), 2), std::span<const Circle>{});
  const double angle = 5 * degree;
  const auto cone =
      with_hole(full, TaperedHole{0.27, 0.26, {{0.0, 0.02}, {0.12, 0.02 + 0.12 * std::tan(angle)}}});
  for (const double plane : {0.0, 0.12}) {
    c.optimizer.parting_plane = plane;
    const MadeWheel made = *made_wheel<3>(c, cone);
    EXPECT_EQ(made.how, "moulded");
    EXPECT_NEAR(made.mould->parting_plane, plane, 1e-12);
    EXPECT_EQ(made.mould->draft, c.optimizer.draft);
    EXPECT_NEAR(made.mould->smallest.angle, plane == 0 ? angle : -angle, 0.6 * degree);
    EXPECT_EQ(making_warning(made).empty(), plane == 0);
  }
  c.optimizer.parting_plane.reset();
  EXPECT_NEAR(made_wheel<3>(c, full)->mould->parting_plane, 0.06, 1e-12);
  EXPECT_EQ(making_warning(*made_wheel<3>(c, full)), "");  // without holes
}

TEST(MadeWheel, IsNamedAsInItsCase) {
  const auto full = make_level_set<3>(Lattice<3>(grid(), 2), std::span<const Circle>{});
  Case c;
  c.wheel.dimension = 3;
  for (const auto& [made, name] : {std::pair(Manufacture::free, "free"),
                                   {Manufacture::extruded, "extruded"},
                                   {Manufacture::turned, "turned"}}) {
    c.optimizer.made = made;
    const MadeWheel wheel = *made_wheel<3>(c, full);
    EXPECT_EQ(wheel.how, name);
    EXPECT_FALSE(wheel.mould);
    EXPECT_EQ(sentence(wheel).empty(), made == Manufacture::free);
  }
}

TEST(Mould, EveryStageKeepsIt) {
  std::mt19937 random(5);
  const Lattice<3> lattice(grid(), 2);
  const int plane = 2;
  const double slope = std::tan(2 * degree);
  for (const ShapeSpace space : {ShapeSpace::spline, ShapeSpace::nodal}) {
    EvolutionOptions options{
        .velocity = {ExtensionKind::h1, 2}, .smoothing = 0.1, .bands = bands_with({plane * 0.02, slope})};
    options.space = space;
    const Evolver<3> evolver(lattice, options);
    const auto check = [&](const LevelSet<3>& psi) { EXPECT_GE(least_slope(psi, plane), slope - 1e-9); };
    LevelSet<3> psi = evolver.keep_bands(shape_on(lattice));
    const double before = material_measure(psi);
    const auto velocity = evolver.deformations().speeds(
        psi, evolver.deformations().representative(
                 random_field(lattice.n_nodes() * evolver.deformations().n_components(), random)));
    psi = *evolver.move(psi, velocity, 0.7 * lattice.grid().resolution());
    check(psi);
    psi = *evolver.redistance(psi);
    check(psi);
    psi = *evolver.smooth(psi);
    check(psi);
    psi = evolver.with_measure(psi, before, 1)->shape;
    check(psi);
    EXPECT_NEAR(material_measure(psi) / before, 1, 1e-5);
    psi = evolver.with_features(psi, {.wall = 0.02, .gap = 0.02, .radius = 0.008});
    check(psi);
  }
}

/// The kept shape after a small deformation has the edges that the motion with followers predicts, to second
/// order; the motion without them does not predict it.
TEST(Mould, TheMotionOfTheKeptShapePassesTheTaylorTest) {
  const Lattice<3> lattice(grid(), 2);
  const auto round_holes =
      make_level_set<3>(lattice, std::vector<Circle>{{0.252, 0.1, 0.016}, {0.281, 0.36, 0.018}});
  for (const Mould& mould :
       {Mould{0, std::tan(2 * degree)}, Mould{0.04, std::tan(2 * degree)}, Mould{0.06, 0}}) {
    SCOPED_TRACE(mould.slope);
    testing::expect_taylor_order_of_kept_shapes(bands_with(mould), round_holes, 1e-3);
  }
}

}  // namespace
}  // namespace wheelwright
