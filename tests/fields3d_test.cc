#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <set>

#include "wheelwright/mechanics/state/axle_height.h"
#include "wheelwright/mechanics/state/ground_frame.h"
#include "wheelwright/output/page/shown_ground.h"
#include "wheelwright/output/report/lit_wheel.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/surface_vtp.h"
#include "wheelwright/output/report/tread_contact.h"
#include "wheelwright/output/report/vtu.h"
#include "wheelwright/output/report/vtu_arrays.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/surface/check_surface.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

/// Without any symmetry: the holes change along the axle and lie across a sector face; there is friction.
RollingModel<3> asymmetric_model(int degree) {
  RollingModel<3> model;
  model.grid = {0.20, 0.34, 0.10, 7, {7, 8, 3}};
  model.degree = degree;
  model.materials = Material{60e6, 0.3};
  model.contact.friction = 0.5;
  model.contact_points = 3;
  model.load = 2000;
  model.horizontal_force = 60;
  model.torque = 70;
  model.n_positions = 2;
  return model;
}

LevelSet<3> asymmetric_shape(const PolarGrid<3>& grid) {
  LevelSet<3> psi{Lattice<3>(grid, 1), {}};
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<3> p = psi.lattice.polar_point(i), x = cartesian<3>(p);
    double value = -1;
    for (int image = -1; image <= 1; ++image) {
      const Vec<3> c = cartesian<3>({0.257, 0.07 + image * grid.sector_angle(), 0});
      value = std::max(value, 0.024 + 0.08 * p[2] - std::hypot(x[0] - c[0], x[1] - c[1]));
    }
    psi.values.push_back(value);
  }
  return psi;
}

struct Solved {
  std::shared_ptr<const StateSolver<3>> solver;
  std::shared_ptr<const State<3>> state;
};

const Solved& solved() {
  static const Solved result = [] {
    const auto solver = make_solver(asymmetric_model(1));
    EXPECT_TRUE(solver);
    const auto shape = asymmetric_shape((*solver)->model().grid);
    const auto states = (*solver)->states(shape, (*solver)->all_positions(), Interrupt());
    EXPECT_TRUE(states) << states.failure().detail;
    return Solved{*solver, *states};
  }();
  return result;
}

/// A displacement that is linear in x, y and z.
const Mat<3> gradient{{{2e-3, -7e-3, 1e-3}, {1.5e-3, 4e-3, -2e-3}, {3e-3, 5e-3, -1e-3}}};

Vec<3> linear(const Vec<3>& x) {
  Vec<3> u{1e-3, -2e-3, 5e-4};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) u[i] += gradient[i][j] * x[j];
  return u;
}

RingField linear_field(const Lattice<3>& lattice) {
  RingField field{3, {}};
  for (int sector = 0; sector < lattice.grid().n_sectors; ++sector)
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      Vec<3> p = lattice.polar_point(node);
      p[1] += sector * lattice.grid().sector_angle();
      for (const double value : linear(cartesian<3>(p))) field.values.push_back(value);
    }
  return field;
}

// Isoparametric elements hold linear displacements exactly. The components are xx, yy, zz, xy, yz, xz.
TEST(StressField3D, IsExactForLinearDisplacements) {
  for (const int degree : {1, 2}) {
    const auto model = asymmetric_model(degree);
    const auto domain = cut_domain(asymmetric_shape(model.grid), 2);
    ASSERT_TRUE(domain);
    const Material material = *model.materials.at_tread().isotropic();
    const auto shear = [&](int i, int j) { return material.mu() * (gradient[i][j] + gradient[j][i]); };
    const double mean = material.lambda() * (gradient[0][0] + gradient[1][1] + gradient[2][2]);
    const std::array<double, 6> expected{mean + shear(0, 0), mean + shear(1, 1), mean + shear(2, 2),
                                         shear(0, 1),        shear(1, 2),        shear(0, 2)};
    const RingField stress = stress_field(model, *domain, linear_field(displacement_lattice(model)));
    std::size_t n = 0;
    for (std::size_t k = 0; k < stress.values.size(); ++k) {
      if (std::isnan(stress.values[k])) continue;
      EXPECT_NEAR(stress.values[k], expected[k % 6], 1e-8 * std::abs(expected[0])) << k % 6;
      ++n;
    }
    EXPECT_GT(n, 0.8 * stress.values.size());
    // sqrt(3/2 s:s), with s the deviator.
    double square = 0;
    const double pressure = (expected[0] + expected[1] + expected[2]) / 3;
    for (int k = 0; k < 3; ++k)
      square += std::pow(expected[k] - pressure, 2) + 2 * std::pow(expected[3 + k], 2);
    EXPECT_NEAR(von_mises_field(stress).scalar(expected), std::sqrt(1.5 * square), 1e-9 * std::sqrt(square));
  }
}

