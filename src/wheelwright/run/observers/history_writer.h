#pragma once

#include <optional>

#include "wheelwright/run/checkpoints/history.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Writes history.csv: one row per trial shape. A change of the case, the grid, or the shape by a command is
/// an event in the row of the shape evaluated next; a functional that it adds gets a column, which is empty
/// in earlier rows.
template <int dim>
class HistoryWriter : public Observer<dim> {
 public:
  explicit HistoryWriter(const std::optional<Checkpoint<dim>>& resumed);

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
  void add_to(Checkpoint<dim>& checkpoint) override;

 private:
  void open(const RunView<dim>& run);
  void add_missing_columns(const RunView<dim>& run);
  void record(const TrialDone<dim>& done, const RunView<dim>& run);

  std::optional<HistoryMark> resumed_at_;
  std::optional<History> history_;
  HistoryMark accepted_;            ///< its end at the last accepted shape
  std::vector<std::string> notes_;  ///< for the next row
};

}  // namespace wheelwright
