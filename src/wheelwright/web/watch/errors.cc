#include "wheelwright/web/watch/errors.h"

#include <fmt/format.h>

#include <exception>
#include <nlohmann/json.hpp>

#include "wheelwright/base/process_settings.h"
#include "wheelwright/output/report/numbers_json.h"
#include "wheelwright/run/results/finer_wheel.h"
#include "wheelwright/run/results/own_numbers.h"
#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

/// The numbers of a shape under all load cases, with their errors; none are measured on the outline, where
/// the grid makes no error.
template <int dim>
SummarizedShape<dim> with_estimates(const WatchedShape<dim>& shape, const Interrupt& interrupt) {
  const Case& c = *shape.source;
  const StateSolver<dim>& solver = *shape.solver;
  const LoadCases<dim>& cases = *shape.load_cases;
  SummarizedShape<dim> result{
      shape.number, shape.objective,
      described_solution<dim>(solver, shape.psi, volume_fraction(solver.model().grid, shape.measure),
                              shape.solutions.front(), cases, own_numbers(c, solver, shape.psi))};
  const auto finer = finer_shape(c, solver, shape.psi);
  if (!finer) {
    set_missing_errors(finer.failure(), result);
    return result;
  }
  const auto states =
      finer->solver->states(finer->shape, distinct_positions(*finer->solver, cases, finer->shape), interrupt);
  set_errors<dim>(c, cases, *finer, states, result);
  return result;
}

/// The estimate as JSON.
template <int dim>
Json estimate_json(const BoardView<dim>& view, const Interrupt& interrupt) {
  const Stopwatch stopwatch;
  const SummarizedShape<dim> shape = with_estimates(*view.shape, interrupt);
  Json json = shape_json(shape, "");
  json["shape_version"] = view.shape_version;
  json["rows"] = shown_numbers(numbers_of(shape.wheel));
  json["seconds"] = stopwatch.seconds();
  return json;
}

std::string text(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

}  // namespace

template <int dim>
Expected<std::string, NoProduct> WatchedErrors<dim>::begin(const BoardView<dim>& view) {
  const std::scoped_lock lock(mutex_);
  if (is_closed_) return NoProduct{"the run has ended"};
  if (busy_)
    return NoProduct{
        fmt::format("the errors of shape {} are still being estimated, for {:.0f} s so far; wait for them",
                    busy_->shape, busy_->since.seconds())};
  busy_ = Busy{view.shape->number, Stopwatch()};
  worker_ = std::jthread([this, view](const std::stop_token& stop) {
    try {
      finish(text(estimate_json(view, Interrupt([&stop] { return stop.stop_requested(); }))));
    } catch (const std::exception& error) {
      finish(text(
          {{"shape", view.shape->number}, {"shape_version", view.shape_version}, {"failure", error.what()}}));
    }
    give_freed_memory_back();
  });
  return fmt::format("solving shape {} on a finer grid, for the errors of its numbers", view.shape->number);
}

template <int dim>
void WatchedErrors<dim>::finish(std::string estimate) {
  {
    const std::scoped_lock lock(mutex_);
    estimate_ = std::move(estimate);
    busy_.reset();
  }
  ended_.notify_all();
}

template <int dim>
std::string WatchedErrors<dim>::json(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, patience, [this] { return !busy_ || is_closed_; });
  const Json busy = busy_ ? Json{{"shape", busy_->shape}, {"seconds", busy_->since.seconds()}} : Json();
  return fmt::format(R"({{"busy":{},"estimate":{}}})", text(busy), estimate_);
}

template <int dim>
void WatchedErrors<dim>::close() {
  {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
    worker_.request_stop();
  }
  ended_.notify_all();
}

template class WatchedErrors<2>;
template class WatchedErrors<3>;

}  // namespace wheelwright
