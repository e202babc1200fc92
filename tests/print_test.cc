// Wheels that can be printed layer by layer, and stay so.

#include "wheelwright/shape/geometry/print.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/made_shapes.h"
#include "wheelwright/case/read.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/evolution/printed_shapes.h"
#include "wheelwright/shape/evolution/spline_level_set.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/shapes.h"
#include "wheelwright/shape/surface/axial_angles.h"

namespace wheelwright {
namespace {

constexpr double degree = std::numbers::pi / 180;

PolarGrid<3> grid(int layers) { return {0.20, 0.34, 0.12, 12, {14, 12, layers}}; }

LevelSet<3> full(const Lattice<3>& lattice) { return make_level_set<3>(lattice, std::span<const Circle>{}); }

Bands bands_with(const Print& print) {
  return {.rim = {0.01, 1}, .tread = {0.02, 1}, .between = {}, .mould = {}, .print = print};
}

Print printed(double overhang, SideFace plate = SideFace::smaller_z) {
  return {plate, std::tan(overhang * degree)};
}

/// Shapes that need support: holes without any symmetry, a cone, a ball, a hole that ends below a flat roof,
/// grooves in both side faces, a leaning hole.
std::vector<LevelSet<3>> shapes_on(const Lattice<3>& lattice) {
  auto several = make_level_set<3>(lattice, std::vector<Circle>{{0.24, 0.1, 0.016}, {0.30, 0.4, 0.014}});
  several = with_hole(std::move(several), Sphere{0.27, 0.26, 0.052, 0.027});
  several = with_hole(std::move(several), Groove{0.283, 0.311, 0, 0.021, 0.007});
  const std::vector<std::array<double, 2>> roof{{0.0, 0.045}, {0.06, 0.045}, {0.061, -0.02}, {0.12, -0.02}};
  auto grooves = with_hole(full(lattice), Groove{0.225, 0.311, 0, 0.05, 0.007});
  grooves = with_hole(std::move(grooves), Groove{0.225, 0.311, 0.12, 0.04, 0.007});
  auto leaning = full(lattice);
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const Vec<3> p = lattice.polar_point(node);
    const double x = p[0] * std::cos(p[1] - 0.26) - 0.25 - 0.4 * p[2], y = p[0] * std::sin(p[1] - 0.26);
    leaning.values[node] = 0.025 - std::hypot(x, y);
  }
  return {several,
          with_hole(full(lattice), TaperedHole{0.27, 0.26, {{0.0, 0.045}, {0.12, -0.05}}}),
          with_hole(full(lattice), Sphere{0.27, 0.26, 0.06, 0.045}),
          with_hole(full(lattice), TaperedHole{0.27, 0.26, roof}),
          grooves,
          leaning};
}

double overhang(const LevelSet<3>& shape, SideFace plate = SideFace::smaller_z) {
  return largest_overhang(material_surface(shape, 2, 2), plate).angle / degree;
}

/// Allowed by the grid [degrees].
double allowed(const PolarGrid<3>& grid, const Print& print) {
  return std::atan(slope_on(grid, print)) / degree;
}

LevelSet<3> upside_down(const LevelSet<3>& shape) {
  LevelSet<3> result = shape;
  for (int node = 0; node < shape.lattice.n_nodes(); ++node) {
    auto place = shape.lattice.node_position(node);
    place[2] = shape.lattice.nodes()[2] - 1 - place[2];
    result.values[shape.lattice.node_index(place)] = shape.values[node];
  }
  return result;
}

/// Whether every node in a hole is connected by nodes in holes with the side face z = width.
bool all_holes_open_upwards(const LevelSet<3>& shape) {
  const auto& lattice = shape.lattice;
  std::vector<bool> reached(lattice.n_nodes());
  std::vector<int> next;
  const auto reach = [&](int node) {
    if (reached[node] || shape.values[node] <= 0) return;
    reached[node] = true;
    next.push_back(node);
  };
  for (int node = 0; node < lattice.n_nodes(); ++node)
    if (lattice.node_position(node)[2] == lattice.nodes()[2] - 1) reach(node);
  while (!next.empty()) {
    const auto place = lattice.node_position(next.back());
    next.pop_back();
    for (int d = 0; d < 3; ++d)
      for (const int to : {-1, 1}) {
        auto beside = place;
        beside[d] += to;
        if (d == 1 || (beside[d] >= 0 && beside[d] < lattice.nodes()[d])) reach(lattice.node_index(beside));
      }
  }
  for (int node = 0; node < lattice.n_nodes(); ++node)
    if (shape.values[node] > 0 && !reached[node]) return false;
  return true;
}

/// Between the nodes, where a level set of degree 2 only interpolates its spline, and on triangles.
TEST(Print, TheSurfaceHangsOverByNoMoreThanAllowedAndHolesOpenUpwards) {
  for (const auto& [layers, asked] : {std::pair(6, 45.0), {12, 30.0}, {12, 0.0}}) {
    const Lattice<3> lattice(grid(layers), 2);
    const Print print = printed(asked);
    const double tolerance = asked == 0 ? 0.01 : 3;
    const ProtectedBands<3> limits(lattice, bands_with(print));
    for (const auto& shape : shapes_on(lattice)) {
      const auto kept = limits.keep(shape);
      EXPECT_LT(overhang(kept), allowed(lattice.grid(), print) + tolerance) << layers << ' ' << asked;
      EXPECT_TRUE(all_holes_open_upwards(kept)) << layers << ' ' << asked;
      EXPECT_EQ(limits.keep(kept).values, kept.values);
    }
  }
}

TEST(Print, TheShapesOfTheseTestsNeedSupport) {
  const Lattice<3> lattice(grid(6), 2);
  const ProtectedBands<3> limits(lattice, bands_with(printed(30)));
  const auto shapes = shapes_on(lattice);
  for (std::size_t k = 0; k + 1 < shapes.size(); ++k) EXPECT_GT(overhang(limits.clip(shapes[k])), 75) << k;
  EXPECT_FALSE(all_holes_open_upwards(shapes[2]));
}

TEST(Print, ALargerOverhangKeepsMoreMaterial) {
  const Lattice<3> lattice(grid(12), 2);
  const auto ball = with_hole(full(lattice), Sphere{0.27, 0.26, 0.06, 0.045});
  double before = 0;
  for (const double asked : {0.0, 15.0, 30.0, 45.0}) {
    const ProtectedBands<3> limits(lattice, bands_with(printed(asked)));
    const double measure = material_measure(limits.keep(ball));
    EXPECT_GT(measure, before);
    EXPECT_LT(measure, material_measure(ball));
    before = measure;
  }
}

TEST(Print, ShapesThatFitAreNotChanged) {
  for (const int of_degree : {1, 2}) {
    const Lattice<3> lattice(grid(12), of_degree);
    const ProtectedBands<3> limits(lattice, bands_with(printed(30)));
    const auto widening = TaperedHole{0.265, 0.26, {{0.0, 0.02}, {0.12, 0.05}}},
               narrowing = TaperedHole{0.265, 0.26, {{0.0, 0.04}, {0.12, 0.032}}};
    for (const auto& shape :
         {full(lattice), make_level_set<3>(lattice, std::vector<Circle>{{0.26, 0.2, 0.02}}),
          with_hole(full(lattice), widening), with_hole(full(lattice), narrowing)}) {
      const auto clipped = limits.clip(shape);
      EXPECT_EQ(limits.keep(clipped).values, clipped.values);
    }
  }
}

/// Grooves in the upper face with a fillet need no support. Their edges move by little more than those of
/// their spline, whose knots are the vertices; a deeper change would be one by the condition of prints.
TEST(Print, GroovesInTheUpperFaceKeepTheirEdges) {
  for (const int layers : {6, 12}) {
    const Lattice<3> lattice(grid(layers), 2);
    const ProtectedBands<3> limits(lattice, bands_with(printed(26.5)));
    const double cell = lattice.grid().resolution();
    for (const double depth : {0.04, 0.06, 0.066, 0.08}) {
      const auto groove = limits.clip(with_hole(full(lattice), Groove{0.222, 0.318, 0.12, depth, 0.02}));
      ASSERT_TRUE(rises_from_the_plate(groove, SideFace::smaller_z));
      EXPECT_FALSE(rises_from_the_plate(groove, SideFace::larger_z));
      const auto kept = limits.keep(groove), spline = spline_level_set(spline_coefficients(groove));
      for (int node = 0; node < lattice.n_nodes(); ++node)
        if (std::abs(groove.values[node]) < 0.5 * cell) {
          ASSERT_NEAR(kept.values[node], groove.values[node], 0.2 * cell) << layers << ' ' << depth;
          ASSERT_NEAR(kept.values[node], spline.values[node], 0.25 * cell) << layers << ' ' << depth;
        }
      EXPECT_TRUE(all_holes_open_upwards(kept));
      EXPECT_LT(overhang(kept), allowed(lattice.grid(), printed(26.5)));
      EXPECT_EQ(limits.keep(kept).values, kept.values);
    }
  }
}

TEST(Print, OnTheOtherSideFaceItIsTheMirrorImage) {
  const Lattice<3> lattice(grid(6), 2);
  const ProtectedBands<3> below(lattice, bands_with(printed(30))),
      above(lattice, bands_with(printed(30, SideFace::larger_z)));
  for (const auto& shape : shapes_on(lattice)) {
    const auto coefficients = spline_coefficients(shape), kept = below.keep_design(coefficients),
               other = upside_down(above.keep_design(upside_down(coefficients)));
    for (std::size_t i = 0; i < kept.values.size(); ++i)
      ASSERT_NEAR(other.values[i], kept.values[i], 1e-9 * lattice.grid().resolution());
    EXPECT_NE(kept.values, coefficients.values);
  }
}

TEST(Print, EveryStageKeepsIt) {
  std::mt19937 random(5);
  const Lattice<3> lattice(grid(12), 2);
  const Print print = printed(40);
  for (const ShapeSpace space : {ShapeSpace::spline, ShapeSpace::nodal}) {
    EvolutionOptions options{
        .velocity = {ExtensionKind::h1, 2}, .smoothing = 0.1, .bands = bands_with(print)};
    options.space = space;
    const Evolver<3> evolver(lattice, options);
    const auto check = [&](const LevelSet<3>& psi, const char* stage) {
      EXPECT_LT(overhang(psi), allowed(lattice.grid(), print) + 5) << stage;
      EXPECT_TRUE(all_holes_open_upwards(psi)) << stage;
    };
    LevelSet<3> psi = evolver.keep_bands(shapes_on(lattice)[2]);
    const double before = material_measure(psi);
    std::vector<double> load(lattice.n_nodes() * evolver.deformations().n_components());
    for (double& x : load) x = std::normal_distribution<double>()(random);
    const auto velocity = evolver.deformations().speeds(psi, evolver.deformations().representative(load));
    psi = *evolver.move(psi, velocity, 0.7 * lattice.grid().resolution());
    check(psi, "move");
    psi = *evolver.redistance(psi);
    check(psi, "redistance");
    psi = *evolver.smooth(psi);
    check(psi, "smooth");
    psi = evolver.with_measure(psi, before, 1)->shape;
    check(psi, "with_measure");
    EXPECT_NEAR(material_measure(psi) / before, 1, 1e-5);
    psi = evolver.with_features(psi, {.wall = 0.02, .gap = 0.02, .radius = 0.008});
    check(psi, "with_features");
  }
}

/// The kept shape after a small deformation has the edges that the motion with followers predicts, to second
/// order; the motion without them does not predict it. The wheel has no symmetry.
TEST(Print, TheMotionOfTheKeptShapePassesTheTaylorTest) {
  const Lattice<3> lattice(grid(6), 2);
  for (const Print& print : {printed(0), printed(25), printed(45, SideFace::larger_z)}) {
    SCOPED_TRACE(print.slope);
    auto holes = with_hole(full(lattice), Sphere{0.262, 0.2, 0.045, 0.045});
    holes = with_hole(std::move(holes), TaperedHole{0.281, 0.39, {{0.0, 0.02}, {0.07, 0.015}, {0.12, 0.02}}});
    testing::expect_taylor_order_of_kept_shapes(bands_with(print), holes, 1e-4);
  }
}

TEST(Print, CasesNeedThreeDimensionsAndAnAngle) {
  const auto problem = [](const std::string& text) {
    const CaseResult result = parse_case(text, "case.toml");
    return result.value ? std::string() : result.problems.front().problem;
  };
  const std::string wheel = "[wheel]\ndimension = 3\nwidth = 0.12\n[grid]\naxial_cells = 6\n[optimizer]\n",
                    made = "made = \"printed\"\n";
  EXPECT_EQ(problem(wheel + made), "");
  EXPECT_EQ(problem(wheel + made + "overhang = 0\nstands_on = \"larger_z\"\n"), "");
  EXPECT_EQ(problem(wheel + "overhang = 45\n"), "the wheel is not printed");
  EXPECT_EQ(problem(wheel + "stands_on = \"larger_z\"\n"), "the wheel is not printed");
  EXPECT_EQ(problem(wheel + made + "draft = 2\n"), "the wheel is not moulded");
  EXPECT_EQ(problem("[optimizer]\n" + made), "a 2D wheel has one section");
  EXPECT_NE(problem(wheel + made + "overhang = 80\n"), "");
  EXPECT_NE(problem(wheel + made + "overhang = -1\n"), "");
  EXPECT_NE(problem(wheel + made + "stands_on = \"rim\"\n"), "");
}

/// A cone narrows towards z = 0: it hangs over where the wheel stands on its wide end.
TEST(MadeWheel, HasTheLargestOverhangAndTheSideFaceOfItsCase) {
  Case c;
  c.wheel.dimension = 3;
  c.wheel.width = 0.12;
  c.grid.axial_cells = 6;
  c.optimizer.made = Manufacture::printed;
  c.optimizer.overhang = 5 * degree;
  const Lattice<3> lattice(grid(6), 2);
  const double angle = 10 * degree;
  const auto cone =
      with_hole(full(lattice), TaperedHole{0.27, 0.26, {{0.0, 0.02}, {0.12, 0.02 + 0.12 * std::tan(angle)}}});
  for (const SideFace plate : {SideFace::smaller_z, SideFace::larger_z}) {
    c.optimizer.stands_on = plate;
    const MadeWheel made = *made_wheel<3>(c, cone);
    EXPECT_EQ(made.how, "printed");
    EXPECT_NEAR(made.print->plate, plate == SideFace::smaller_z ? 0 : 0.12, 1e-12);
    EXPECT_NEAR(made.print->overhang, 5 * degree, 1e-12);
    EXPECT_NEAR(made.print->largest.angle, plate == SideFace::smaller_z ? -angle : angle, 1 * degree);
    EXPECT_EQ(making_warning(made).empty(), plate == SideFace::smaller_z);
  }
  EXPECT_EQ(making_warning(*made_wheel<3>(c, full(lattice))), "");  // without holes
}

}  // namespace
}  // namespace wheelwright
