#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/diagnostic.h"
#include "wheelwright/case/fitting_grid.h"

namespace wheelwright {

/// A case, or all problems of its file in the order of the file, followed by those of its drawings.
struct CaseResult {
  std::optional<Case> value;  ///< present if and only if there are no problems
  std::vector<Diagnostic> problems;
  GivenCells given_cells = {};  ///< the other grid sizes follow from the rest of the case
};

/// Reads and checks a case file, which can have the words of `vocabulary`.
CaseResult read_case(const std::filesystem::path& file, const Vocabulary& vocabulary = {});

/// The same for a text; `file` is its name in messages and determines the default of output.folder and the
/// folder of the drawings.
CaseResult parse_case(std::string_view text, const std::filesystem::path& file,
                      const Vocabulary& vocabulary = {});

}  // namespace wheelwright
