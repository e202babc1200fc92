#pragma once

#include <filesystem>

#include "wheelwright/case/case.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/output/page/report_run.h"
#include "wheelwright/run/results/shown_wheel.h"

namespace wheelwright {

/// The outlines of a run's accepted shapes, one line each, in the order of the shapes.
inline constexpr const char* outline_file = "outlines.jsonl";

/// Maximum number of outlines in the report of a long run.
inline constexpr std::size_t max_outlines = 400;

/// The lines of the file, evenly thinned to about max_outlines including the first and the last one; corrupt
/// lines, as the last one may be after a kill, are omitted.
std::vector<ShapeOutline> read_outlines(const std::filesystem::path& folder);

/// The report of a run in progress, from its folder.
template <int dim>
ReportRun<dim> report_of_folder(const std::filesystem::path& folder, const Case& c);

/// The report of a finished run, with its last shape as `wheel`. `reason` is absent if it is not known to
/// have ended.
template <int dim>
ReportRun<dim> report_of_results(const std::filesystem::path& folder, const Case& c,
                                 const RunSummary<dim>& summary, const SolvedShape<dim>& last,
                                 ShownWheel<dim> wheel, std::optional<StopReason> reason);

/// The same for a run that ended without results: its first shape could not be solved, or there was no time.
template <int dim>
ReportRun<dim> report_without_results(const std::filesystem::path& folder, const Case& c, StopReason reason);

}  // namespace wheelwright
