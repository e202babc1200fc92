#include "wheelwright/run/results/turned_wheel.h"

#include <fmt/format.h>

#include "wheelwright/case/version.h"
#include "wheelwright/run/study/layer_shapes.h"

namespace wheelwright {
namespace {

using ProfileFaults = std::vector<cad::OutlineFault>;

struct CheckedProfile {
  cad::Outline profile;
  cad::ProfileReport report;
};

Expected<CheckedProfile, ProfileFaults> checked_profile(const TurnedSection& section, double tolerance) {
  auto profile = cad::fit_profile(section, tolerance);
  if (!profile) return ProfileFaults{profile.failure()};
  auto report = cad::check_profile(*profile, section, tolerance);
  if (!report) return report.failure();
  return CheckedProfile{*std::move(profile), *std::move(report)};
}

/// The layers end at circles about the axle: they have the parts of the section between these radii.
ProfileFaults add_layer_profiles(const Case& c, const LevelSet<3>& shape, const TurnedSection& section,
                                 TurnedModel& wheel) {
  const auto layers = layer_shapes(c, shape);
  if (layers.empty()) return {};
  std::vector<double> radii = cutting_radii(c, wheel.tolerance);
  radii.insert(radii.begin(), section.inner_radius());
  radii.push_back(section.outer_radius());
  ProfileFaults faults;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    auto part = checked_profile(section.between(radii[k], radii[k + 1]), wheel.tolerance);
    if (part)
      wheel.layers.push_back({layers[k].name, std::move(part->profile)});
    else
      for (const cad::OutlineFault& fault : part.failure())
        faults.push_back({fmt::format("{}: {}", layers[k].name, fault.what)});
  }
  return faults;
}

}  // namespace

Expected<FittedTurnedWheel, ProfileFaults> fitted_turned_wheel(const Case& c, const LevelSet<3>& shape,
                                                               std::string title, double tolerance) {
  const TurnedSection section(shape);
  auto whole = checked_profile(section, tolerance);
  if (!whole) return whole.failure();
  TurnedModel model{.title = std::move(title),
                    .program = fmt::format("wheelwright {}", version()),
                    .outline = std::move(whole->profile),
                    .width = section.width(),
                    .outer_radius = section.outer_radius(),
                    .tolerance = tolerance};
  if (ProfileFaults faults = add_layer_profiles(c, shape, section, model); !faults.empty()) return faults;
  return FittedTurnedWheel{std::move(model), whole->report};
}

}  // namespace wheelwright
