#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/read.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright {
namespace {

/// The paper's wheel of 16 holes in `positions` load positions, with all numbers of the grid left to the
/// program, on the tread of an analysis.
Case paper_case(int positions) {
  const auto read = parse_case(R"(
[load]
positions = )" + std::to_string(positions) +
                                   R"(
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
)",
                               "paper.toml");
  return with_levels_of_results(read.value.value());
}

/// The values at both ends of a cell of the polynomial through its values at the Gauss points, which are the
/// trace of the displacement and stress of that cell alone.
std::pair<double, double> at_ends(const GaussRule& rule, const std::vector<double>& values) {
  const auto at = [&](double x) {
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) {
      double weight = 1;
      for (size_t j = 0; j < values.size(); ++j)
        if (j != i) weight *= (x - rule.points[j]) / (rule.points[i] - rule.points[j]);
      sum += weight * values[i];
    }
    return sum;
  };
  return {at(0), at(1)};
}

struct Pressures {
  double peak = 0;  ///< of the position
  double largest_jump =
      0;  ///< between both sides of a face of two cells where their mean exceeds half of the peak
};

Pressures pressures(const ContactPatch<2>& patch, int points_per_cell) {
  const GaussRule rule = gauss_rule(points_per_cell);
  Pressures result;
  for (const auto& point : patch.points) result.peak = std::max(result.peak, -point.traction[0]);
  std::optional<double> left;
  for (size_t first = 0; first < patch.points.size(); first += points_per_cell) {
    std::vector<double> values;
    for (int q = 0; q < points_per_cell; ++q) values.push_back(-patch.points[first + q].augmented[0]);
    const auto [begin, end] = at_ends(rule, values);
    if (left && 0.5 * (*left + begin) > 0.5 * result.peak)
      result.largest_jump = std::max(result.largest_jump, std::abs(begin - *left));
    left = end;
  }
  return result;
}

/// The largest deviation of a periodic series from its mean and first harmonics.
double deviation_from_harmonics(const std::vector<double>& values, int n_harmonics) {
  const int n = static_cast<int>(values.size());
  std::vector<double> smooth(n, 0.0);
  for (int h = 0; h <= n_harmonics; ++h) {
    std::complex<double> coefficient = 0;
    const auto phase = [&](int i) { return std::polar(1.0, 2 * std::numbers::pi * h * i / n); };
    for (int i = 0; i < n; ++i) coefficient += values[i] * std::conj(phase(i)) / double(n);
    for (int i = 0; i < n; ++i) smooth[i] += (h == 0 ? 1 : 2) * (coefficient * phase(i)).real();
  }
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(values[i] - smooth[i]));
  return largest;
}

// Nothing smooths the pressure: it is that of the contact law at every point.
TEST(Pressures, AreSmoothFromCellToCellAndOverThePositions) {
  constexpr int n = 64;
  const Case c = paper_case(n);
  const auto solver = make_solver(rolling_model<2>(c));
  ASSERT_TRUE(solver);
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto state = (*solver)->states(shape, (*solver)->distinct_positions(shape), Interrupt());
  ASSERT_TRUE(state);
  std::vector<double> peaks;
  for (const auto& patch : (*state)->contacts()) {
    const Pressures found = pressures(patch, c.contact.quadrature_points);
    EXPECT_LT(found.largest_jump, 0.04 * found.peak) << peaks.size();
    peaks.push_back(found.peak);
  }
  // Positions 0 ... n / 2; the others are their mirror images.
  ASSERT_EQ(peaks.size(), n / 2 + 1);
  for (int i = n / 2 - 1; i > 0; --i) peaks.push_back(peaks[i]);
  EXPECT_LT(deviation_from_harmonics(peaks, 6), 0.01 * *std::ranges::max_element(peaks));
}

}  // namespace
}  // namespace wheelwright
