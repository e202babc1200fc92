#pragma once

#include <string>

#include "wheelwright/report/described_wheel.h"

namespace wheelwright {

/// A shape of a run, in numbers.
template <int dim>
struct SummarizedShape {
  int iteration;     ///< 0: the initial shape
  double objective;  ///< sum over the load positions of a sector
  DescribedWheel<dim> wheel;
};

/// What a run made of the initial shape. Both shapes are solved alike: on a tread of the same resolution.
template <int dim>
struct RunSummary {
  std::string title;
  SummarizedShape<dim> before, after;
};

/// For people: one line per quantity with both values and the change, and the place of the peak stress.
/// Forces are shown on the whole width.
template <int dim>
std::string summary_table(const RunSummary<dim>& summary);

/// For programs: the same in SI units, which the names of the keys end in. Numbers read back to the same
/// double.
template <int dim>
std::string summary_json(const RunSummary<dim>& summary);

}  // namespace wheelwright
