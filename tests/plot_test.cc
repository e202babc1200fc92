#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <regex>

#include "wheelwright/output/report/plot_svg.h"
#include "wheelwright/output/report/pressure_plot.h"

namespace wheelwright {
namespace {

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (auto p = text.find(word); p != std::string::npos; p = text.find(word, p + word.size())) ++n;
  return n;
}

/// Every tag is closed in order, attributes are quoted, and no bare < or & is left.
bool is_well_formed(const std::string& xml) {
  static const std::regex token(
      R"(<\?[^?]*\?>|<(/?)([A-Za-z]+)((?:\s+[A-Za-z:]+="[^"<]*")*)\s*(/?)>|&(?:amp|lt|gt|quot|apos);|[^<&]+)");
  std::vector<std::string> open;
  auto at = xml.cbegin();
  std::smatch match;
  while (at != xml.cend()) {
    if (!std::regex_search(at, xml.cend(), match, token, std::regex_constants::match_continuous))
      return false;
    if (match[2].matched) {
      if (match[1].length() > 0) {
        if (open.empty() || open.back() != match[2]) return false;
        open.pop_back();
      } else if (match[4].length() == 0) {
        open.push_back(match[2]);
      }
    }
    at = match[0].second;
  }
  return open.empty();
}

/// The points of every curve in pixels, by pieces.
std::vector<std::vector<std::array<double, 2>>> drawn_pieces(const std::string& svg) {
  static const std::regex path("<path class=\"curve\"[^>]* d=\"([^\"h]*)\"/>"),
      point("([ML])([0-9.-]+) ([0-9.-]+)");
  std::vector<std::vector<std::array<double, 2>>> pieces;
  for (std::sregex_iterator p(svg.begin(), svg.end(), path), end; p != end; ++p) {
    const std::string d = (*p)[1];
    for (std::sregex_iterator q(d.begin(), d.end(), point); q != end; ++q) {
      if ((*q)[1] == "M") pieces.emplace_back();
      pieces.back().push_back({std::stod((*q)[2]), std::stod((*q)[3])});
    }
  }
  return pieces;
}

LinePlot line(std::vector<double> x, std::vector<double> y) {
  return {"title", {"load", "N"}, {"travel", "mm"}, {{"only", std::move(x), std::move(y)}}};
}

TEST(Plot, TicksAreRoundEvenAndAllThatFit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-12, 12), position(-3, 3);
  for (int k = 0; k < 2000; ++k) {
    const double size = std::pow(10, exponent(random)), low = size * position(random), high = low + size;
    const int most = 2 + k % 10;
    const auto ticks = axis_ticks(low, high, most);
    ASSERT_LE(static_cast<int>(ticks.size()), most + 1);
    if (ticks.size() < 2) continue;
    const double step = ticks[1] - ticks[0];
    const double mantissa = step / std::pow(10, std::floor(std::log10(step * (1 + 1e-6))));
    EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 5)}), 1e-6);
    EXPECT_LT(std::abs(ticks[0] / step - std::round(ticks[0] / step)), 1e-6);
    EXPECT_GT(ticks.front(), low - 1e-6 * size);
    EXPECT_LT(ticks.front() - step, low);
    EXPECT_LT(ticks.back(), high + 1e-6 * size);
    EXPECT_GT(ticks.back() + step, high);
    for (const double tick : ticks) EXPECT_FALSE(tick == 0 && std::signbit(tick));  // no label "-0"
  }
}

TEST(Plot, PointsAreDrawnToScale) {
  const std::vector<double> x{0, 1, 2.5, 4}, y{-2, 0, 7, 3};
  const auto pieces = drawn_pieces(plot_svg(line(x, y)));
  ASSERT_EQ(pieces.size(), 1u);
  const auto& p = pieces[0];
  ASSERT_EQ(p.size(), x.size());
  for (size_t i = 1; i < x.size(); ++i) {
    EXPECT_NEAR((p[i][0] - p[0][0]) / (p[3][0] - p[0][0]), (x[i] - x[0]) / (x[3] - x[0]), 1e-4);
    EXPECT_NEAR((p[i][1] - p[0][1]) / (p[2][1] - p[0][1]), (y[i] - y[0]) / (y[2] - y[0]), 1e-4);
  }
  EXPECT_LT(p[2][1], p[0][1]);  // larger is higher
}

TEST(Plot, CurvesFillTheSameHeightWhereverTheirValuesLie) {
  const auto extent = [](const std::vector<double>& y) {
    double low = INFINITY, high = -INFINITY;
    const auto pieces = drawn_pieces(plot_svg(line({0, 1, 2}, y)));
    for (const auto& p : pieces[0]) {
      low = std::min(low, p[1]);
      high = std::max(high, p[1]);
    }
    return std::array{low, high};
  };
  const auto at_zero = extent({0, 1, 0.3});
  for (const double offset : {-1000.0, -7.0, 3.0, 1000.0}) {
    const auto there = extent({offset, offset + 1, offset + 0.3});
    EXPECT_NEAR(there[0], at_zero[0], 0.2) << offset;
    EXPECT_NEAR(there[1], at_zero[1], 0.2) << offset;
  }
}

