#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

using testing::Hole;

const PolarGrid<2> grid{0.20, 0.34, 0.12, 7, {14, 33}};
/// No two alike, no mirror image, one across a sector face.
const std::vector<Hole> three_holes{{0.262, 0.02, 0.022}, {0.285, 0.37, 0.018}, {0.246, 0.61, 0.027}};

struct Curve {
  std::vector<Vec<2>> points;  ///< as in the file
  double signed_area() const {
    double twice = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec<2>&a = points[k], &b = points[(k + 1) % points.size()];
      twice += a[0] * b[1] - a[1] * b[0];
    }
    return 0.5 * twice;
  }
  Vec<2> centroid() const {
    Vec<2> sum{};
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec<2>&a = points[k], &b = points[(k + 1) % points.size()];
      for (int d = 0; d < 2; ++d) sum[d] += (a[d] + b[d]) * (a[0] * b[1] - a[1] * b[0]);
    }
    return {sum[0] / (6 * signed_area()), sum[1] / (6 * signed_area())};
  }
};

/// The polylines of a path of M, L and Z, and the radii of its full circles about the origin.
struct Path {
  std::vector<Curve> polylines;
  std::vector<double> circles;
};

Path read_path(const std::string& svg) {
  const auto begin = svg.find(" d=\"") + 4;
  const std::string d = svg.substr(begin, svg.find('"', begin) - begin);
  Path path;
  const char* at = d.c_str();
  const auto number = [&] {
    char* end;
    const double value = std::strtod(at, &end);
    at = end;
    return value;
  };
  bool is_circle = false;
  Curve curve;
  while (*at) {
    const char command = *at++;
    if (command == 'M') {
      curve = {};
      is_circle = false;
    }
    if (command == 'M' || command == 'L') {
      const double x = number();
      curve.points.push_back({x, number()});
    } else if (command == 'A') {
      if (!is_circle) path.circles.push_back(number());
      for (int k = is_circle ? 7 : 6; k > 0; --k) number();
      is_circle = true;
    } else if (command == 'Z' && !is_circle) {
      path.polylines.push_back(curve);
    }
  }
  return path;
}

/// In a shape for cutting, y points down: what the body frame has at (x, y) stands at (x, -y), in
/// millimetres.
TEST(ShapeSvg, EveryHoleStandsAtItsOwnAzimuth) {
  const auto psi = testing::holes(grid, 2, three_holes);
  const Path path = read_path(shape_svg(grid, material_contours(psi, contour_subdivisions(2)), "wheel"));
  ASSERT_EQ(path.polylines.size(), 21u);
  auto circles = path.circles;
  std::ranges::sort(circles);
  EXPECT_EQ(circles, (std::vector<double>{200, 340}));
  for (int sector = 0; sector < 7; ++sector)
    for (const Hole& hole : three_holes) {
      const double azimuth = hole.azimuth + sector * grid.sector_angle();
      const Vec<2> expected{1e3 * hole.centre_radius * std::cos(azimuth),
                            -1e3 * hole.centre_radius * std::sin(azimuth)};
      int found = 0;
      for (const Curve& curve : path.polylines) {
        const Vec<2> c = curve.centroid();
        if (std::hypot(c[0] - expected[0], c[1] - expected[1]) > 0.1) continue;
        ++found;
        const double area = 1e6 * std::numbers::pi * hole.radius * hole.radius;
        EXPECT_NEAR(std::abs(curve.signed_area()), area, 1e-3 * area);
        // The material is on the left of a contour, so a hole runs clockwise; y down turns that round.
        EXPECT_GT(curve.signed_area(), 0);
      }
      EXPECT_EQ(found, 1) << "radius " << hole.centre_radius << " azimuth " << azimuth;
    }
}

}  // namespace
}  // namespace wheelwright
