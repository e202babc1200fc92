#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>

#include "tests/support.h"
#include "wheelwright/output/report/colour_map.h"
#include "wheelwright/output/report/sector_svg.h"

namespace wheelwright {
namespace {

using testing::paper_holes;

const PolarGrid<2> grid(0.2, 0.34, 0.12, 16, {14, 12});

/// Area [m^2] inside of the paths of this colour on the wheel, all sectors.
double area(const std::string& svg, const std::string& colour) {
  constexpr double metre = 20 * 360 / 0.34;  // units of the picture
  static const std::regex curve("M(-?[0-9]+) (-?[0-9]+)l([^z]*)z"), number("-?[0-9]+");
  const std::regex path("<path fill=\"" + colour + "\"[^>]* d=\"([^\"]*)\"");
  double doubled = 0;
  for (std::sregex_iterator p(svg.begin(), svg.end(), path), no_path; p != no_path; ++p) {
    const std::string d = (*p)[1];
    for (std::sregex_iterator c(d.begin(), d.end(), curve), no_curve; c != no_curve; ++c) {
      const std::string moves = (*c)[3];
      double x = std::stod((*c)[1]), y = std::stod((*c)[2]);
      const double x0 = x, y0 = y;
      for (std::sregex_iterator step(moves.begin(), moves.end(), number), no_step; step != no_step; ++step) {
        const double dx = std::stod(step->str()), dy = std::stod((++step)->str());
        doubled += x * (y + dy) - (x + dx) * y;
        x += dx;
        y += dy;
      }
      doubled += x * y0 - x0 * y;
    }
  }
  return grid.n_sectors * 0.5 * std::abs(doubled) / (metre * metre);
}

double ring_area(double inner, double outer) { return std::numbers::pi * (outer * outer - inner * inner); }

TEST(SectorSvg, ColoursCoverValuesOfTheirSign) {
  const auto psi = paper_holes(grid);
  SectorScalar scalar{"step", "Pa", 1, std::vector<double>(grid.n_cells(), 0.0)};
  const double middle = grid.radius(5);
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    scalar.values[cell] = grid.cell_position(cell)[0] < 5 ? -2.0 : 2.0;
  const std::string svg = sector_svg(psi, scalar, "title");
  const double chord = std::pow(grid.column_angle(), 2) / 6 + 1e-5;  // cells have straight sides; rounding
  EXPECT_NEAR(area(svg, blue_to_red(-1)), ring_area(grid.inner_radius, middle), chord * ring_area(0.2, 0.34));
  EXPECT_NEAR(area(svg, blue_to_red(1)), ring_area(middle, grid.outer_radius), chord * ring_area(0.2, 0.34));
  EXPECT_EQ(area(svg, blue_to_red(0)), 0);
}

TEST(SectorSvg, NothingIsDrawnWhereThereIsNoValue) {
  const auto psi = paper_holes(grid);
  SectorScalar scalar{"nothing", "Pa", 1, std::vector<double>(grid.n_cells(), NAN)};
  const std::string empty = sector_svg(psi, scalar, "title");
  EXPECT_EQ(empty.find("stroke-width=\"12\""), std::string::npos);
  scalar.values[7] = 0;
  EXPECT_GT(area(sector_svg(psi, scalar, "title"), blue_to_red(0)), 0);
}

TEST(SectorSvg, PartsOfCellsTakeTheValuesInTheirMiddles) {
  for (const int degree : {1, 2}) {
    const Lattice<2> lattice(grid, degree);
    LevelSet<2> radius{lattice, {}};
    for (int node = 0; node < lattice.n_nodes(); ++node)
      radius.values.push_back(grid.inner_radius +
                              lattice.node_position(node)[0] * grid.row_height(0) / degree);
    for (const int parts : {1, 3}) {
      const auto values = values_in_parts(radius, parts);
      ASSERT_EQ(values.size(), static_cast<size_t>(grid.n_cells() * parts * parts));
      for (size_t k = 0; k < values.size(); ++k) {
        const int cell = static_cast<int>(k) / (parts * parts), part = static_cast<int>(k) % (parts * parts);
        const double cells = grid.cell_position(cell)[0] + (part / parts + 0.5) / parts;
        EXPECT_NEAR(values[k], grid.radius(cells), 1e-14);
      }
    }
  }
}

TEST(SectorSvg, MeansInCellsAreWeightedByLength) {
  const auto sample = [](int cell, double weight, double value) {
    return SurfaceSample<2>{{cell, {}, {}, weight}, value};
  };
  const std::vector<SurfaceSample<2>> samples{sample(3, 1, 4), sample(5, 2, -7), sample(3, 3, 2)};
  const auto means = means_in_cells(grid, samples);
  EXPECT_DOUBLE_EQ(means[3], 2.5);
  EXPECT_DOUBLE_EQ(means[5], -7);
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    EXPECT_EQ(std::isnan(means[cell]), cell != 3 && cell != 5);
}

TEST(ColourMap, BlueToRedIsWhiteInTheMiddleAndClamped) {
  EXPECT_EQ(blue_to_red(-5), blue_to_red(-1));
  EXPECT_EQ(blue_to_red(5), blue_to_red(1));
  const auto channel = [](double t, int k) {
    return std::stol(blue_to_red(t).substr(1 + 2 * k, 2), nullptr, 16);
  };
  for (int k = 0; k < 3; ++k) EXPECT_GT(channel(0, k), 240);
  EXPECT_GT(channel(-0.7, 2), channel(-0.7, 0));
  EXPECT_GT(channel(0.7, 0), channel(0.7, 2));
}

}  // namespace
}  // namespace wheelwright
