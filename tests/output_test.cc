#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <map>
#include <numbers>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "wheelwright/app/progress.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/files/output_error.h"
#include "wheelwright/output/report/colour_map.h"
#include "wheelwright/output/report/colour_scale.h"
#include "wheelwright/output/report/deformed_svg.h"
#include "wheelwright/output/report/mesh_svg.h"
#include "wheelwright/output/report/picture_polygon.h"
#include "wheelwright/output/report/pressure_csv.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/superlevels.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/output/report/tread_contact.h"
#include "wheelwright/output/report/vtu.h"
#include "wheelwright/run/checkpoints/history.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

constexpr double hole_radius = 0.04, mid_radius = 0.27;
const PolarGrid<2> wheel_grid{0.20, 0.34, 0.12, 16, {28, 24}};
const double material_area = pi * (0.34 * 0.34 - 0.2 * 0.2) - 16 * pi * hole_radius * hole_radius;

/// Sixteen holes, each across a sector face, `stretch` times longer radially than wide.
LevelSet<2> holes_level_set(int degree, double stretch) {
  const Lattice<2> lattice(wheel_grid, degree);
  LevelSet<2> psi{lattice, {}};
  for (int k = 0; k < lattice.n_nodes(); ++k) {
    const Vec<2> x = cartesian<2>(lattice.polar_point(k));
    double nearest = 1;
    for (int s = 0; s <= 1; ++s) {
      const double a = s * wheel_grid.sector_angle();
      const double along = x[0] * std::cos(a) + x[1] * std::sin(a) - mid_radius;
      const double across = -x[0] * std::sin(a) + x[1] * std::cos(a);
      nearest = std::min(nearest, std::hypot(along / stretch, across * stretch));
    }
    psi.values.push_back(hole_radius - nearest);
  }
  return psi;
}

/// The field x -> f(x) on the full ring.
template <class F>
RingField ring_field(const Lattice<2>& lattice, int components, F f) {
  RingField field{components, {}};
  for (int s = 0; s < lattice.grid().n_sectors; ++s) {
    for (int k = 0; k < lattice.n_nodes(); ++k) {
      Vec<2> polar = lattice.polar_point(k);
      polar[1] += s * lattice.grid().sector_angle();
      const auto value = f(cartesian<2>(polar));
      field.values.insert(field.values.end(), value.begin(), value.begin() + components);
    }
  }
  return field;
}

class OutputFolder : public testing::Test {
 protected:
  OutputFolder() {
    std::string name = (fs::temp_directory_path() / "wheelwright-output-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~OutputFolder() override { fs::remove_all(folder); }

  static std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path folder;
};

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (auto p = text.find(word); p != std::string::npos; p = text.find(word, p + word.size())) ++n;
  return n;
}

// --- VTU -----------------------------------------------------------------------------------------------

/// The number behind `name="` in a tag of a VTU file.
std::size_t vtu_number(const std::string& vtu, std::size_t tag, const std::string& name) {
  const auto begin = vtu.find(name + "=\"", tag) + name.size() + 2;
  return std::strtoull(&vtu[begin], nullptr, 10);
}

/// An array of a VTU file, the one whose tag holds this text: behind the XML its size, then its bytes.
template <class T>
std::vector<T> vtu_array(const std::string& vtu, const std::string& tag) {
  const auto begin = vtu.find('_', vtu.find("<AppendedData encoding=\"raw\">")) + 1 +
                     vtu_number(vtu, vtu.find(tag), "offset");
  std::uint64_t size;
  std::memcpy(&size, &vtu[begin], sizeof size);
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), &vtu[begin + sizeof size], size);
  return values;
}

struct DecodedMesh {
  std::vector<float> points;
  std::vector<std::int32_t> connectivity, offsets;

  explicit DecodedMesh(const std::string& vtu) {
    points = vtu_array<float>(vtu, "Name=\"Points\"");
    connectivity = vtu_array<std::int32_t>(vtu, "Name=\"connectivity\"");
    offsets = vtu_array<std::int32_t>(vtu, "Name=\"offsets\"");
  }

  double area() const {
    double twice = 0;
    for (std::size_t cell = 0; cell < offsets.size(); ++cell) {
      const int begin = cell == 0 ? 0 : offsets[cell - 1], n = offsets[cell] - begin;
      for (int k = 0; k < n; ++k) {
        const float *a = &points[3 * connectivity[begin + k]],
                    *b = &points[3 * connectivity[begin + (k + 1) % n]];
        twice += double(a[0]) * b[1] - double(a[1]) * b[0];
      }
    }
    return 0.5 * twice;
  }
};

class VtuFile : public OutputFolder {};

TEST_F(VtuFile, CellsCoverTheMaterialAndFieldsAreInterpolated) {
  for (int degree : {1, 2}) {
    const auto psi = holes_level_set(degree, 1.0);
    const Lattice<2> lattice(wheel_grid, 2);
    const std::vector<NamedField> fields{
        {"displacement", "m",
         ring_field(lattice, 2,
                    [](const Vec<2>& x) {
                      return std::array{0.5 * x[1], x[0] - 2 * x[1]};
                    })},
        {"von_mises", "Pa", ring_field(lattice, 1, [](const Vec<2>& x) { return std::array{3e6 * x[0]}; })}};
    VtuMesh<2>(psi, lattice, 4).write(folder / "shape.vtu", fields);
    const std::string vtu = content(folder / "shape.vtu");
    const DecodedMesh mesh(vtu);
    double contour_area = 0;
    for (const Contour& c : material_contours(psi, 4)) contour_area += signed_area(c);
    EXPECT_NEAR(mesh.area() / contour_area, 1, 2e-5);
    EXPECT_NEAR(mesh.area() / material_area, 1, degree == 1 ? 2e-3 : 1e-4);

    const auto u = vtu_array<float>(vtu, "Name=\"displacement_m\"");
    const auto stress = vtu_array<float>(vtu, "Name=\"von_mises_Pa\"");
    const auto level = vtu_array<float>(vtu, "Name=\"psi_m\"");
    ASSERT_EQ(u.size(), mesh.points.size());
    ASSERT_EQ(3 * stress.size(), mesh.points.size());
    for (std::size_t k = 0; k < stress.size(); ++k) {
      const double x = mesh.points[3 * k], y = mesh.points[3 * k + 1];
      const double tolerance = degree == 2 ? 1e-6 : 3e-5;
      EXPECT_NEAR(u[3 * k], 0.5 * y, tolerance);
      EXPECT_NEAR(u[3 * k + 1], x - 2 * y, 3 * tolerance);
      EXPECT_EQ(u[3 * k + 2], 0);
      EXPECT_NEAR(stress[k], 3e6 * x, 3e6 * tolerance);
      EXPECT_LE(level[k], 2e-8);
    }
  }
}

