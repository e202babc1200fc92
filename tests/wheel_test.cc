#include <gtest/gtest.h>

#include "wheelwright/case/read.h"
#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

const std::filesystem::path cases = std::filesystem::path(WHEELWRIGHT_SOURCE_DIR) / "cases";

struct Course {
  OptimizationState<2> initial, last;
  double worst_volume_error = 0;
};

Course optimize_case(const Case& c) {
  const auto study = make_study<2>(c);
  EXPECT_TRUE(study);
  std::optional<OptimizationState<2>> first;
  double worst = 0;
  const auto outcome = optimize<2>(
      optimizer_of(*study), study->initial,
      [&](const Trial<2>& trial, const OptimizationState<2>& state) {
        if (!first) first = state;
        if (trial.verdict == Verdict::accepted)
          worst = std::max(worst, std::abs(trial.measure / state.target_measure - 1));
      },
      [] { return false; });
  EXPECT_TRUE(outcome.state);
  return {*first, *outcome.state, worst};
}

Case read(const std::string& name) {
  const auto result = read_case(cases / name);
  EXPECT_TRUE(result.value);
  return *result.value;
}

/// Radial and azimuthal extent [m] of the hole of a sector.
std::pair<double, double> hole_extent(const LevelSet<2>& psi) {
  double low = 1, high = 0, first = 10, last = -10;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    if (psi.values[i] < 0) continue;
    const Vec<2> p = psi.lattice.polar_point(i);
    low = std::min(low, p[0]);
    high = std::max(high, p[0]);
    first = std::min(first, p[1]);
    last = std::max(last, p[1]);
  }
  return {high - low, 0.5 * (high + low) * (last - first)};
}

void expect_stiffer_at_constant_volume(const Course& run) {
  EXPECT_LT(run.last.evaluation.function("objective").value,
            0.83 * run.initial.evaluation.function("objective").value);
  EXPECT_LT(run.worst_volume_error, 1e-3);
  const auto [radial0, azimuthal0] = hole_extent(run.initial.shape);
  const auto [radial, azimuthal] = hole_extent(run.last.shape);
  EXPECT_NEAR(radial0, azimuthal0, 0.01);
  EXPECT_GT(radial, 1.4 * azimuthal);
  EXPECT_GT(radial, radial0);
}

TEST(PapersWheel, TwelveShapesMakeItStiffer) {
  Case c = read("holes16.toml");
  c.optimizer.iterations = 12;
  expect_stiffer_at_constant_volume(optimize_case(c));
}

TEST(PapersWheel, SlowAHundredShapesMakeItStiffer) {
  const Course run = optimize_case(read("holes16.toml"));
  EXPECT_GE(run.last.iteration, 30);
  expect_stiffer_at_constant_volume(run);
}

/// (max - min) / mean over the positions of the peak contact pressure.
double pressure_spread(const Case& c, const LevelSet<2>& shape) {
  const auto problem = RollingProblem<2>::create(rolling_model<2>(c));
  const auto solution = problem->solve(shape);
  EXPECT_TRUE(solution);
  double low = 1e30, high = 0, sum = 0;
  for (const auto& state : solution->states) {
    double peak = 0;
    for (const auto& traction : state.traction) peak = std::max(peak, -traction[0]);
    low = std::min(low, peak);
    high = std::max(high, peak);
    sum += peak;
  }
  return (high - low) / (sum / static_cast<double>(solution->states.size()));
}

double functional_value(const OptimizationState<2>& state, const std::string& name) {
  for (const auto& value : state.evaluation.terms)
    if (value.name == name) return value.value;
  ADD_FAILURE() << name;
  return 0;
}

// Figs 16 to 21: more weight on J_p2 makes the contact more even and the wheel softer; J_p2 falls
// proportionally more than J_p1.
TEST(PapersWheel, SlowUniformityFunctionalsEvenOutTheContact) {
  double last_spread = 1, last_energy = 0;
  for (const char* name : {"je", "jp2_10", "jp2_100", "jp2_1000"}) {
    const Case c = read(std::string("paper/uniform_") + name + ".toml");
    const Course run = optimize_case(c);
    const double spread = pressure_spread(c, run.last.shape);
    const double energy = functional_value(run.last, "strain_energy");
    EXPECT_LT(spread, last_spread) << name;
    EXPECT_GT(energy, last_energy) << name;
    EXPECT_LT(spread, 0.5 * pressure_spread(c, run.initial.shape)) << name;
    last_spread = spread;
    last_energy = energy;
  }
  const Course annulus = optimize_case(read("paper/uniform_jp1.toml")),
               dual = optimize_case(read("paper/uniform_jp2_100.toml"));
  const auto ratio = [](const Course& run, const std::string& name) {
    return functional_value(run.last, name) / functional_value(run.initial, name);
  };
  EXPECT_LT(ratio(dual, "uniformity_dual"), ratio(annulus, "uniformity_annulus"));
}

}  // namespace
}  // namespace wheelwright
