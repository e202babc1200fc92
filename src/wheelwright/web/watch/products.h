#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wheelwright/base/expected.h"
#include "wheelwright/run/observers/run_report.h"
#include "wheelwright/web/watch/board.h"

namespace wheelwright {

// Files that a user saves from a shape on a page. Thread-safe; the run does not wait.

/// Why there is no product; one line.
struct NoProduct {
  std::string reason;
};

/// The shape with its solution under a load case, for reports.
template <int dim>
SolvedShape<dim> solved(const WatchedShape<dim>& shape, int load_case = 0) {
  return {&shape.psi, shape.solver.get(), shape.solutions[load_case].get()};
}

/// The shape in a format of the command `export`, with its default tolerance, after the same checks.
Expected<std::string, NoProduct> exported(const WatchedShape<2>& shape, std::string_view format);
Expected<std::string, NoProduct> exported(const WatchedShape<3>& shape, std::string_view format);

/// The report page of the run in a folder, with this shape as the last one; `initial` is the first one.
template <int dim>
Expected<std::string, NoProduct> design_report(const std::filesystem::path& folder,
                                               const LevelSet<dim>& initial, const WatchedShape<dim>& shape);

/// Whether a text is a valid name of a design: letters, digits, - and _, at most 40 of them.
bool is_design_name(std::string_view name);

/// Saves the shape as a new case, designs/NAME.toml with its level set next to it; a run of it starts from
/// exactly this shape. Its volume target is that of the shape. Returns the case's file; refuses a name in
/// use, and shapes in 3D. Throws OutputError.
template <int dim>
Expected<std::filesystem::path, NoProduct> save_design(const std::filesystem::path& folder,
                                                       const std::string& name,
                                                       const WatchedShape<dim>& shape);

}  // namespace wheelwright