// Nodal stresses of changing sign: the von Mises stress of what lies between them is that of the tensor, and
// not what a polynomial makes of nodal values >= 0.
TEST_F(VtuFile, TensorsAreInterpolatedAndTheirVonMisesStressIsNeverNegative) {
  const auto psi = holes_level_set(2, 1.0);
  const Lattice<2> lattice(wheel_grid, 2);
  double sign = 1;
  const RingField stress = ring_field(lattice, 4, [&](const Vec<2>& x) {
    sign = -sign;
    return std::array{sign * 3e6 + 1e6 * x[0], -sign * 1e6, sign * 5e5, sign * 2e6 * x[1]};
  });
  VtuMesh<2>(psi, lattice, 4)
      .write(folder / "s.vtu", std::vector<NamedField>{{"stress", "Pa", stress}, von_mises_field(stress)});
  const std::string vtu = content(folder / "s.vtu");
  const auto tensors = vtu_array<float>(vtu, "Name=\"stress_Pa\"");
  const auto von_mises = vtu_array<float>(vtu, "Name=\"von_mises_Pa\"");
  EXPECT_EQ(count(vtu, "ComponentName3=\"xy\""), 1);
  ASSERT_EQ(tensors.size(), 6 * von_mises.size());
  double minimum = INFINITY;
  for (std::size_t k = 0; k < von_mises.size(); ++k) {
    const double xx = tensors[6 * k], yy = tensors[6 * k + 1], zz = tensors[6 * k + 2],
                 xy = tensors[6 * k + 3];
    EXPECT_EQ(tensors[6 * k + 4], 0);
    EXPECT_EQ(tensors[6 * k + 5], 0);
    const double expected = std::sqrt(
        0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) + 3 * xy * xy);
    EXPECT_NEAR(von_mises[k], expected, 1e-6 * expected + 1);
    minimum = std::min<double>(minimum, von_mises[k]);
  }
  EXPECT_GE(minimum, 0);
  EXPECT_LT(minimum, 1e6);  // between nodes of opposite signs, where values at the nodes are above 3e6
}

TEST_F(VtuFile, CellsOfASectorShareTheirPoints) {
  for (int degree : {1, 2}) {
    const auto psi = holes_level_set(degree, 1.0);
    VtuMesh<2>(psi, Lattice<2>(wheel_grid, 2), 4).write(folder / "shape.vtu", {});
    const DecodedMesh mesh(content(folder / "shape.vtu"));
    const std::size_t n = mesh.points.size() / 3 / wheel_grid.n_sectors;
    std::set<std::pair<float, float>> places;
    for (std::size_t k = 0; k < n; ++k) places.insert({mesh.points[3 * k], mesh.points[3 * k + 1]});
    EXPECT_GT(places.size(), 0.99 * n);  // two cells may round a zero on their common edge differently
  }
}

TEST_F(VtuFile, SameInputGivesTheSameBytes) {
  const auto psi = holes_level_set(2, 1.0);
  VtuMesh<2>(psi, psi.lattice, 2).write(folder / "a.vtu", {});
  VtuMesh<2>(psi, psi.lattice, 2).write(folder / "b.vtu", {});
  EXPECT_EQ(content(folder / "a.vtu"), content(folder / "b.vtu"));
}

TEST_F(VtuFile, CollectionListsTheFilesInOrder) {
  const std::vector<PvdEntry> entries{{0, "shape-0000.vtu"}, {1.5, "shape-0001.vtu"}};
  write_pvd(folder / "run.pvd", entries);
  const std::string pvd = content(folder / "run.pvd");
  EXPECT_EQ(count(pvd, "<DataSet "), 2);
  EXPECT_LT(pvd.find("shape-0000.vtu"), pvd.find("timestep=\"1.5\""));
}

TEST_F(VtuFile, TheGroundTouchesTheUndeformedTreadAtItsAzimuth) {
  for (const double azimuth : {0.0, 0.7, 4.0}) {
    write_ground_vtu(folder / "ground.vtu", wheel_grid, azimuth);
    const DecodedMesh ground(content(folder / "ground.vtu"));
    ASSERT_EQ(ground.points.size(), 12u);
    EXPECT_GT(ground.area(), 0);
    double top = INFINITY, left = 0, right = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec<2> x = rotated<2>({ground.points[3 * k], ground.points[3 * k + 1]}, -azimuth);
      top = std::min(top, x[0]);
      left = std::min(left, x[1]);
      right = std::max(right, x[1]);
    }
    EXPECT_NEAR(top, wheel_grid.outer_radius, 1e-7);
    EXPECT_NEAR(left + right, 0, 1e-7);
  }
}

