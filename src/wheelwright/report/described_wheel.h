#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/analysis/rolling_analysis.h"
#include "wheelwright/analysis/shape_summary.h"
#include "wheelwright/cad/clearance.h"
#include "wheelwright/cad/outline_fault.h"
#include "wheelwright/cad/roughness.h"
#include "wheelwright/state/load_case.h"

namespace wheelwright {

/// What a load does to a wheel, in numbers. Forces of the analysis are per metre of width when dim = 2.
template <int dim>
struct LoadedWheel {
  ShapeSummary<dim> summary;
  RollingAnalysis rolling;
};

/// What is measured on the curves that follow the edges of a shape. Nothing when dim = 3, whose edges are no
/// plane curves.
struct OutlineMeasures {
  cad::Clearances clearances = {};
  std::optional<cad::Roughness> roughness = {};  ///< at a cell of the grid; nothing without holes
};

/// A wheel in numbers.
template <int dim>
struct DescribedWheel {
  std::string name;   ///< e.g. of its case file or run, or "before"
  std::string which;  ///< e.g. "shape 31"
  PolarGrid<dim> grid;
  double volume_fraction;      ///< material area over the area of the full ring
  std::optional<double> mass;  ///< [kg, per metre of width when dim = 2], if the material has a density
  Expected<OutlineMeasures, cad::OutlineFault> outline;  ///< fails where no curves can be fitted
  Expected<LoadedWheel<dim>> loaded;                     ///< fails as the contact problem does
  std::string load_case = {};                            ///< under which; empty: the wheel has one load alone
  std::vector<DescribedWheel> others = {};               ///< the same wheel under its other load cases
};

/// States of a shape, or why there are none.
template <int dim>
using SolvedStates = Expected<std::shared_ptr<const State<dim>>>;

/// Describes a shape by its states under the first of its load cases; the others are solved on the same
/// factor.
template <int dim>
DescribedWheel<dim> described_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                    double volume_fraction, const SolvedStates<dim>& states,
                                    const LoadCases<dim>& cases);

/// The wheel under the load case of that name; null if it has none.
template <int dim>
const DescribedWheel<dim>* under_load_case(const DescribedWheel<dim>& wheel, const std::string& load_case);

/// Fails where no curves can be fitted.
template <int dim>
Expected<OutlineMeasures, cad::OutlineFault> outline_measures(const LevelSet<dim>& psi);

/// Of a wheel; nothing where it has none or no curves could be fitted.
template <int dim>
std::optional<cad::Roughness> roughness(const DescribedWheel<dim>& wheel);

/// A number about a wheel, or in one line why it could not be computed, e.g. "newton_stalled: ...".
using KnownNumber = Expected<double, std::string>;

/// One number about a wheel.
template <int dim>
struct WheelNumber {
  const char* label;
  UnitKind kind;
  const char* key;  ///< for programs, with the SI unit
  /// In SI units, on the whole width: nothing where a wheel has no such number, such as a mass without a
  /// density; the reason where it could not be computed.
  std::optional<KnownNumber> (*value)(const DescribedWheel<dim>&);
  bool is_of_shape = false;  ///< the same under every load

  ShownUnit shown() const { return shown_unit(kind, dim); }
};

/// The numbers by which wheels are judged and compared, in the order in which they are told.
template <int dim>
const std::vector<WheelNumber<dim>>& wheel_numbers();

/// In SI units, on the whole width; nothing where the wheel has no such number, whatever the reason.
template <int dim>
std::optional<double> known_value(const WheelNumber<dim>& number, const DescribedWheel<dim>& wheel);

}  // namespace wheelwright
