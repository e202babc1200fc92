#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

namespace {

/// The paper's rules need steepest descent.
void check_method(const Case& c, Conflicts& found) {
  if (c.optimizer.velocity == VelocityKind::vector && optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{"optimizer.velocity", "optimizer.method", "volume.control"},
                     "steepest descent moves the boundary by a speed along its normal",
                     "use velocity = \"h1\", or method = \"sequential_quadratic\" with volume.control = "
                     "\"exact\""});
  if (c.optimizer.method != OptimizerMethod::sequential_quadratic) return;
  const auto refuse = [&](const char* key, const char* other) {
    found.push_back({{key, "optimizer.method"},
                     "it is valid only with steepest descent",
                     fmt::format("use method = \"descent\" or omit the key, or use {}", other)});
  };
  if (c.optimizer.velocity == VelocityKind::harmonic) refuse("optimizer.velocity", "\"h1\"");
  if (c.volume.control == VolumeControl::paper) refuse("volume.control", "\"exact\"");
}

/// The topological derivative is that of a plane hole without load on its edge.
void check_nucleation(const Case& c, Conflicts& found) {
  if (c.optimizer.nucleation == NucleationTime::never) return;
  const auto refuse = [&](std::vector<std::string> keys, std::string problem) {
    found.push_back({std::move(keys), std::move(problem), "use nucleation = \"never\""});
  };
  if (c.wheel.dimension == 3)
    refuse({"optimizer.nucleation", "wheel.dimension"}, "nucleation is supported only in 2D");
  const auto has_pressure = [](const Case& single) { return single.load.hole_pressure != 0; };
  if (std::ranges::any_of(single_load_cases(c), has_pressure))
    refuse({"optimizer.nucleation", "load.hole_pressure", "load.case"},
           "nucleation does not support hole pressure");
}

}  // namespace

void optimizer_conflicts(const Case& c, Conflicts& found) {
  check_method(c, found);
  check_nucleation(c, found);
}

}  // namespace wheelwright
