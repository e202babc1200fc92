#pragma once

#include <string>

#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Names of the files in a run's folder that show why it gave up.
inline constexpr const char *failure_report_file = "failure/report.txt",
                            *rejected_picture_file = "failure/rejected.svg";

/// Why a run could not continue; one line. `last` is its last accepted shape, null if there is none; `trials`
/// are the failed ones after it, in order, at least one.
template <int dim>
std::string failure_headline(const OptimizationState<dim>* last, std::span<const Trial<dim>> trials);

/// One line about the change of the volume, which may be why a run gave up; empty if the target was close to
/// the initial volume.
template <int dim>
std::string volume_hint(const InitialShape<dim>& initial, const OptimizationState<dim>& last);

/// For a run that gave up, writes diagnostics to the folder `failure`: report.txt with every failed trial, a
/// picture of the last one's shape, its level set and that of the last accepted shape, and the case.
template <int dim>
class FailureReport : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
};

}  // namespace wheelwright
