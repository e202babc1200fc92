#pragma once

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/observer.h"

namespace wheelwright {

/// Writes report.html at the end, and every few seconds while the run goes on, for a browser that follows it;
/// keeps the outlines of all accepted shapes for it.
template <int dim>
class ReportFile : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  Stopwatch since_written_;
  double waited_ = 0;  ///< since the page was written [s]
};

}  // namespace wheelwright
