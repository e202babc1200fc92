#pragma once

#include <memory>

#include "wheelwright/run/observers/observer.h"
#include "wheelwright/web/watch/board.h"

namespace wheelwright {

/// Shows a run on a board. Costs the run almost nothing: it copies the nodal values of the shape.
template <int dim>
class BoardObserver : public Observer<dim> {
 public:
  explicit BoardObserver(std::shared_ptr<Board<dim>> board) : board_(std::move(board)) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  void show(const TrialDone<dim>& done, const RunView<dim>& run);

  std::shared_ptr<Board<dim>> board_;
  std::shared_ptr<const Case> source_;  ///< as long as it does not change
  std::shared_ptr<const LoadCases<dim>> load_cases_;
};

}  // namespace wheelwright