// --- Files ---------------------------------------------------------------------------------------------

class AtomicFile : public OutputFolder {};

TEST_F(AtomicFile, ReplacesTheContentAndLeavesNothingElse) {
  write_atomically(folder / "a", "first, and longer");
  write_atomically(folder / "a", "second");
  EXPECT_EQ(content(folder / "a"), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(AtomicFile, FailureNamesThePathAndTheCause) {
  const fs::path path = folder / "missing" / "a";
  try {
    write_atomically(path, "x");
    FAIL();
  } catch (const OutputError& e) {
    EXPECT_EQ(e.path(), path);
    EXPECT_EQ(e.error(), ENOENT);
    EXPECT_NE(std::string(e.what()).find(path.string()), std::string::npos);
  }
}

TEST(Csv, NumbersReadBackExactly) {
  for (const double x : {0.1, 1.0 / 3, 6.96839, -1e-300, 123456789.123456789, 5e-324})
    EXPECT_EQ(std::strtod(csv_number(x).c_str(), nullptr), x);
  EXPECT_EQ(csv_number(NAN), "");
  EXPECT_EQ(csv_line({"a", "b,c", "d\"e"}), "a,\"b,c\",\"d\"\"e\"\n");
}

HistoryRow history_row() {
  return {.iteration = 3,
          .trial = 1,
          .accepted = true,
          .reason = "",
          .objective = 0.1,
          .terms = {{"strain_energy", 1.0 / 3, {}}},
          .measures = {{"run_out", 2e-4}},
          .volume_fraction = 0.75,
          .step = 0.002,
          .max_velocity = 4e5,
          .max_newton_iterations = 6,
          .phases = {{"factor", 0.25}},
          .trial_seconds = 0.5,
          .elapsed_seconds = 9};
}

class HistoryFile : public OutputFolder {};

TEST_F(HistoryFile, EveryRowIsOnDiskAndHasTheColumnsOfTheHeader) {
  History history(folder / "history.csv", {.objective_unit = "J/m",
                                           .terms = {{"strain_energy", "J/m"}, {"uniformity", "Pa2.m"}},
                                           .measures = {{"run_out", "m"}},
                                           .phases = {"factor"}});
  HistoryRow eventful = history_row();
  eventful.events = {"split, twice", "gone"};
  history.add(eventful);
  HistoryRow failed = history_row();
  failed.accepted = false;
  failed.reason = "newton_stalled";
  failed.objective = NAN;
  failed.terms.clear();
  failed.measures.clear();
  failed.phases.clear();
  history.add(failed);
  const auto rows = lines(content(folder / "history.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(
      rows[0],
      "iteration,trial,accepted,reason,objective [J/m],strain_energy [J/m],uniformity [Pa2.m],"
      "run_out [m],volume fraction [-],step [m],max velocity [Pa],max newton iterations,factor [s],trial "
      "[s],elapsed [s],events");
  EXPECT_EQ(rows[1],
            "3,1,1,,0.1,0.3333333333333333,,0.0002,0.75,0.002,400000,6,0.25,0.5,9,\"split, twice; gone\"");
  EXPECT_EQ(rows[2], "3,1,0,newton_stalled,,,,,0.75,0.002,400000,6,,0.5,9,");
}

TEST(History, FullDiskIsAnOutputError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  try {
    History history("/dev/full", {"J/m", {}, {}, {}});
    FAIL();
  } catch (const OutputError& e) {
    EXPECT_EQ(e.error(), ENOSPC);
  }
}

class PressureFile : public OutputFolder {};

TEST_F(PressureFile, AzimuthIsInDegrees) {
  const std::vector<ContactPoint> points{{.position = 2,
                                          .azimuth = pi / 6,
                                          .x = 0.01,
                                          .weight = 2e-3,
                                          .pressure = 2e6,
                                          .friction = -1e5,
                                          .normal_stress = -1.5e6,
                                          .gap = -1e-6}};
  write_pressure_csv<2>(folder / "p.csv", points);
  const auto rows = lines(content(folder / "p.csv"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(count(rows[0], ","), count(rows[1], ","));
  EXPECT_NEAR(std::strtod(rows[1].c_str() + 2, nullptr), 30, 1e-12);
}

// --- Pictures ------------------------------------------------------------------------------------------

/// Area enclosed by the polylines of a path in millimetres, each counted as a hole.
double polyline_area(const std::string& path) {
  static const std::regex number("-?[0-9]+\\.[0-9]+");
  double total = 0;
  for (const std::string& line : lines(path)) {
    if (line.find('L') == std::string::npos) continue;
    Contour contour{ContourKind::free, {}};
    std::vector<double> numbers;
    for (std::sregex_iterator it(line.begin(), line.end(), number), end; it != end; ++it)
      numbers.push_back(std::strtod(it->str().c_str(), nullptr));
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
      contour.points.push_back({numbers[k], numbers[k + 1]});
    total += std::abs(signed_area(contour));
  }
  return total;
}

TEST(Svg, ShapeIsInTrueMillimetres) {
  const auto contours = material_contours(holes_level_set(2, 1.0), contour_subdivisions(2));
  const std::string path = material_path(wheel_grid, contours, 1000, 4, 0);
  EXPECT_EQ(count(path, "A"), 4);
  EXPECT_EQ(count(path, "Z"), 18);
  EXPECT_NEAR(polyline_area(path) / (16 * pi * 1600), 1, 5e-5);
  const std::string svg = shape_svg(wheel_grid, contours, "a < b & c");
  EXPECT_NE(svg.find("width=\"682mm\""), std::string::npos);
  EXPECT_NE(svg.find("viewBox=\"-341 -341 682 682\""), std::string::npos);
  EXPECT_NE(svg.find("<title>a &lt; b &amp; c</title>"), std::string::npos);
}

TEST(Svg, SpacingThinsTheCurveButKeepsTheShape) {
  const auto contours = material_contours(holes_level_set(2, 1.0), 8);
  const std::string fine = material_path(wheel_grid, contours, 1000, 4, 0);
  const std::string coarse = material_path(wheel_grid, contours, 1000, 4, 0.002);
  EXPECT_LT(coarse.size(), 0.6 * fine.size());
  EXPECT_NEAR(polyline_area(coarse) / polyline_area(fine), 1, 2e-3);
}

/// Sum of the channels' luminance weights.
double luminance(const std::string& colour) {
  const long rgb = std::strtol(colour.c_str() + 1, nullptr, 16);
  return 0.2126 * (rgb >> 16) + 0.7152 * (rgb >> 8 & 0xff) + 0.0722 * (rgb & 0xff);
}

TEST(ColourMap, LightnessIsMonotone) {
  for (int k = 0; k < 100; ++k) EXPECT_LT(luminance(viridis(k / 100.0)), luminance(viridis((k + 1) / 100.0)));
  EXPECT_EQ(viridis(-1), viridis(0));
  EXPECT_EQ(viridis(2), viridis(1));
}

/// Twice the area that closed curves enclose, negative where they run the other way round.
double double_area(const std::vector<PicturePolygon>& curves) {
  double sum = 0;
  for (const PicturePolygon& curve : curves)
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const PicturePoint &a = curve[k], &b = curve[(k + 1) % curve.size()];
      sum += double(a[0]) * b[1] - double(a[1]) * b[0];
    }
  return sum;
}

PicturePolygon unit_square(int x, int y) { return {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}; }

TEST(Outline, ABlockOfSquaresIsOneCurveAndItsHoleAnother) {
  constexpr int n = 7;
  std::vector<PicturePolygon> squares;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y) {
      if (x == 3 && y == 2) continue;
      squares.push_back(unit_square(x, y));
      if ((x + y) % 2) std::ranges::reverse(squares.back());
    }
  const auto outlines = union_outlines(squares);
  ASSERT_EQ(outlines.size(), 2u);
  EXPECT_EQ(outlines[0].size() + outlines[1].size(), 4u * n + 4);
  EXPECT_EQ(double_area(outlines), 2 * (n * n - 1));
}

TEST(Outline, PolygonsThatShareNoSideStayAsTheyAre) {
  const auto outlines = union_outlines({unit_square(0, 0), unit_square(1, 1), {}, {{5, 5}, {5, 5}}});
  EXPECT_EQ(double_area(outlines), 4);
  EXPECT_TRUE(union_outlines({}).empty());
}

TEST(Outline, ThePathLeadsThroughAllPoints) {
  EXPECT_EQ(outline_path({{{1, -2}, {4, -2}, {4, 3}, {-1, 3}}, {{0, 0}, {1, 1}, {0, 1}}}),
            "M1 -2l3 0 0 5-5 0zM0 0l1 1-1 0z");
  EXPECT_EQ(outline_path({{}, {{1, 1}}, {{1, 1}, {2, 2}}}), "");
}

/// Area [pixels^2] under the path of one colour in a picture of whole units.
double path_area(const std::string& svg, const std::string& colour) {
  std::smatch match;
  const std::regex path("<path fill=\"" + colour + "\" d=\"([^\"]*)\"");
  if (!std::regex_search(svg, match, path)) return 0;
  const std::string d = match[1];
  static const std::regex curve("M(-?[0-9]+) (-?[0-9]+)l([^z]*)z"), number("-?[0-9]+");
  std::vector<PicturePolygon> curves;
  for (std::sregex_iterator c(d.begin(), d.end(), curve), end; c != end; ++c) {
    PicturePolygon points{{std::stoi((*c)[1]), std::stoi((*c)[2])}};
    const std::string moves = (*c)[3];
    std::vector<int> steps;
    for (std::sregex_iterator it(moves.begin(), moves.end(), number); it != end; ++it)
      steps.push_back(std::stoi(it->str()));
    for (std::size_t k = 0; k + 1 < steps.size(); k += 2)
      points.push_back({points.back()[0] + steps[k], points.back()[1] + steps[k + 1]});
    curves.push_back(points);
  }
  return 0.5 * std::abs(double_area(curves));
}

TEST(MeshSvg, CellsInsideAndTheMaterialOfCutCellsAreTheMaterialOfASector) {
  const auto psi = holes_level_set(2, 1.0);
  const auto domain = cut_domain(psi, 3);
  ASSERT_TRUE(domain);
  const std::string svg = mesh_svg(psi, *domain, "mesh");
  const double metre = 20 * 360 / 0.34;  // units of the picture
  const double material = path_area(svg, "#9ec1e3") + path_area(svg, "#e8833a");
  EXPECT_NEAR(16 * material / (metre * metre) / material_area, 1, 1e-3);
  EXPECT_GT(path_area(svg, "#fbdcc0"), path_area(svg, "#e8833a"));
  EXPECT_EQ(count(svg, "<use "), 15);
}

TEST(MeshSvg, CirclesAndRaysRunAlongTheSidesOfTheCells) {
  const auto psi = holes_level_set(2, 1.0);
  const std::string svg = mesh_svg(psi, *cut_domain(psi, 3), "mesh");
  const double metre = 20 * 360 / 0.34;  // units of the picture
  static const std::regex line("<path fill=\"none\"[^>]* d=\"([^\"]*)\""),
      ray("M(-?[0-9]+) (-?[0-9]+)L(-?[0-9]+) (-?[0-9]+)"),
      circle(
          "M(-?[0-9]+) (-?[0-9]+)A([0-9]+) ([0-9]+) 0 0 0 (-?[0-9]+) (-?[0-9]+)A([0-9]+) ([0-9]+) 0 0 0 "
          "(-?[0-9]+) (-?[0-9]+)");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(svg, found, line));
  const std::string path = found[1];
  const auto expect_at = [&](const std::smatch& m, int k, double radius, double azimuth) {
    EXPECT_NEAR(std::stod(m[k]), radius * std::cos(azimuth) * metre, 0.5001);
    EXPECT_NEAR(std::stod(m[k + 1]), -radius * std::sin(azimuth) * metre, 0.5001);
  };
  int rays = 0, circles = 0;
  for (std::sregex_iterator it(path.begin(), path.end(), ray), end; it != end; ++it, ++rays)
    for (int k : {1, 3})
      expect_at(*it, k, k == 1 ? wheel_grid.inner_radius : wheel_grid.outer_radius,
                rays * wheel_grid.column_angle());
  for (std::sregex_iterator it(path.begin(), path.end(), circle), end; it != end; ++it, ++circles) {
    const double radius = wheel_grid.radius(circles);
    for (int half = 0; half <= 2; ++half)
      expect_at(*it, 1 + 4 * half, radius, 0.5 * half * wheel_grid.sector_angle());
    for (int k : {3, 4, 7, 8}) EXPECT_NEAR(std::stod((*it)[k]), radius * metre, 0.5001);
  }
  EXPECT_EQ(rays, wheel_grid.columns());
  EXPECT_EQ(circles, wheel_grid.cells[0] + 1);
}

// --- The loaded wheel ----------------------------------------------------------------------------------

/// A square of n x n units in two triangles per unit square, with the scalar f at the corners.
template <class F>
PictureScalar scalar_on_square(int n, int unit, F f) {
  std::vector<PictureScalar::Triangle> triangles;
  const auto add = [&](const PictureScalar::Corners& c) {
    triangles.push_back({c, {f(c[0][0], c[0][1]), f(c[1][0], c[1][1]), f(c[2][0], c[2][1])}});
  };
  for (int x = 0; x < n * unit; x += unit)
    for (int y = 0; y < n * unit; y += unit) {
      add({{{x, y}, {x + unit, y}, {x + unit, y + unit}}});
      add({{{x, y + unit}, {x, y}, {x + unit, y + unit}}});
    }
  return PictureScalar(triangles);
}

TEST(PictureScalar, LevelsOfALinearScalarCutTheSquareStraight) {
  constexpr int n = 8, unit = 100, edge = n * unit;
  const auto scalar = scalar_on_square(n, unit, [](int x, int y) { return x + 0.5 * y; });
  const std::vector<double> levels{-1, 130, 555, 730, 1100, 1300};
  const auto above = scalar.superlevels(levels), below = scalar.sublevels(levels);
  EXPECT_EQ(double_area(scalar.region()), 2.0 * edge * edge);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    double area = 0;  // of x + y / 2 >= level, row by row
    for (int y = 0; y < edge; ++y)
      area += std::clamp(edge - (levels[k] - 0.5 * (y + 0.5)), 0.0, double(edge));
    EXPECT_NEAR(0.5 * double_area(above[k]), area, 1e-3 * edge * edge) << levels[k];
    EXPECT_NEAR(double_area(above[k]) + double_area(below[k]), 2.0 * edge * edge, 1e-12);
    EXPECT_LE(above[k].size(), 1u);
  }
}

TEST(PictureScalar, LevelsOfAnyScalarDivideTheRegion) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int repetition = 0; repetition < 20; ++repetition) {
    const auto scalar = scalar_on_square(6, 40, [&](int, int) { return value(random); });
    std::vector<double> levels;
    for (double level = -1.05; level < 1.1; level += 0.1) levels.push_back(level);
    const auto above = scalar.superlevels(levels), below = scalar.sublevels(levels);
    const double whole = double_area(scalar.region());
    double last = whole;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      EXPECT_NEAR(double_area(above[k]) + double_area(below[k]), whole, 1e-9);
      EXPECT_LE(double_area(above[k]), last + 0.01 * whole);
      last = double_area(above[k]);
    }
    EXPECT_EQ(double_area(above.front()), whole);
    EXPECT_TRUE(above.back().empty());
  }
}