TEST(ContactPoints3D, CarryTheLoadAndLieOnTheTread) {
  const auto& [solver, state] = solved();
  const RollingModel<3>& model = solver->model();
  std::array<double, 2> down{}, along{};
  for (const ContactPoint& p : contact_points(*solver, *state)) {
    down[p.position] += p.weight * p.pressure;
    along[p.position] += p.weight * p.friction;
    EXPECT_LT(std::abs(p.z), 0.5 * model.grid.width);
    EXPECT_NEAR(p.x, model.grid.outer_radius * std::sin(p.azimuth), 5e-3);
  }
  for (int position = 0; position < 2; ++position) {
    EXPECT_NEAR(down[position], model.load, 1e-9 * model.load);
    EXPECT_NEAR(along[position], -model.horizontal_force, 1e-8 * model.load);
  }
}

TEST(TreadContact3D, IsTheWholeTreadInLinesAndCarriesTheLoad) {
  const auto& [solver, state] = solved();
  const PolarGrid<3>& grid = solver->model().grid;
  const auto treads = all_tread_contacts(*solver, *state);
  const auto points = contact_points(*solver, *state);
  ASSERT_EQ(treads.size(), 2u);
  for (int position = 0; position < 2; ++position) {
    const double ground = position * grid.sector_angle() / 2;
    double area = 0, last_z = -1;
    std::size_t lines = 0;
    Vec<3> force{};
    std::multimap<double, const TreadContactPoint<3>*> by_z;
    for (const auto& p : treads[position]) {
      area += p.weight;
      for (int d = 0; d < 3; ++d) force[d] += p.weight * p.traction[d];
      if (p.position[2] != last_z) {
        EXPECT_GT(p.position[2], last_z);
        last_z = p.position[2];
        ++lines;
      }
    }
    EXPECT_EQ(lines, 3u * 2u);             // degree + 1 points on each of the cells along the axle
    const double n = grid.ring_columns();  // cells of degree 1
    EXPECT_NEAR(area, 2 * n * std::sin(pi / n) * grid.outer_radius * grid.width, 1e-12);
    const Vec<3> in_ground_frame = rotated<3>(force, -ground);
    EXPECT_NEAR(in_ground_frame[0], -2000, 1e-6);
    EXPECT_NEAR(in_ground_frame[1], -60, 1e-4);
    // At the contact points it is what those show.
    for (const ContactPoint& q : points) {
      if (q.position != position) continue;
      const auto same = std::ranges::find_if(treads[position], [&](const auto& p) {
        const Vec<3> x = rotated<3>(p.position, -ground);
        return x[0] > 0 && std::abs(x[1] - q.x) < 1e-12 && std::abs(x[2] - 0.5 * grid.width - q.z) < 1e-12;
      });
      ASSERT_NE(same, treads[position].end());
      EXPECT_EQ(same->pressure, q.pressure);
      EXPECT_EQ(same->friction, q.friction);
      EXPECT_NEAR(same->gap, q.gap, 1e-12);
    }
  }
}

/// An array of a VTK file by its name, from the appended bytes.
template <class T>
std::vector<T> array_of(const std::string& file, const std::string& name) {
  const auto tag = file.find("Name=\"" + name + "\"");
  EXPECT_NE(tag, std::string::npos) << name;
  const auto offset = file.find("offset=\"", tag) + 8;
  const char* begin = file.data() + file.find("\n_") + 2 + std::strtoull(&file[offset], nullptr, 10);
  std::uint64_t size;
  std::memcpy(&size, begin, sizeof size);
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), begin + sizeof size, size);
  return values;
}

