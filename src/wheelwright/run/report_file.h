#pragma once

#include "wheelwright/base/stopwatch.h"
#include "wheelwright/run/observer.h"

namespace wheelwright {

/// Writes report.html at the end, and every few seconds while the run goes on, for a browser that follows it;
/// keeps the outlines of all accepted shapes for it. In 2D: its pictures are plane.
class ReportFile : public Observer<2> {
 public:
  void operator()(const Event<2>& event, const RunView<2>& run) override;

 private:
  Stopwatch since_written_;
  double waited_ = 0;  ///< since the page was written [s]
};

}  // namespace wheelwright
