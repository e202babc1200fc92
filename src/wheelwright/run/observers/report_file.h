#pragma once

#include <optional>

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/observers/observer.h"
#include "wheelwright/run/results/shown_wheel.h"

namespace wheelwright {

/// Writes report.html at the end, and during the run for a browser that follows it: every few seconds, or
/// less often if that would take more than a hundredth of the time. Keeps the outlines of all accepted shapes
/// for it.
template <int dim>
class ReportFile : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  ReportRun<dim> report_of_end(const RunEnded<dim>& ended, const RunView<dim>& run);

  std::optional<ShownPositions<dim>> positions_;  ///< of the last shape, while they are being received
  Stopwatch clock_;
  double waited_ = 0;  ///< since the page was written [s]
  double wait_ = 0;    ///< between pages, in proportion to the time for the last one [s]
};

}  // namespace wheelwright
