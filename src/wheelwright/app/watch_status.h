#pragma once

#include <cstdio>
#include <string>

#include "wheelwright/app/progress.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Prints the status of a watched run in one line; the page shows the rest. On a terminal the line repaints
/// itself; otherwise a line is written only when the run starts to compute, starts to wait or ends.
template <int dim>
class WatchStatus : public Observer<dim> {
 public:
  /// `stream` must outlive this.
  explicit WatchStatus(std::FILE* stream)
      : stream_(stream), repaints_(progress_style(stream) != ProgressStyle::lines) {}
  WatchStatus(const WatchStatus&) = delete;
  WatchStatus& operator=(const WatchStatus&) = delete;
  ~WatchStatus() override;

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  void show_activity(const std::string& activity);
  void show() const;

  std::FILE* stream_;
  bool repaints_;
  bool is_shown_ = false;
  std::string shape_, activity_;
};

}  // namespace wheelwright
