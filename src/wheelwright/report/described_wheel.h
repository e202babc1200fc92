#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/analysis/rolling_analysis.h"
#include "wheelwright/analysis/shape_summary.h"
#include "wheelwright/cad/clearance.h"
#include "wheelwright/state/load_case.h"

namespace wheelwright {

/// A wheel in numbers. Forces of the analysis are per metre of width when dim = 2.
template <int dim>
struct DescribedWheel {
  std::string name;   ///< e.g. of its case file or run, or "before"
  std::string which;  ///< e.g. "shape 31"
  PolarGrid<dim> grid;
  double volume_fraction;      ///< material area over the area of the full ring
  std::optional<double> mass;  ///< [kg, per metre of width when dim = 2], if the material has a density
  /// The thinnest wall and the narrowest gap of the outline, measured on its fitted curves. Nothing when dim
  /// = 3, where there are no holes, and where no curves can be fitted.
  cad::Clearances clearances;
  ShapeSummary<dim> summary;
  RollingAnalysis rolling;
  std::string load_case = {};               ///< under which; empty: the wheel has one load alone
  std::vector<DescribedWheel> others = {};  ///< the same wheel under its other load cases
};

/// Describes a shape by its states. Fails as the contact problem does, which is solved at a fixed travel too.
template <int dim>
Expected<DescribedWheel<dim>> described_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                              double volume_fraction, const State<dim>& state);

/// The same under several load cases; the state is that of the first, the others are solved on the same
/// factor.
template <int dim>
Expected<DescribedWheel<dim>> described_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                              double volume_fraction, const State<dim>& state,
                                              const LoadCases<dim>& cases);

/// The wheel under the load case of that name; null if it has none.
template <int dim>
const DescribedWheel<dim>* under_load_case(const DescribedWheel<dim>& wheel, const std::string& load_case);

/// The thinnest wall and the narrowest gap of a shape, measured on the curves that follow its edges. Nothing
/// when dim = 3 and where no curves can be fitted.
template <int dim>
cad::Clearances outline_clearances(const LevelSet<dim>& psi);

/// One number about a wheel.
template <int dim>
struct WheelNumber {
  const char* label;
  const char* unit;  ///< for people
  double factor;     ///< from SI to that unit
  const char* key;   ///< for programs, with the SI unit
  /// In SI units, on the whole width; nothing where a wheel has no such number.
  std::optional<double> (*value)(const DescribedWheel<dim>&);
  bool is_of_shape = false;  ///< the same under every load
};

/// The numbers by which wheels are judged and compared, in the order in which they are told.
template <int dim>
const std::vector<WheelNumber<dim>>& wheel_numbers();

}  // namespace wheelwright
