#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wheelwright/base/expected.h"
#include "wheelwright/watch/board.h"

namespace wheelwright {

// What a user takes away from a shape on a page. Any thread may make it; the run does not wait.

/// Why there is none: one line.
struct NoProduct {
  std::string reason;
};

/// The loaded wheel in all load positions, as the report's JSON has it.
std::string loaded_wheel(const WatchedShape& shape);

/// The shape in a format of the command `export`, with its default tolerance, after the same checks.
Expected<std::string, NoProduct> exported(const WatchedShape& shape, std::string_view format);

/// The report page of the run in a folder, with this shape as its last one; `initial` is its first one.
Expected<std::string, NoProduct> design_report(const std::filesystem::path& folder,
                                               const LevelSet<2>& initial, const WatchedShape& shape);

/// Whether a text is a name of a design: letters, digits, - and _, at most 40 of them.
bool is_design_name(std::string_view name);

/// Saves the shape as a case of its own, designs/NAME.toml with its level set beside it: a run of it begins
/// with the same bits. The material that the shape has is its target. Returns the case's file; refuses a name
/// that is taken. Throws OutputError.
Expected<std::filesystem::path, NoProduct> save_design(const std::filesystem::path& folder,
                                                       const std::string& name, const WatchedShape& shape);

}  // namespace wheelwright