TEST(Outline, SimplifiedCurvesStayWithinTheTolerance) {
  PicturePolygon circle;
  for (int k = 0; k < 720; ++k)
    circle.push_back(
        {int(std::lround(3000 * std::cos(k * pi / 360))), int(std::lround(3000 * std::sin(k * pi / 360)))});
  const PicturePolygon simple = simplified(circle, 2);
  EXPECT_LT(simple.size(), 200u);
  EXPECT_NEAR(double_area({simple}) / double_area({circle}), 1, 2e-3);
  for (const PicturePoint& p : simple) EXPECT_TRUE(std::ranges::count(circle, p));
}

TEST(ColourScale, StartsAtZeroAndOmitsTheTail) {
  std::vector<double> values;
  for (int k = 0; k < 1000; ++k) values.push_back(k < 995 ? 700.0 * k : 1e9);
  const ColourScale scale = colour_scale_from_zero(values, 0.01);
  EXPECT_EQ(scale.lower, 0);
  EXPECT_TRUE(scale.is_cut_above());
  EXPECT_EQ(scale.largest, 1e9);
  EXPECT_GE(scale.upper, values[989]);
  EXPECT_LE(scale.upper, 1.25 * values[990]);
  const ColourScale all = colour_scale(values, 0);
  EXPECT_EQ(all.upper, 1e9);
  EXPECT_FALSE(all.is_cut_above() || all.is_cut_below());
  EXPECT_EQ(colour_scale_from_zero(std::vector<double>(5, 0.0), 0.01).upper, 0);
  EXPECT_EQ(colour_scale(std::vector<double>{NAN}, 0).upper, 0);
}

