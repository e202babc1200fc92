#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/web/watch/board.h"

namespace wheelwright {

/// The numbers of a watched wheel and of the initial shape under the same loads. They take longer than the
/// shape itself, so pages request them only from time to time. Thread-safe.
template <int dim>
class WatchedNumbers {
 public:
  /// As JSON: shape and load case, how to display numbers, the numbers of both wheels in SI units, named at
  /// the end of the keys, and warnings in sentences.
  std::string json(const BoardView<dim>& view, int load_case);

 private:
  /// The initial shape under the loads of a case. The last one is cached.
  struct Initial {
    std::shared_ptr<const Case> source;
    std::shared_ptr<const StateSolver<dim>> solver;
    int load_case;
    DescribedWheel<dim> wheel;
  };
  DescribedWheel<dim> initial_wheel(const BoardView<dim>& view, int load_case);

  std::mutex mutex_;
  std::vector<Initial> initial_;
};

}  // namespace wheelwright
