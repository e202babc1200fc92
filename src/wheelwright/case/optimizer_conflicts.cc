#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

/// The paper's rules need steepest descent.
void check_method(const Case& c, Conflicts& found) {
  if (c.optimizer.velocity == VelocityKind::vector && optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{key_of(&Optimizer::velocity), key_of(&Optimizer::method), key_of(&Volume::control)},
                     "steepest descent moves the boundary by a speed along its normal",
                     "use velocity = \"h1\", or method = \"sequential_quadratic\" with volume.control = "
                     "\"exact\""});
  if (c.optimizer.method != OptimizerMethod::sequential_quadratic) return;
  const auto refuse = [&](const CaseKey& key, const char* other) {
    found.push_back({{key, key_of(&Optimizer::method)},
                     "it is valid only with steepest descent",
                     fmt::format("use method = \"descent\" or omit the key, or use {}", other)});
  };
  if (c.optimizer.velocity == VelocityKind::harmonic) refuse(key_of(&Optimizer::velocity), "\"h1\"");
  if (c.volume.control == VolumeControl::paper) refuse(key_of(&Volume::control), "\"exact\"");
}

/// The topological derivative is that of a plane hole without load on its edge.
void check_nucleation(const Case& c, Conflicts& found) {
  if (c.optimizer.nucleation == NucleationTime::never) return;
  const auto refuse = [&](CaseKeys keys, std::string problem) {
    found.push_back({std::move(keys), std::move(problem), "use nucleation = \"never\""});
  };
  if (c.wheel.dimension == 3)
    refuse({key_of(&Optimizer::nucleation), key_of(&Wheel::dimension)}, "nucleation is supported only in 2D");
  const std::vector<SingleLoad> loads = single_loads(c);
  const auto has_pressure = [](const SingleLoad& single) { return single.c.load.hole_pressure != 0; };
  if (const auto pressed = std::ranges::find_if(loads, has_pressure); pressed != loads.end())
    refuse({key_of(&Optimizer::nucleation), pressed->key(&Load::hole_pressure)},
           "nucleation does not support hole pressure");
  const std::vector<PlacedMaterial> ring = placed_materials(c);
  const auto orthotropic = std::ranges::find_if(ring, &PlacedMaterial::orthotropic);
  if (orthotropic != ring.end() && optimizes_stresses(c))
    refuse({key_of(&Optimizer::nucleation), key_of(&Objective::minimize), orthotropic->youngs_modulus_key()},
           "the effect of new holes on stresses is known only in isotropic materials");
  if (optimizes_temperatures(c))
    refuse({key_of(&Optimizer::nucleation), key_of(&Objective::minimize)},
           "the effect of new holes on the temperature is not known");
}

}  // namespace

void optimizer_conflicts(const Case& c, Conflicts& found) {
  check_method(c, found);
  check_nucleation(c, found);
}

}  // namespace wheelwright
