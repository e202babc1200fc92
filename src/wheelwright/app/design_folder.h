#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/app/options.h"
#include "wheelwright/app/signals.h"
#include "wheelwright/base/expected.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/case/case.h"
#include "wheelwright/design/explore/exploration.h"
#include "wheelwright/design/explore/plan.h"

namespace wheelwright {

/// Options of the commands that plan designs.
struct PlanOptions {
  std::optional<std::string> output, quantities;
  bool only_plans = false;

  /// --output, --for, --plan
  void declare(Options& options);

  /// The quantities named by --for. Default: what the case minimizes, if it is one of them, or else
  /// stiffness; and run-out, or the radial force variation if the travel is prescribed.
  /// Fails, in words, if --for names one that the case does not have.
  Expected<std::vector<RankedQuantity>, std::string> chosen_quantities(const Case& c) const;

  /// The case's folder with a suffix, e.g. runs/wheel-explore, unless --output gives another one.
  std::filesystem::path folder_for(const Case& c, const std::string& ending) const;
};

/// The folder of an exploration or a sweep, as the commands find it that plan its designs.
struct DesignFolder {
  std::string command;  ///< explore or sweep
  std::filesystem::path folder;
  std::string settings;  ///< all that determines the designs, as text

  /// Whether the folder is free or contains designs of these settings. Otherwise prints why: the command ends
  /// with exit_refused.
  bool may_be_used() const;

  /// The plan in the folder if it is complete and ranks by these quantities.
  std::optional<DesignPlan> known_plan(const std::vector<RankedQuantity>& quantities) const;

  /// Writes the plan that `plan` returns, while the folder is locked, and returns it as others read it. Fails
  /// with an ExitCode, that of `plan` or exit_refused after a message if another process is writing to the
  /// folder. Throws OutputError.
  Expected<DesignPlan, int> planned(const std::function<Expected<DesignPlan, int>()>& plan) const;
};

/// Settings to generate `n_starts` starts until `must_end`. Reports failed attempts if generation takes long
/// or yields fewer starts.
DrawingSettings drawing_settings(int n_starts, std::function<bool()> must_end);

}  // namespace wheelwright