// The colours may end below the peak, but the bar does not hide it.
TEST(ColourScale, ABarThatEndsBelowTheLargestValueNamesIt) {
  const auto bar = [](double largest) {
    return colour_bar({.lower = 0, .upper = 2e6, .smallest = 0, .largest = largest}, "stress", "Pa", 0, 400);
  };
  EXPECT_EQ(count(bar(2.46e6), ">up to 2.46<"), 1);
  EXPECT_EQ(count(bar(2e6), "up to"), 0);
  EXPECT_EQ(count(bar(1.9e6), "up to"), 0);
}

TEST(Magnification, IsRoundAndAsLargeAsPossible) {
  const double radius = 0.34;
  for (double size = 1e-9; size < 1; size *= 1.7) {
    const RingField u{2, {0.6 * size, -0.8 * size, NAN, NAN, 0, 0.1 * size}};
    const double m = picture_magnification(u, radius);
    EXPECT_TRUE(m == 1 || m * size <= 0.05 * radius * (1 + 1e-12));
    EXPECT_GT(2.5 * m * size, 0.05 * radius * (1 - 1e-12));
    const double decade = std::pow(10, std::floor(std::log10(m) + 1e-9));
    EXPECT_TRUE(std::ranges::any_of(std::array{1.0, 2.0, 5.0}, [&](double d) {
      return std::abs(m / decade - d) < 1e-9;
    })) << m;
  }
  EXPECT_EQ(picture_magnification({2, {0, 0}}, radius), 1);
}