/// Fields of degree 2 at the points of a file: linear ones are exact there.
void expect_linear_displacement(const std::string& file) {
  const auto x = array_of<float>(file, "Points"), u = array_of<float>(file, "displacement_m");
  ASSERT_EQ(x.size(), u.size());
  for (std::size_t k = 0; k < x.size(); k += 3) {
    const Vec<3> expected = linear({x[k], x[k + 1], x[k + 2]});
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(u[k + d], expected[d], 2e-6);
  }
}

TEST(VtuFile3D, HoldsCellsOfTheMaterialWithTheirFields) {
  const auto model = asymmetric_model(2);
  const auto psi = asymmetric_shape(model.grid);
  const Lattice<3> lattice = displacement_lattice(model);
  const std::vector<NamedField> fields{{"displacement", "m", linear_field(lattice)}};
  const std::string file = VtuMesh<3>(psi, lattice, 2).file(fields);
  expect_linear_displacement(file);
  const auto offsets = array_of<std::int32_t>(file, "offsets");
  const auto types = array_of<std::uint8_t>(file, "types");
  ASSERT_EQ(offsets.size(), types.size());
  std::map<int, int> count;
  for (std::size_t k = 0; k < types.size(); ++k) {
    const int corners = offsets[k] - (k == 0 ? 0 : offsets[k - 1]);
    EXPECT_EQ(corners, types[k] == vtk_hexahedron ? 8 : types[k] == vtk_wedge ? 6 : 4);
    ++count[types[k]];
  }
  EXPECT_EQ(count.size(), 3u);
  for (const float level : array_of<float>(file, "psi_m")) EXPECT_LE(level, 1e-3);
  const auto connectivity = array_of<std::int32_t>(file, "connectivity");
  EXPECT_EQ(static_cast<std::size_t>(offsets.back()), connectivity.size());
  EXPECT_EQ(3u * (1 + *std::ranges::max_element(connectivity)), array_of<float>(file, "Points").size());
}

/// A field that is 0 in some rows and 1 in the others has no other value anywhere, and one value in every
/// cell.
TEST(VtuFile3D, FieldsMayJumpBetweenRows) {
  const auto model = asymmetric_model(2);
  const auto psi = asymmetric_shape(model.grid);
  const Lattice<3> lattice = displacement_lattice(model);
  const std::size_t n_nodes = static_cast<std::size_t>(lattice.n_nodes()) * model.grid.n_sectors;
  std::vector<bool> is_odd_row(model.grid.cells[0], false);
  is_odd_row[1] = true;
  const std::vector<int> layer_of_row(is_odd_row.begin(), is_odd_row.end());
  const NamedField layer{
      "layer", "1", {1, std::vector<double>(n_nodes, 0), is_odd_row, std::vector<double>(n_nodes, 1)}};
  const std::string file = VtuMesh<3>(psi, lattice, 2, "m", layer_of_row).file({&layer, 1});
  const auto values = array_of<float>(file, "layer_1");
  const auto connectivity = array_of<std::int32_t>(file, "connectivity");
  const auto offsets = array_of<std::int32_t>(file, "offsets");
  std::set<float> all;
  int begin = 0;
  for (const int end : offsets) {
    for (int k = begin; k < end; ++k) EXPECT_EQ(values[connectivity[k]], values[connectivity[begin]]);
    all.insert(values[connectivity[begin]]);
    begin = end;
  }
  EXPECT_EQ(all, (std::set<float>{0, 1}));
}

TEST(VtpFile, HoldsAClosedSurfaceWithItsFields) {
  const auto model = asymmetric_model(2);
  const auto psi = asymmetric_shape(model.grid);
  const Lattice<3> lattice = displacement_lattice(model);
  const SurfaceMesh surface = material_surface(psi, 2, 2);
  const std::vector<NamedField> fields{{"displacement", "m", linear_field(lattice)}};
  const std::string file = surface_vtp(surface, lattice, fields);
  expect_linear_displacement(file);
  std::vector<Vec<3>> points;
  const auto x = array_of<float>(file, "Points");
  for (std::size_t k = 0; k < x.size(); k += 3) points.push_back({x[k], x[k + 1], x[k + 2]});
  std::vector<std::array<int, 3>> triangles;
  const auto corners = array_of<std::int32_t>(file, "connectivity");
  for (std::size_t k = 0; k < corners.size(); k += 3)
    triangles.push_back({corners[k], corners[k + 1], corners[k + 2]});
  const auto report = check_surface(points, triangles);
  ASSERT_TRUE(report) << report.failure().what;
  EXPECT_EQ(report->bodies, 1);
  EXPECT_EQ(report->handles(), 1 + 7);
  EXPECT_NEAR(report->volume, enclosed_volume(surface), 1e-5 * report->volume);
  EXPECT_EQ(array_of<std::uint8_t>(file, "part").size(), triangles.size());
}

