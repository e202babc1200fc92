#pragma once

#include "wheelwright/run/session/journal.h"
#include "wheelwright/run/session/session.h"

namespace wheelwright {

/// What a run does next.
enum class Next {
  search,  ///< for better shapes, from the session's state
  obey,    ///< a command ended an evaluation early: first execute it
  end,     ///< nothing is left to do
};

/// The stages of a run besides its search: the grids, from coarse to fine, and new holes. Enters them in the
/// session and records them; stages that fail are reported (StageFailed) and left out.
template <int dim>
class Schedule {
 public:
  /// The arguments must outlive this.
  Schedule(Session<dim>& session, Journal<dim>& journal) : session_(session), journal_(journal) {}

  /// Before the first search: moves the initial shape to the coarsest grid on which it can be solved.
  Next begin();

  /// At the end of a search. First judges the newest holes, and creates others where they pay; then moves to
  /// the next finer grid. Fails if the shape cannot be solved there.
  Expected<Next> after(StopReason reason);

 private:
  bool begins_on_coarser_grid() const;
  Next change_holes(StopReason reason);
  Next make_holes();
  Next undo_holes(StopReason reason);
  Next without_more_holes(const Failure& failure);
  Expected<Next> refine_grid(StopReason reason);
  void enter_grid(Stage<dim> stage);

  Session<dim>& session_;
  Journal<dim>& journal_;
};

}  // namespace wheelwright
