#pragma once

#include <filesystem>

#include "wheelwright/case/case.h"
#include "wheelwright/optimize/optimizer.h"
#include "wheelwright/page/report_run.h"
#include "wheelwright/run/shown_wheel.h"

namespace wheelwright {

/// The outlines of a run's accepted shapes, one line each, in the order of the shapes.
inline constexpr const char* outline_file = "outlines.jsonl";

/// So many does a report show of a long run.
inline constexpr std::size_t most_outlines = 400;

/// The lines of the file, evenly thinned to about most_outlines with the first and the last one; lines that
/// are damaged, as the last one may be after a kill, are left out.
std::vector<ShapeOutline> read_outlines(const std::filesystem::path& folder);

/// What is known of a run while it goes on: what its folder says.
template <int dim>
ReportRun<dim> report_of_folder(const std::filesystem::path& folder, const Case& c);

/// What is known of a run that ended, with its last shape, which is shown as `wheel`. `reason` is absent
/// where it is not known to have ended.
template <int dim>
ReportRun<dim> report_of_results(const std::filesystem::path& folder, const Case& c,
                                 const RunSummary<dim>& summary, const SolvedShape<dim>& last,
                                 ShownWheel<dim> wheel, std::optional<StopReason> reason);

/// The same of a run that ended without results: its first shape could not be solved, or there was no time.
template <int dim>
ReportRun<dim> report_without_results(const std::filesystem::path& folder, const Case& c, StopReason reason);

}  // namespace wheelwright