// --- Lit pictures ----------------------------------------------------------------------------------------

constexpr Rgb red{200, 0, 0}, green{0, 200, 0};

LitBody square(double half, double z, const Rgb& colour) {
  return {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
          {{0, 1, 2}, {0, 2, 3}},
          std::vector<Rgb>(4, colour)};
}

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgb[3 * (std::size_t(y) * image.width + x)];
  return {p[0], p[1], p[2]};
}

TEST(LitScene, NearerSurfacesHideThoseBehindInAnyOrder) {
  const Camera camera(0, 0, {}, 1);
  for (const bool first : {true, false}) {
    std::vector<LitBody> bodies{square(0.8, 0, red), square(0.4, 0.1, green)};
    if (first) std::swap(bodies[0], bodies[1]);
    const Image image = lit_image(bodies, camera, 100);
    EXPECT_EQ(pixel(image, 2, 2), (std::array{255, 255, 255}));
    EXPECT_GT(pixel(image, 15, 15)[0], 100);
    EXPECT_LT(pixel(image, 15, 15)[1], 60);
    EXPECT_GT(pixel(image, 50, 50)[1], 100);
    EXPECT_LT(pixel(image, 50, 50)[0], 60);
  }
}

TEST(LitScene, CoversTheAreaOfTheProjectionWithoutGaps) {
  // Turned by 60 degrees a square is half as wide.
  const Image image = lit_image({square(0.8, 0, red)}, Camera(pi / 3, 0, {}, 1), 200);
  double covered = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) covered += pixel(image, x, y)[1] < 200;
  EXPECT_NEAR(covered / (200 * 200), 0.8 * 0.4, 5e-3);
  EXPECT_LT(pixel(image, 100, 100)[1], 60);
  // From behind there is nothing to see.
  const Image back = lit_image({square(0.8, 0, red)}, Camera(pi, 0, {}, 1), 50);
  EXPECT_EQ(pixel(back, 25, 25), (std::array{255, 255, 255}));
}

TEST(LitScene, LooksDownFromTheRight) {
  const Camera camera(0.5, 0.3, {0, 0, 0}, 2);
  EXPECT_GT(camera.seen({0, 1, 0})[1], 0.4);   // up is up
  EXPECT_GT(camera.seen({1, 0, 0})[0], 0.4);   // right is right
  EXPECT_GT(camera.seen({0, 0, 1})[2], 0.35);  // the viewer's side is in front
  EXPECT_GT(camera.seen({1, 0, 0})[2], 0.1);   // what lies on the right is nearer than what lies on the left
  EXPECT_GT(camera.seen({0, 1, 0})[2], 0.1);   // and the top is nearer than the bottom
}

TEST(LitWheel, StandsOnTheGroundAndNothingIsBelow) {
  const auto& [solver, state] = solved();
  const PositionFields<3> fields = position_fields(*solver, *state, 1);
  const PolarGrid<3>& grid = solver->model().grid;
  const SurfaceMesh surface = material_surface(asymmetric_shape(grid), 2, 1);
  const auto displacement =
      field_points(surface, fields.lattice).values({"displacement", "m", fields.displacement});
  for (const double magnification : {1.0, 20.0}) {
    DeformedPicture<3> picture{};
    picture.displacement = fields.displacement;
    picture.magnification = magnification;
    picture.contact_azimuth = fields.ground_azimuth;
    const auto points = standing_on_the_ground(
        displaced(surface.points, displacement, fields.lattice, picture), grid, fields.ground_azimuth);
    double lowest = 0;
    for (const Vec<3>& x : points) lowest = std::min(lowest, x[1]);
    EXPECT_NEAR(lowest, -grid.outer_radius, 2e-5);
  }
}

