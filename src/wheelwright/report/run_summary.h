#pragma once

#include <string>
#include <vector>

#include "wheelwright/report/described_wheel.h"

namespace wheelwright {

/// A shape of a run, in numbers.
template <int dim>
struct SummarizedShape {
  int iteration;     ///< 0: the initial shape
  double objective;  ///< sum over the load positions of a sector
  DescribedWheel<dim> wheel;
};

/// A bound of a quantity that the run was to keep, at the last shape. In SI units; in 2D forces, energies,
/// masses and stiffnesses per metre of width.
struct SummarizedBound {
  std::string name;
  double value, bound;
  char relation;      ///< '<', '>' or '='
  double multiplier;  ///< of the objective, per unit of the bound
  bool is_kept;
};

/// What a run made of the initial shape. Both shapes are solved alike: on a tread of the same resolution.
template <int dim>
struct RunSummary {
  std::string title;
  SummarizedShape<dim> before, after;
  std::vector<SummarizedBound> bounds = {};
  /// What is minimized in place of the weighted sum, with its unit; empty for the sum.
  std::string minimized = {};
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
