#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "wheelwright/base/expected.h"
#include "wheelwright/run/run_report.h"
#include "wheelwright/watch/board.h"

namespace wheelwright {

// What a user takes away from a shape on a page. Any thread may make it; the run does not wait.

/// Why there is none: one line.
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

/// The report page of the run in a folder, with this shape as its last one; `initial` is its first one.
template <int dim>
Expected<std::string, NoProduct> design_report(const std::filesystem::path& folder,
                                               const LevelSet<dim>& initial, const WatchedShape<dim>& shape);

/// Whether a text is a name of a design: letters, digits, - and _, at most 40 of them.
bool is_design_name(std::string_view name);

/// Saves the shape as a case of its own, designs/NAME.toml with its level set beside it: a run of it begins
/// with the same bits. The material that the shape has is its target. Returns the case's file; refuses a name
/// that is taken, and shapes in 3D, with which no case begins. Throws OutputError.
template <int dim>
Expected<std::filesystem::path, NoProduct> save_design(const std::filesystem::path& folder,
                                                       const std::string& name,
                                                       const WatchedShape<dim>& shape);

}  // namespace wheelwright
