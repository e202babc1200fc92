#pragma once

#include <memory>

#include "wheelwright/run/observer.h"
#include "wheelwright/watch/board.h"

namespace wheelwright {

/// Shows a run on a board. Costs the run next to nothing: it copies the nodal values of the shape.
class BoardObserver : public Observer<2> {
 public:
  explicit BoardObserver(std::shared_ptr<Board> board) : board_(std::move(board)) {}

  void operator()(const Event<2>& event, const RunView<2>& run) override;

 private:
  void show(const TrialDone<2>& done, const RunView<2>& run);

  std::shared_ptr<Board> board_;
  std::shared_ptr<const Case> source_;  ///< as long as it does not change
};

}  // namespace wheelwright
