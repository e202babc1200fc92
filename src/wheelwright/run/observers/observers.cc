#include "wheelwright/run/observers/observers.h"

#include "wheelwright/case/layers.h"
#include "wheelwright/run/observers/checkpointer.h"
#include "wheelwright/run/observers/descent_pictures.h"
#include "wheelwright/run/observers/expectations.h"
#include "wheelwright/run/observers/failure_report.h"
#include "wheelwright/run/observers/history_writer.h"
#include "wheelwright/run/observers/pressure_files.h"
#include "wheelwright/run/observers/report_file.h"
#include "wheelwright/run/observers/result_files.h"
#include "wheelwright/run/observers/shape_files.h"
#include "wheelwright/run/observers/summary_file.h"

namespace wheelwright {

template <int dim>
Observers<dim> make_observers(const Case& c, const CheckpointFolder& checkpoints,
                              const std::optional<Checkpoint<dim>>& resumed) {
  Observers<dim> observers;
  observers.push_back(std::make_unique<HistoryWriter<dim>>(resumed));
  observers.push_back(std::make_unique<ShapeFiles<dim>>());
  observers.push_back(std::make_unique<ShapePictures<dim>>());
  if constexpr (dim == 2) observers.push_back(std::make_unique<DescentPictures>());
  observers.push_back(std::make_unique<ExpectationWatch<dim>>(placed_expectations(c), resumed));
  observers.push_back(std::make_unique<PressureFiles<dim>>());
  observers.push_back(std::make_unique<ResultFiles<dim>>());
  observers.push_back(std::make_unique<FailureReport<dim>>());
  observers.push_back(std::make_unique<SummaryFile<dim>>());
  observers.push_back(std::make_unique<ReportFile<dim>>());
  observers.push_back(std::make_unique<Checkpointer<dim>>(checkpoints, resumed));
  return observers;
}

template decltype(make_observers<2>) make_observers<2>;
template decltype(make_observers<3>) make_observers<3>;

}  // namespace wheelwright