/// The ring about the peak of a turn stands where its point is drawn, also inside the material or behind it.
TEST(LitWheel, MarksTheProjectionOfAPeak) {
  const auto& [solver, state] = solved();
  const PositionFields<3> fields = position_fields(*solver, *state, 1);
  const PolarGrid<3>& grid = solver->model().grid;
  const SurfaceMesh surface = material_surface(asymmetric_shape(grid), 2, 1);
  DeformedPicture<3> picture{};
  picture.displacement = fields.displacement;
  picture.magnification = 2;  // all of it is in view
  picture.contact_azimuth = fields.ground_azimuth;
  picture.scalar = {"height", "m", vertical_field<3>(fields.displacement, fields.ground_azimuth)};
  const auto points = standing_on_the_ground(
      displaced(surface.points, field_points(surface, fields.lattice).values({"u", "m", fields.displacement}),
                fields.lattice, picture),
      grid, fields.ground_azimuth);
  picture.peak = DrawnPeak<3>{surface.points[0], 0.017};
  EXPECT_EQ(deformed_svg(surface, fields.lattice, picture).find("<circle"), std::string::npos);
  picture.is_peak_projected = true;
  std::vector<std::size_t> at_tread;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (std::hypot(surface.points[k][0], surface.points[k][1]) > 0.999 * grid.outer_radius)
      at_tread.push_back(k);
  for (const std::size_t k : {at_tread.front(), at_tread[at_tread.size() / 2], at_tread.back()}) {
    picture.peak = DrawnPeak<3>{surface.points[k], 0.017};
    const std::string whole = deformed_svg(surface, fields.lattice, picture);
    const std::string svg = whole.substr(std::min(whole.find("<circle"), whole.size()));  // after the bitmap
    static const std::regex ring("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"6\"");
    std::smatch match;
    const Vec<3> seen = wheel_camera(grid).seen(points[k]);
    ASSERT_TRUE(std::regex_search(svg, match, ring));
    EXPECT_NEAR(std::stod(match[1]), DeformedLayout::margin + 320 * (1 + seen[0]), 0.2);
    EXPECT_NEAR(std::stod(match[2]), DeformedLayout::top + 320 * (1 - seen[1]), 0.2);
    EXPECT_NE(svg.find("peak 17 mm"), std::string::npos);
    EXPECT_NE(svg.find("ring: its projection"), std::string::npos);
  }
}

// --- A wheel that leans ---------------------------------------------------------------------------------

struct Leaning {
  Solved solved;
  LevelSet<3> shape;
};

Leaning leaning(const Ground& ground) {
  RollingModel<3> model = asymmetric_model(1);
  model.torque = 0;
  model.horizontal_force = 0;
  model.camber = -0.04;
  model.lateral_force = 150;
  model.ground = ground;
  const auto solver = make_solver(model);
  EXPECT_TRUE(solver);
  auto shape = asymmetric_shape(model.grid);
  const auto states = (*solver)->states(shape, (*solver)->all_positions(), Interrupt());
  EXPECT_TRUE(states) << states.failure().detail;
  return {{*solver, *states}, std::move(shape)};
}

/// A place of the body frame in the frame of its ground, from the middle of the axle.
Vec<3> on_ground(const RollingModel<3>& model, double azimuth, Vec<3> x) {
  x[2] -= 0.5 * model.grid.width;
  return GroundFrame{-azimuth, model.camber}.to_ground<3>(x);
}