TEST(Plot, MissingValuesInterruptTheLine) {
  const auto pieces = drawn_pieces(plot_svg(line({0, 1, 2, 3, 4}, {1, 2, NAN, 4, 5})));
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].size(), 2u);
  EXPECT_EQ(pieces[1].size(), 2u);
}

TEST(Plot, RoundingIsNotMagnified) {
  const auto pieces = drawn_pieces(plot_svg(line({0, 1, 2}, {1, 1 + 1e-12, 1 - 1e-12})));
  for (const auto& p : pieces[0]) EXPECT_NEAR(p[1], pieces[0][0][1], 0.02);
}

TEST(Plot, EveryPlotIsWellFormed) {
  ASSERT_TRUE(is_well_formed("<a b=\"c\">d<e/></a>"));
  ASSERT_FALSE(is_well_formed("<a>b & c</a>"));
  ASSERT_FALSE(is_well_formed("<a><b></a></b>"));
  LinePlot plot = line({0, 1}, {2, 3});
  plot.title = "a < b & \"c\"";
  plot.y.unit = "";
  EXPECT_TRUE(is_well_formed(plot_svg(plot)));
  plot.curves.push_back({"<&>", {0, 1}, {1, 1}});
  EXPECT_TRUE(is_well_formed(plot_svg(plot)));
  for (const auto& odd : {line({}, {}), line({1}, {1}), line({0, 1}, {NAN, NAN}), line({0, 0}, {0, 0}),
                          line({1e300, 2e300}, {-1e-300, 1e-300}), line({0, INFINITY}, {1, 2})}) {
    const std::string svg = plot_svg(odd);
    EXPECT_TRUE(is_well_formed(svg));
    EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0);
  }
}

TEST(Plot, CurvesOfAnyNumberOfPositionsAreFew) {
  for (int n : {1, 7, 8, 9, 64, 100}) {
    std::vector<ContactPoint> points;
    std::vector<double> azimuths;
    for (int i = 0; i < n; ++i) {
      azimuths.push_back(0.01 * i);
      for (int k = -4; k <= 4; ++k)
        points.push_back({.position = i,
                          .azimuth = 0,
                          .x = 1e-3 * k,
                          .weight = 1e-3,
                          .pressure = std::max(0.0, 4e6 - 1e6 * k * k),
                          .friction = 0,
                          .normal_stress = 0,
                          .gap = 0,
                          .cell = k + 4});
    }
    const LinePlot plot = pressure_plot(points, azimuths, "");
    EXPECT_EQ(plot.curves.size(), n <= 8 ? size_t(n) : plot.curves.size());
    EXPECT_LE(plot.curves.size(), 8u);
    EXPECT_GE(plot.curves.size(), std::min<size_t>(n, 5));
    for (const PlotCurve& curve : plot.curves) {
      EXPECT_EQ(curve.x, (std::vector<double>{-2, -1, 0, 1, 2}));
      EXPECT_EQ(curve.y, (std::vector<double>{0, 3, 4, 3, 0}));
    }
  }
}

// A spike at one point of the cell in which the contact ends is not drawn, but the force of the cell is.
TEST(Plot, PressuresAreMeansOfCells) {
  std::vector<ContactPoint> points;
  const std::vector<std::vector<double>> pressures{{0, 0}, {0, 3}, {2, 2}, {2.5, 1.5}, {0, 0}};
  for (int cell = 0; cell < 5; ++cell)
    for (int k = 0; k < 2; ++k)
      points.push_back({.position = 0,
                        .azimuth = 0,
                        .x = 1e-3 * (cell + 0.25 + 0.5 * k),
                        .weight = k == 0 ? 1e-3 : 2e-3,
                        .pressure = 1e6 * pressures[cell][k],
                        .friction = 0,
                        .normal_stress = 0,
                        .gap = 0,
                        .cell = cell});
  const LinePlot plot = pressure_plot(points, std::vector<double>{0}, "");
  ASSERT_EQ(plot.curves.size(), 1u);
  const std::vector<double> means{0, 2, 2, 11.0 / 6, 0};
  ASSERT_EQ(plot.curves[0].y.size(), means.size());
  for (std::size_t k = 0; k < means.size(); ++k) EXPECT_NEAR(plot.curves[0].y[k], means[k], 1e-12);
}

}  // namespace
}  // namespace wheelwright
