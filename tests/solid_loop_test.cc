#include <gtest/gtest.h>

#include "wheelwright/case/read.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/mirror.h"

// The loop of shapes in three dimensions.

namespace wheelwright {
namespace {

Case parsed(const std::string& text) {
  CaseResult result = parse_case(text, "case.toml");
  for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
  return result.value.value_or(Case{});
}

/// Runs a symmetric case. Every accepted shape after the first is its own mirror image to the last bit in
/// both planes, has the volume of the first, and is at most 1e-4 worse than the best before it. Returns the
/// ratio of the last objective to the first.
double expect_a_sound_run(const Case& c) {
  const auto study = make_study<3>(c);
  EXPECT_TRUE(study);
  std::vector<double> objectives;
  std::optional<double> measure;
  const auto outcome = optimize<3>(
      optimizer_of(*study), study->initial,
      [&](const Trial<3>& trial, const OptimizationState<3>& state) {
        if (trial.verdict != Verdict::accepted) return;
        for (const MirrorPlane plane : {MirrorPlane::azimuth, MirrorPlane::width})
          if (state.iteration == 0)  // drawn: up to rounding
            EXPECT_TRUE(is_mirror_symmetric(state.shape, plane));
          else
            EXPECT_EQ(mirror_symmetric_part(state.shape, plane).values, state.shape.values);
        if (!measure) measure = state.measure;
        EXPECT_NEAR(state.measure, *measure, 2e-6 * *measure);
        const double objective = state.evaluation.function("objective").value;
        if (!objectives.empty()) {
          EXPECT_LT(objective, (1 + 1.01e-4) * *std::ranges::min_element(objectives));
        }
        objectives.push_back(objective);
      },
      [] { return false; });
  EXPECT_NE(outcome.reason, StopReason::gave_up);
  EXPECT_NE(outcome.reason, StopReason::failed_start);
  EXPECT_EQ(static_cast<int>(objectives.size()), c.optimizer.iterations + 1);
  return objectives.back() / objectives.front();
}

TEST(SolidLoop, KeepsBothMirrorImagesAndTheVolume) {
  const Case c = parsed(R"(
[wheel]
dimension = 3
sectors = 12
[material]
poissons_ratio = 0.3
[load]
positions = 1
[[holes.sphere]]
count = 12
center_radius = 0.26
radius = 0.035
[grid]
radial_cells = 7
angular_cells = 72
axial_cells = 4
degree = 1
level_set_degree = 1
tread_levels = 0
[optimizer]
rim_band = 0.0201
tread_band = 0.0405
iterations = 6
tolerance = 0
minimum_wall = 0
minimum_gap = 0
)");
  EXPECT_LT(expect_a_sound_run(c), 0.99);
}

TEST(SolidLoop, SixtyShapesOfThePapersWheelSucceed_Slow) {
  const Case c = parsed(R"(
[wheel]
dimension = 3
[load]
positions = 4
[contact]
quadrature_points = 3
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
radial_cells = 12
angular_cells = 144
axial_cells = 4
[optimizer]
smoothing = 0.1
rim_band = 0.0117
tread_band = 0.0234
iterations = 60
tolerance = 0
)");
  EXPECT_LT(expect_a_sound_run(c), 0.8);
}

/// The paper's wheel between side faces that do not move along the axle, made in a way.
Study<3> between_side_faces(const std::string& made) {
  auto study = make_study<3>(parsed(R"(
[wheel]
dimension = 3
side_faces = "symmetric"
[contact]
quadrature_points = 3
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.04
[grid]
radial_cells = 14
angular_cells = 192
axial_cells = 2
tread_levels = 1
[volume]
target = 0.6614
[optimizer]
smoothing = 0.1
rim_band = 0.0101
tread_band = 0.0201
iterations = 60
made = ")" + made + "\"\n"));
  if (!study) throw std::runtime_error(study.failure().detail);
  return *std::move(study);
}

/// The last accepted state of a run that converges from a shape.
OptimizationState<3> converged(const Study<3>& study, const LevelSet<3>& initial) {
  std::optional<OptimizationState<3>> last;
  const auto outcome = optimize<3>(
      optimizer_of(study), initial,
      [&](const Trial<3>& trial, const OptimizationState<3>& state) {
        if (trial.verdict == Verdict::accepted) last = state;
      },
      [] { return false; });
  EXPECT_EQ(outcome.reason, StopReason::converged);
  return *last;
}

// Its energy has no first order along the axle, so that the best extruded shape is also stationary in a mould
// without draft. From other starts, a mould finds better shapes.
TEST(SolidLoop, AMouldWithoutDraftKeepsTheBestExtrudedShape_Slow) {
  const auto extruded = between_side_faces("extruded"), moulded = between_side_faces("moulded");
  const auto best = converged(extruded, extruded.initial), kept = converged(moulded, best.shape);
  EXPECT_NEAR(kept.measure, best.measure, 2e-6 * best.measure);
  const double in_mould = kept.evaluation.function("objective").value;
  EXPECT_NEAR(in_mould / best.evaluation.function("objective").value, 1, 0.002);
}

}  // namespace
}  // namespace wheelwright