DeformedPicture<2> picture_of(const LevelSet<2>& psi, RingField displacement, double magnification) {
  const auto radius =
      ring_field(psi.lattice, 1, [](const Vec<2>& x) { return std::array{std::hypot(x[0], x[1])}; });
  return {.title = "wheel",
          .displacement = std::move(displacement),
          .magnification = magnification,
          .contact_azimuth = 0.3,
          .window = {},
          .scalar = {"radius", "m", radius},
          .scale = ScaleKind::all,
          .rim = {},
          .travel = 0,
          .rim_force = {3000, 0, 0},
          .contact = {},
          .peak = {}};
}

/// All points of the material in a picture of the whole wheel, in pixels from the axle.
std::vector<Vec<2>> drawn_points(const std::string& svg) {
  const auto begin = svg.find("viewBox=\"0 0 6400 6400\""), end = svg.find("</svg>", begin);
  std::vector<Vec<2>> points;
  static const std::regex token("[Mlz]|-?[0-9]+");
  const std::string material = svg.substr(begin, end - begin);
  for (std::size_t path = material.find(" d=\""); path != std::string::npos;
       path = material.find(" d=\"", path + 1)) {
    const std::string d = material.substr(path + 4, material.find('"', path + 4) - path - 4);
    char command = 'M';
    std::vector<int> numbers;
    for (std::sregex_iterator it(d.begin(), d.end(), token), last; it != last; ++it) {
      if (std::isalpha(static_cast<unsigned char>(it->str()[0]))) {
        command = it->str()[0];
        numbers.clear();
        continue;
      }
      numbers.push_back(std::stoi(it->str()));
      if (numbers.size() < 2) continue;
      Vec<2> p{0.1 * numbers[0] - 320, 0.1 * numbers[1] - 320};
      if (command == 'l') p = {p[0] + 320 + points.back()[0], p[1] + 320 + points.back()[1]};
      points.push_back(p);
      numbers.clear();
    }
  }
  return points;
}

// The ground is drawn where the undeformed tread touches it, whatever the magnification, and the wheel that
// comes down stays above it.
TEST(DeformedSvg, TheTreadTouchesTheGroundAndNeverCrossesIt) {
  const auto psi = holes_level_set(2, 1.0);
  const double pixels = 320 / (1.07 * wheel_grid.outer_radius), ground = wheel_grid.outer_radius * pixels;
  for (const double travel : {0.0, 1e-4, 1e-3}) {
    for (const double magnification : {1.0, 10.0}) {
      const auto down = ring_field(psi.lattice, 2, [&](const Vec<2>& x) {
        const double share = (wheel_grid.outer_radius - std::hypot(x[0], x[1])) /
                             (wheel_grid.outer_radius - wheel_grid.inner_radius);
        return std::array{travel * (0.5 + 0.5 * share) * std::cos(0.3),
                          travel * (0.5 + 0.5 * share) * std::sin(0.3)};
      });
      const auto points = drawn_points(deformed_svg(psi, psi.lattice, picture_of(psi, down, magnification)));
      ASSERT_GT(points.size(), 500u);
      double lowest = -1e9, highest = 1e9;
      for (const Vec<2>& p : points) {
        lowest = std::max(lowest, p[1]);
        highest = std::min(highest, p[1]);
      }
      EXPECT_LE(lowest, ground + 0.051);  // one unit of the picture
      EXPECT_GT(lowest, ground - 0.15);
      // Above, where nothing is near the ground, the displacement is all there.
      EXPECT_NEAR(highest, -ground + 0.5 * travel * magnification * pixels, 0.3);
    }
  }
}

