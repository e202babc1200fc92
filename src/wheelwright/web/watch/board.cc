#include "wheelwright/web/watch/board.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

/// Maximum number of points of a curve that a page draws.
constexpr std::size_t max_points = 4000;

template <int dim>
double measure_named(const WatchedShape<dim>& shape, std::string_view name) {
  const auto found = std::ranges::find(shape.measures, name, &MeasureValue::name);
  return found == shape.measures.end() ? std::nan("") : found->value;
}

}  // namespace

template <int dim>
void Board<dim>::show(std::shared_ptr<const WatchedShape<dim>> shape) {
  HistoryPoint point{.version = 0,
                     .shape = shape->number,
                     .objective = shape->objective,
                     .mean_travel = measure_named(*shape, "mean_travel"),
                     .run_out = measure_named(*shape, "run_out"),
                     .volume_fraction = shape->measure / sector_measure<dim>(shape->psi.lattice.grid()),
                     .initial_objective = shape->initial_objective};
  update([&](BoardView<dim>& view) {
    view.proposed.reset();
    if (!view.first) view.first = shape;
    view.shape = std::move(shape);
    point.version = view.shape_version = view.version + 1;
    curve_.push_back(point);
    if (curve_.size() > max_points) curve_.pop_front();
  });
}

template <int dim>
BoardView<dim> Board<dim>::view() const {
  const std::scoped_lock lock(mutex_);
  return view_;
}

template <int dim>
BoardView<dim> Board<dim>::view_after(long version, std::chrono::milliseconds patience) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return is_closed_ || view_.version > version; });
  return view_;
}

template <int dim>
std::vector<HistoryPoint> Board<dim>::curve_after(long version) const {
  const std::scoped_lock lock(mutex_);
  const auto first = std::ranges::upper_bound(curve_, version, {}, &HistoryPoint::version);
  return {first, curve_.end()};
}

template <int dim>
void Board<dim>::close() {
  {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
}

template class Board<2>;
template class Board<3>;

}  // namespace wheelwright
