#pragma once

#include <filesystem>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"
#include "wheelwright/output/page/report_run.h"
#include "wheelwright/run/checkpoints/checkpoint.h"

namespace wheelwright {

/// What the page shows of a run in a folder, from one of its checkpoints: solves the given wheel and the
/// checkpoint's shape again, for results that the folder does not keep. Fails as the solver does.
template <int dim>
Expected<PageRun> solved_page_run(const std::filesystem::path& folder, const Case& c,
                                  const Checkpoint<dim>& checkpoint, const Interrupt& interrupt);

}  // namespace wheelwright