// A tread that is bonded to a rigid ring stays there, so the ring is drawn round it, and the material inside
// moves by all of its displacement: also what comes down.
TEST(DeformedSvg, ABondedTreadStandsInItsRing) {
  const auto psi = holes_level_set(2, 1.0);
  const double pixels = 320 / (1.07 * wheel_grid.outer_radius), travel = 2e-3;
  const auto down = ring_field(psi.lattice, 2, [&](const Vec<2>& x) {
    const double share = (wheel_grid.outer_radius - std::hypot(x[0], x[1])) /
                         (wheel_grid.outer_radius - wheel_grid.inner_radius);
    return std::array{travel * share * std::cos(0.3), travel * share * std::sin(0.3)};
  });
  DeformedPicture<2> picture = picture_of(psi, down, 10);
  const std::string on_ground = deformed_svg(psi, psi.lattice, picture);
  picture.is_bonded = true;
  const std::string svg = deformed_svg(psi, psi.lattice, picture);
  std::ostringstream ring;
  ring << "r=\"" << std::fixed << std::setprecision(1) << wheel_grid.outer_radius * pixels + 1
       << "\" stroke=";
  EXPECT_EQ(count(svg, ring.str()), 1);
  EXPECT_EQ(count(on_ground, ring.str()), 0);
  // The ground's line runs from edge to edge of the picture.
  EXPECT_EQ(count(on_ground, "h640\""), 1);
  EXPECT_EQ(count(svg, "h640\""), 0);
  double innermost = 1e9, outermost = 0;  // about the middle of the moved rim, and about the axle
  for (const Vec<2>& p : drawn_points(svg)) {
    innermost = std::min(innermost, std::hypot(p[0], p[1] - 10 * travel * pixels));
    outermost = std::max(outermost, std::hypot(p[0], p[1]));
  }
  EXPECT_NEAR(innermost, wheel_grid.inner_radius * pixels, 0.3);
  EXPECT_NEAR(outermost, wheel_grid.outer_radius * pixels, 0.3);
}

TEST(DeformedSvg, SaysLoadPositionAndMagnification) {
  const auto psi = holes_level_set(2, 1.0);
  const auto still = ring_field(psi.lattice, 2, [](const Vec<2>&) { return Vec<2>{}; });
  DeformedPicture<2> picture = picture_of(psi, still, 50);
  const std::string svg = deformed_svg(psi, psi.lattice, picture);
  EXPECT_EQ(count(svg, "\u00d7 50<"), 1);
  EXPECT_EQ(count(svg, "17.19\u00b0"), 1);
  EXPECT_EQ(count(svg, ">3000 N<"), 1);
  EXPECT_EQ(count(svg, "peak 340 mm"), 1);
  picture.peak = DrawnPeak<2>{cartesian<2>({0.25, 0.31}), 7.25};
  EXPECT_EQ(count(deformed_svg(psi, psi.lattice, picture), "peak 7.25 m"), 1);
  EXPECT_EQ(count(svg, "most stressed"), 0);  // of one position
  picture.most_stressed_of = 8;
  EXPECT_EQ(count(deformed_svg(psi, psi.lattice, picture), "the most stressed of 8 positions"), 1);
}

// The peak at the quadrature points may exceed all that is drawn, and lie outside a window.
TEST(DeformedSvg, ItsBarReachesThePeakInView) {
  const auto psi = holes_level_set(2, 1.0);
  const auto still = ring_field(psi.lattice, 2, [](const Vec<2>&) { return Vec<2>{}; });
  DeformedPicture<2> picture = picture_of(psi, still, 1);
  picture.scale = ScaleKind::without_tail;
  picture.peak = DrawnPeak<2>{cartesian<2>({0.21, 0.3 + pi}), 0.725};
  EXPECT_EQ(count(deformed_svg(psi, psi.lattice, picture), ">up to 725<"), 1);
  picture.window = 0.03;
  EXPECT_EQ(count(deformed_svg(psi, psi.lattice, picture), "up to"), 0);
}

// The ring about the peak stands where the material is drawn, moved as that is.
TEST(DeformedSvg, ThePeakIsMarkedAtItsDrawnPlace) {
  const auto psi = holes_level_set(2, 1.0);
  const Vec<2> u{1e-3, -2e-3};
  const auto shift = ring_field(psi.lattice, 2, [&](const Vec<2>&) { return u; });
  DeformedPicture<2> picture = picture_of(psi, shift, 3);
  for (const double azimuth : {0.3, 2.0, 5.1}) {
    const Vec<2> x = cartesian<2>({0.215, azimuth});
    picture.peak = DrawnPeak<2>{x, 1};
    const std::string svg = deformed_svg(psi, psi.lattice, picture);
    const Vec<2> place = rotated<2>({x[0] + 3 * u[0], x[1] + 3 * u[1]}, -0.5 * pi - 0.3);
    static const std::regex ring("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"6\"");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(svg, match, ring));
    const double pixels = 320 / (1.07 * wheel_grid.outer_radius);
    EXPECT_NEAR(std::stod(match[1]), 40 + 320 + pixels * place[0], 1);
    EXPECT_NEAR(std::stod(match[2]), 76 + 320 - pixels * place[1], azimuth == 0.3 ? 3 : 1);
  }
}

// At speed the rim also moves as the whole wheel grows, which is no travel.
TEST(DeformedSvg, ShowsTheTravelInsteadOfTheRimMotion) {
  const auto psi = holes_level_set(2, 1.0);
  const auto still = ring_field(psi.lattice, 2, [](const Vec<2>&) { return Vec<2>{}; });
  DeformedPicture<2> picture = picture_of(psi, still, 1);
  picture.rim.towards_ground = 0.005;
  picture.travel = 0.002;
  EXPECT_NE(facts(picture).find("travel 2 mm"), std::string::npos) << facts(picture);
}

