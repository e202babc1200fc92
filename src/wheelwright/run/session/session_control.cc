#include "wheelwright/run/session/session_control.h"

#include <algorithm>

#include "wheelwright/run/checkpoints/case_file.h"
#include "wheelwright/run/session/replacements.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

template <int dim>
bool SessionControl<dim>::obey() {
  const int stages = stages_;
  while (!is_stopped_) {
    const auto command = commands_.take();
    if (!command) break;
    execute(*command);
  }
  wait_while_paused();
  return is_stopped_ || stages_ != stages;
}

template <int dim>
void SessionControl<dim>::execute(const Command& command) {
  const CommandResult executed = command.execute(*this);
  if (executed)
    journal_.notify(CommandDone{command, *executed, true});
  else
    journal_.notify(CommandDone{command, executed.failure().reason, false});
}

template <int dim>
bool SessionControl<dim>::is_paused() const {
  return !is_stopped_ && pause_at_ && session_.state().iteration >= *pause_at_;
}

template <int dim>
void SessionControl<dim>::wait_while_paused() {
  if (!is_paused()) return;
  journal_.stop_clock();
  save();
  journal_.notify(RunWaits{});
  while (is_paused()) execute(commands_.wait());
  journal_.notify(RunProceeds{});
  journal_.start_clock();
}

template <int dim>
void SessionControl<dim>::wait_for_more(StopReason reason) {
  journal_.stop_clock();
  save();
  search_end_ = reason;
  journal_.notify(RunWaits{reason});
  while (!is_stopped_ && search_end_) {
    const bool was_paused = is_paused();
    execute(commands_.wait());
    if (search_end_ && is_paused() && !was_paused) journal_.notify(RunWaits{});
  }
  search_end_.reset();
  journal_.notify(RunProceeds{});
  journal_.start_clock();
}

template <int dim>
std::optional<Refusal> SessionControl<dim>::pause(int after_shapes) {
  const int now = session_.state().iteration;
  const int from = after_shapes > 0 ? std::max(now, pause_at_.value_or(0)) : now;
  if (after_shapes > 0 && search_end_)
    if (auto refusal = search_again()) return refusal;
  pause_at_ = from + after_shapes;
  return {};
}

template <int dim>
std::optional<Refusal> SessionControl<dim>::continue_run() {
  if (search_end_)
    if (auto refusal = search_again()) return refusal;
  pause_at_.reset();
  return {};
}

template <int dim>
std::optional<Refusal> SessionControl<dim>::search_again() {
  return continue_at(session_.state().shape, "one more search for better shapes");
}

template <int dim>
std::optional<Refusal> SessionControl<dim>::change_case(const Case& changed, const std::string& what) {
  Past<dim> past = session_.present(what);
  if (auto refusal = continue_under(changed, session_.state().shape, what)) return refusal;
  session_.remember(std::move(past));
  return {};
}

template <int dim>
std::vector<Point> SessionControl<dim>::hole_at(const Point& point) const {
  if constexpr (dim == 2)
    return hole_contour(session_.state().shape, point);
  else
    return {};
}

template <int dim>
std::optional<Refusal> SessionControl<dim>::draw(std::span<const Stroke> strokes, const std::string& what) {
  const auto bench = session_.bench();
  const double largest_island =
      bench->study.optimizer.largest_island * sector_measure<dim>(bench->study.grid());
  const auto shape = drawn_over(session_.state().shape, strokes, bench->optimizer.evolver(), largest_island);
  if (!shape) return shape.failure();
  return change_shape(*shape, what);
}

template <int dim>
std::optional<Refusal> SessionControl<dim>::take_shape(const std::filesystem::path& file,
                                                       const std::string& what) {
  const auto shape =
      shape_of_file(file, session_.state().shape.lattice, session_.bench()->optimizer.evolver());
  if (!shape) return shape.failure();
  return change_shape(*shape, what);
}

template <int dim>
std::optional<Refusal> SessionControl<dim>::reset() {
  return change_shape(session_.initial()->shape, "back to the initial shape");
}

template <int dim>
Expected<std::string, Refusal> SessionControl<dim>::undo() {
  if (session_.past().empty()) return Refusal{"there is nothing to undo"};
  const Past<dim> past = session_.past().back();
  const std::string what = "undo";
  if (auto refusal = past.source == current_case() ? continue_at(past.shape, what)
                                                   : continue_under(past.source, past.shape, what))
    return *std::move(refusal);
  session_.forget_newest();
  return past.change;
}

/// A change of the shape that can be undone. The same shape again, as after a double click, is none.
template <int dim>
std::optional<Refusal> SessionControl<dim>::change_shape(const LevelSet<dim>& shape,
                                                         const std::string& what) {
  Past<dim> past = session_.present(what);
  if (auto refusal = continue_at(shape, what)) return refusal;
  if (shape.values != past.shape.values) session_.remember(std::move(past));
  return {};
}

/// Continues under another case, possibly also from another shape.
template <int dim>
std::optional<Refusal> SessionControl<dim>::continue_under(const Case& changed, const LevelSet<dim>& shape,
                                                           const std::string& what) {
  const auto c = accepted_case(changed, folder_ / case_file);
  if (!c) return c.failure();
  auto stage = session_.under(*c, shape);
  if (!stage) return stage.failure();
  continue_from(*std::move(stage), CaseChanged{what});
  write_case_file(folder_, current_case());  // after the checkpoint of that case
  return {};
}

/// Continues from another shape under the same case.
template <int dim>
std::optional<Refusal> SessionControl<dim>::continue_at(const LevelSet<dim>& shape, const std::string& what) {
  if (shape.values != session_.state().shape.values) journal_.notify(ShapeProposed<dim>{shape});
  auto stage = session_.at(shape);
  if (!stage) return refusal(stage.failure());
  continue_from(*std::move(stage), ShapeReplaced{what});
  return {};
}

template <int dim>
void SessionControl<dim>::continue_from(Stage<dim> stage, const Event<dim>& change) {
  search_end_.reset();
  ++stages_;
  enter(session_, journal_, std::move(stage), change);
}

template class SessionControl<2>;
template class SessionControl<3>;

}  // namespace wheelwright
