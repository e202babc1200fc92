#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/units.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/output/report/made_wheel.h"
#include "wheelwright/output/report/remark.h"

namespace wheelwright {

/// A shape of a run, as numbers.
template <int dim>
struct SummarizedShape {
  int iteration;          ///< 0: the initial shape
  KnownNumber objective;  ///< sum over the load positions of a sector
  DescribedWheel<dim> wheel;
  /// The estimate of the objective's discretization error, or why there is none; nothing: not wanted.
  std::optional<KnownNumber> objective_error = {};
};

/// Whether a bound is kept on a finer grid.
enum class FinerVerdict {
  kept,          ///< by the value with its error
  within_error,  ///< not known: the bound lies within the error of the value
  broken         ///< by more than the error
};

/// The value of a bounded quantity on a finer grid, with the estimate of its error there.
struct BoundOnFinerGrid {
  double value, error;  ///< in the unit of the bound
  FinerVerdict verdict;
};

/// A bound on a quantity, at the last shape. In SI units; in 2D forces, energies, masses and stiffnesses per
/// metre of width.
struct SummarizedBound {
  std::string name;
  double value, bound;
  char relation;      ///< '<', '>' or '='
  double multiplier;  ///< of the objective, per unit of the bound
  bool is_kept;
  double kept_within;  ///< the relative tolerance if the value is beyond the bound and counts as kept, else 0
  const char* unit;    ///< of value and bound
  ShownUnit shown;     ///< as tables show them
  /// Nothing: no errors are wanted; the reason if they could not be estimated.
  std::optional<Expected<BoundOnFinerGrid, std::string>> finer = {};
};

/// By how much a value is beyond a bound, in its unit; negative within it.
double beyond(const SummarizedBound& bound, double value);

/// For a bound that is kept on the grid of the run but not, or not certainly, on the finer one: one line that
/// says so, and what to do. Empty for others.
std::string finer_grid_warning(const SummarizedBound& bound);

/// A radius of a layer that a run chose together with the shape [m].
struct ChosenRadius {
  std::string name;  ///< e.g. "inner_radius of tyre"
  double before, after;
  double least, most;  ///< its range
};

/// The result of a run, compared with the wheel that its case gives. Both shapes are solved on a tread of the
/// same resolution.
template <int dim>
struct RunSummary {
  std::string title;
  SummarizedShape<dim> before, after;
  std::vector<SummarizedBound> bounds = {};
  std::string minimized = {};  ///< instead of the weighted sum of functionals; empty for it
  std::string sum = {};        ///< how the objective is made of load cases, in words; empty for one load
  UnitKind objective_kind = UnitKind::energy;
  ShownUnit objective = shown_unit(UnitKind::energy, dim);
  std::vector<Remark> remarks = {};  ///< what got clearly worse
  std::string bounded_peaks = {};    ///< at how many positions bounds on peaks apply; empty without such
  std::vector<ChosenRadius> radii = {};
  std::optional<MadeWheel> made = {};  ///< the last shape, in 3D
  std::string changed_start = {};      ///< how the run's first shape differs from the given wheel, if it does
};

/// The numbers of the two shapes that could not be computed, and why: one line per reason.
template <int dim>
std::vector<std::string> missing_lines(const RunSummary<dim>& summary);

/// One readable line.
std::string text(const ChosenRadius& radius);

/// For display: one line per quantity with both values and the change, what could not be computed and why,
/// the place of the peak stress, what got clearly worse, and how the run's first shape differs from the given
/// wheel. Forces are shown on the whole width.
template <int dim>
std::string summary_table(const RunSummary<dim>& summary);

/// For programs: the same in SI units, named at the end of the keys. Numbers read back to the same double;
/// one that could not be computed is null.
template <int dim>
std::string summary_json(const RunSummary<dim>& summary);

/// The same for a run without a shape, because its initial one cannot be computed: its title, and why.
std::string failure_json(const std::string& title, const Failure& failure);

}  // namespace wheelwright
