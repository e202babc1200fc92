#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/design/explore/design.h"

namespace wheelwright {

// The designs of an exploration or a sweep in a folder, before any of them is run. Every process that runs or
// collects designs reads the same plan, so that the results do not depend on which process does what.

/// The file of a plan in its folder; the case of each design is designs/NAME.toml.
inline constexpr const char* plan_file = "plan.json";

/// The designs of one folder and how they are compared.
struct DesignPlan {
  std::string name;              ///< of the files with the results: explore or sweep
  std::string title;             ///< of page and picture
  bool has_previews = false;     ///< all are previewed and some are chosen; else all run to the end
  bool solves_finalists = true;  ///< on a finer grid (design/explore/finalists.h)
  bool is_complete = true;       ///< false: generation was cut short, and would find more designs
  std::vector<RankedQuantity> quantities = {};
  std::vector<Design> designs = {};
};

/// Writes the case of each design, the drawings that they refer to, and at last the plan itself, so that a
/// folder with a plan has all of it. Throws OutputError.
void write_plan(const std::filesystem::path& folder, const DesignPlan& plan);

/// Why a folder has no usable plan; one line.
struct PlanProblem {
  std::string text;
};

/// The plan in a folder. Reading what write_plan() wrote gives equal designs, to the last bit.
Expected<DesignPlan, PlanProblem> read_plan(const std::filesystem::path& folder);

}  // namespace wheelwright