TEST(DeformedSvg, AWindowShowsThePartAtTheContact) {
  const auto psi = holes_level_set(2, 1.0);
  const auto still = ring_field(psi.lattice, 2, [](const Vec<2>&) { return Vec<2>{}; });
  DeformedPicture<2> picture = picture_of(psi, still, 1);
  const std::string whole = deformed_svg(psi, psi.lattice, picture);
  picture.window = 0.03;
  picture.contact = {{.position = 0,
                      .azimuth = 0,
                      .x = -2e-3,
                      .weight = 1e-3,
                      .pressure = 1e6,
                      .friction = 0,
                      .normal_stress = 0,
                      .gap = 0,
                      .cell = 0},
                     {.position = 0,
                      .azimuth = 0,
                      .x = 1e-3,
                      .weight = 1e-3,
                      .pressure = 4e6,
                      .friction = 0,
                      .normal_stress = 0,
                      .gap = 0,
                      .cell = 1}};
  const std::string part = deformed_svg(psi, psi.lattice, picture);
  EXPECT_EQ(count(part, "up to 4 MPa"), 1);
  EXPECT_EQ(count(whole, "contact pressure"), 0);
  // The scale spans the radii in view: from 0.2 m for the wheel, from 0.34 - 1.78 * 0.03 m here.
  const auto minimum = [](const std::string& svg) {
    static const std::regex tick("h5\"/><text x=\"[0-9]+\" y=\"[0-9.]+\">([0-9.]+)</text>");
    std::smatch match;
    return std::regex_search(svg, match, tick) ? std::stod(match[1]) : NAN;
  };
  EXPECT_NEAR(minimum(whole), 210, 11);
  EXPECT_NEAR(minimum(part), 340 - 1.78 * 30 + 5, 5);
}

TEST(VerticalField, IsTheComponentTowardsTheGround) {
  const double azimuth = 1.1;
  const RingField field{2, {std::cos(azimuth), std::sin(azimuth), -std::sin(azimuth), std::cos(azimuth)}};
  const RingField vertical = vertical_field<2>(field, azimuth);
  ASSERT_EQ(vertical.values.size(), 2u);
  EXPECT_NEAR(vertical.values[0], 1, 1e-15);
  EXPECT_NEAR(vertical.values[1], 0, 1e-15);
}

TEST(DeformedSvg, MissingValuesAreOmittedAndTextIsEscaped) {
  const auto psi = holes_level_set(2, 1.0);
  DeformedPicture<2> picture =
      picture_of(psi, ring_field(psi.lattice, 2, [](const Vec<2>& x) { return x; }), 0.1);
  picture.title = "a & b";
  picture.scalar = {"von Mises", "Pa",
                    ring_field(psi.lattice, 1, [](const Vec<2>& x) { return std::array{x[0] * 1e7}; })};
  picture.displacement.values[0] = NAN;
  picture.scalar.field.values[7] = NAN;
  const std::string svg = deformed_svg(psi, psi.lattice, picture);
  EXPECT_EQ(count(svg, "nan"), 0);
  EXPECT_EQ(count(svg, "a &amp; b"), 2);
  EXPECT_EQ(count(svg, "[MPa]"), 1);
}

// --- Progress ------------------------------------------------------------------------------------------

TEST(Progress, ClockAndBarFitAnyWidth) {
  EXPECT_EQ(clock_text(59.6), "1:00");
  EXPECT_EQ(clock_text(3723), "1:02:03");
  const ProgressState state{50, 100, 38.2, 44.0, 0.7, 0.0012, 12};
  for (int width = 1; width < 200; ++width)
    EXPECT_LE(progress_bar(state, 10, width).size(), std::size_t(width));
  EXPECT_EQ(count(progress_bar(state, 10, 120), "#"), 20);
  EXPECT_EQ(count(progress_bar(state, 10, 120), "."), 20 + 4);
}

std::string shown(ProgressStyle style, double seconds_per_shape) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  {
    Progress progress(stream, style);
    for (int k = 0; k <= 20; ++k) progress.show({k, 20, 44.0 - k, 44.0, 0.7, 0.001, k * seconds_per_shape});
  }
  std::fclose(stream);
  const std::string result(text, size);
  std::free(text);
  return result;
}

TEST(Progress, LinesAtMostOnceASecondAndTheLastShape) {
  EXPECT_EQ(lines(shown(ProgressStyle::lines, 2)).size(), 21u);
  const auto quick = lines(shown(ProgressStyle::lines, 0.24));
  EXPECT_EQ(quick.size(), 5u);  // shapes 0, 5, 10, 15 and 20
  EXPECT_NE(quick.back().find("20/20"), std::string::npos);
}

TEST(Progress, TimeLeftFollowsTheLastShapes) {
  EXPECT_NE(lines(shown(ProgressStyle::lines, 2))[10].find("0:20 left"), std::string::npos);
}

TEST(Progress, TimeLeftIsRoundedUpAndNeverZero) {
  const std::string quick = shown(ProgressStyle::bar, 0.06);  // 20 shapes in 1.2 s
  EXPECT_GT(count(quick, "at most 0:02 left"), 0);
  EXPECT_GT(count(quick, "at most 0:01 left"), 0);
  EXPECT_EQ(count(quick, "0:00 left"), 0);
  EXPECT_EQ(count(shown(ProgressStyle::bar, 0), "0:00 left"), 0);
}

TEST(Progress, ColourOnlyWhereAsked) {
  EXPECT_EQ(count(shown(ProgressStyle::lines, 2), "\x1b"), 0);
  EXPECT_EQ(count(shown(ProgressStyle::bar, 2), "m["), 0);
  EXPECT_GT(count(shown(ProgressStyle::coloured_bar, 2), "\x1b[36m"), 0);
  EXPECT_EQ(shown(ProgressStyle::bar, 2).back(), '\n');
}

TEST(Progress, StyleOfAFileIsLines) {
  std::FILE* file = std::tmpfile();
  EXPECT_EQ(progress_style(file), ProgressStyle::lines);
  std::fclose(file);
}

}  // namespace
}  // namespace wheelwright
