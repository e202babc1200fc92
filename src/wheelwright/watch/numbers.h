#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/report/described_wheel.h"
#include "wheelwright/watch/board.h"

namespace wheelwright {

/// The numbers of a wheel that is watched, beside those of the initial shape under the same loads. They take
/// longer than the shape itself: pages ask for them now and then. Any thread may.
template <int dim>
class WatchedNumbers {
 public:
  /// As JSON: which shape and load case, how numbers are told, the numbers of both wheels in SI units, which
  /// the keys end in, and warnings in sentences.
  std::string json(const BoardView<dim>& view, int load_case);

 private:
  /// The initial shape under the loads of a case. The last one is remembered.
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
