#pragma once

#include <string>

#include "wheelwright/analysis/shape_summary.h"

namespace wheelwright {

/// A shape of a run, in numbers.
template <int dim>
struct SummarizedShape {
  int iteration;           ///< 0: the initial shape
  double objective;        ///< sum over the load positions of a sector
  double volume_fraction;  ///< material area over the area of the full ring
  ShapeSummary<dim> measured;
};

/// What a run made of the initial shape. Both shapes are solved alike: on a tread of the same resolution.
template <int dim>
struct RunSummary {
  std::string title;
  std::string load;  ///< for people, e.g. "24525 N/m"
  double width;      ///< w_r [m]
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