/// On flat ground the gap is the exact height of the displaced point; on a drum the linear one differs by the
/// square of the displacement over its radius. Tractions carry the load and the lateral force.
TEST(LeaningWheel, TreadContactIsThatOnTheLeaningGround) {
  for (const Ground& ground : {Ground(), Ground::drum(0.8)}) {
    const Leaning wheel = leaning(ground);
    const auto& [solver, state] = wheel.solved;
    const RollingModel<3>& model = solver->model();
    const double height = axle_height(model.grid, ground, model.camber);
    const auto treads = all_tread_contacts(*solver, *state);
    for (int position = 0; position < model.n_positions; ++position) {
      const double azimuth = solver->all_positions().grounds[position].azimuth(model.grid);
      Vec<3> force{};
      double nearest = 1;
      for (const auto& p : treads[position]) {
        const Vec<3> undeformed = on_ground(model, azimuth, p.position);
        nearest = std::min(nearest, ground.nearest({undeformed[1], height - undeformed[0]}).gap);
        if (p.pressure > 0 || ground.is_flat()) {
          const Vec<3> place = on_ground(model, azimuth, p.position + p.displacement);
          EXPECT_NEAR(p.gap, ground.nearest({place[1], height - place[0]}).gap,
                      ground.is_flat() ? 1e-12 : 2e-5);
        }
        force += p.weight * p.traction;
      }
      EXPECT_GT(nearest, 0);
      EXPECT_LT(nearest, 0.001);  // points are inside of the cells
      const Vec<3> in_frame = GroundFrame{-azimuth, model.camber}.to_ground<3>(force);
      EXPECT_NEAR(in_frame[0], -model.load, 1e-6);
      EXPECT_NEAR(in_frame[2], -model.lateral_force, 1e-6);
    }
  }
}

/// Also where displacements are magnified. An edge of the tread touches the ground.
TEST(LeaningWheel, IsDrawnOnItsGround) {
  for (const Ground& ground : {Ground(), Ground::drum(0.8)}) {
    const Leaning wheel = leaning(ground);
    const auto& [solver, state] = wheel.solved;
    const RollingModel<3>& model = solver->model();
    const PositionFields<3> fields = position_fields(*solver, *state, 1);
    const SurfaceMesh surface = material_surface(wheel.shape, 2, 1);
    const auto displacement =
        field_points(surface, fields.lattice).values({"displacement", "m", fields.displacement});
    const double height = axle_height(model.grid, ground, model.camber);
    for (const double magnification : {0.0, 1.0, 20.0}) {
      DeformedPicture<3> picture{};
      picture.displacement = fields.displacement;
      picture.magnification = magnification;
      picture.contact_azimuth = fields.ground_azimuth;
      picture.ground = fields.ground;
      picture.camber = fields.camber;
      double nearest = 1;
      for (const Vec<3>& x : displaced(surface.points, displacement, fields.lattice, picture)) {
        const Vec<3> place = on_ground(model, fields.ground_azimuth, x);
        nearest = std::min(nearest, height - place[0] - ground.height(place[1]));
      }
      EXPECT_NEAR(nearest, 0, 1e-4) << magnification;
      EXPECT_GT(nearest, -1e-9) << magnification;
    }
  }
}

/// The files for ParaView and the pages have the ground of the contact.
TEST(LeaningWheel, ItsGroundIsInFilesAndPages) {
  const Ground drum = Ground::drum(0.8);
  const Leaning wheel = leaning(drum);
  const auto& [solver, state] = wheel.solved;
  const RollingModel<3>& model = solver->model();
  const double height = axle_height(model.grid, drum, model.camber);
  const PositionFields<3> fields = position_fields(*solver, *state, 1);
  const auto shown = shown_ground(fields);
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->camber, model.camber);
  for (const auto& [along, up] : shown->outline) EXPECT_NEAR(up, drum.height(along) - height, 1e-15);
  const auto path = std::filesystem::temp_directory_path() / "wheelwright_leaning_ground.vtu";
  write_ground_vtu(path, model.grid, fields.ground_azimuth, fields.ground, fields.camber);
  std::ifstream stream(path, std::ios::binary);
  const std::string file((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::filesystem::remove(path);
  const auto x = array_of<float>(file, "Points");
  int on_top = 0;
  for (std::size_t k = 0; k < x.size(); k += 3) {
    const Vec<3> place = on_ground(model, fields.ground_azimuth, {x[k], x[k + 1], x[k + 2]});
    const double above = height - place[0] - drum.height(place[1]);
    EXPECT_LT(above, 1e-6);
    if (above > -1e-6) ++on_top;
    EXPECT_NEAR(std::abs(place[2]), 0.5 * model.grid.width + 0.1 * model.grid.outer_radius, 1e-6);
  }
  EXPECT_EQ(on_top, int(x.size()) / 6);
}

}  // namespace
}  // namespace wheelwright
