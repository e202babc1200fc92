#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/units.h"
#include "wheelwright/cad/outline/clearance.h"
#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/cad/outline/roughness.h"
#include "wheelwright/mechanics/state/load_case.h"
#include "wheelwright/output/report/layer_circles.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/quantities/analysis/discretization_error.h"
#include "wheelwright/quantities/analysis/fatigue_damage.h"
#include "wheelwright/quantities/analysis/fatigue_results.h"
#include "wheelwright/quantities/analysis/heat_results.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/quantities/analysis/rolling_losses.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/quantities/functionals/quantity.h"

namespace wheelwright {

/// The response of a wheel to a load, as numbers. Forces of the analysis are per metre of width when dim = 2.
template <int dim>
struct LoadedWheel {
  ShapeSummary<dim> summary;
  RollingAnalysis rolling;
  DeformationSize deformation;
  std::optional<Expected<RollingLosses>> losses = {};    ///< rolling_losses()
  std::optional<Expected<FatigueResults>> fatigue = {};  ///< fatigue_results()
  std::optional<Expected<HeatResults>> heat = {};        ///< heat_results()
};

/// Measurements on the curves fitted to the edges of a shape. Nothing when dim = 3, where edges are not plane
/// curves.
struct OutlineMeasures {
  cad::Clearances clearances = {};
  std::optional<cad::Roughness> roughness = {};  ///< at a cell of the grid; nothing without holes, or in 3D
  int closed_cavities = 0;                       ///< closed_cavities(); 0 in 2D
};

/// A number about a wheel, or in one line why it could not be computed, e.g. "newton_stalled: ...".
using KnownNumber = Expected<double, std::string>;

/// The value of a quantity that a program has added, in SI units, on the whole width.
struct OwnNumber {
  Quantity quantity;
  KnownNumber value;
};

template <int dim>
struct FinerWheel;

/// A wheel on a finer grid, or in one line why there is none.
template <int dim>
using KnownFinerWheel = Expected<FinerWheel<dim>, std::string>;

/// A wheel in numbers.
template <int dim>
struct DescribedWheel {
  std::string name;   ///< e.g. of its case file or run, or "before"
  std::string which;  ///< e.g. "shape 31"
  PolarGrid<dim> grid;
  double volume_fraction;      ///< material area over the area of the full ring
  std::optional<double> mass;  ///< [kg, per metre of width when dim = 2], if the material has a density
  Expected<OutlineMeasures, cad::OutlineFault> outline;  ///< fails if no curves can be fitted
  Expected<LoadedWheel<dim>> loaded;                     ///< fails like the contact problem
  std::vector<OwnNumber> own = {};                       ///< of the load case
  LayerCircles layers = {};
  std::string load_case = {};               ///< of these numbers; empty: the wheel has only one load
  std::vector<DescribedWheel> others = {};  ///< the same wheel under its other load cases
  /// Under all of them: fatigue_damage(), if their shares of the distance are known.
  std::optional<Expected<FatigueDamage>> damage = {};
  /// For estimates of discretization errors, under the same load; null: none are wanted.
  std::shared_ptr<const KnownFinerWheel<dim>> finer = {};
};

/// A wheel on a finer grid, without what is measured on its outline.
template <int dim>
struct FinerWheel {
  DescribedWheel<dim> wheel;
  double refinement;  ///< the factor by which its cells are smaller
};

/// States of a shape, or why there are none.
template <int dim>
using SolvedStates = Expected<std::shared_ptr<const State<dim>>>;

/// The values of a program's own quantities at a shape, from its states under one load case.
template <int dim>
using OwnNumbers = std::function<std::vector<OwnNumber>(const SolvedStates<dim>&)>;

/// Describes a shape by its states under the first of its load cases; the others are solved on the same
/// factor.
template <int dim>
DescribedWheel<dim> described_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                    double volume_fraction, const SolvedStates<dim>& states,
                                    const LoadCases<dim>& cases,
                                    const OwnNumbers<dim>& own_numbers = OwnNumbers<dim>());

/// The same without what is measured on the outline, and so without its cost.
template <int dim>
DescribedWheel<dim> described_solution(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                       double volume_fraction, const SolvedStates<dim>& states,
                                       const LoadCases<dim>& cases,
                                       const OwnNumbers<dim>& own_numbers = OwnNumbers<dim>());

/// The wheel with estimates of its errors by a finer one, under all load cases.
template <int dim>
DescribedWheel<dim> with_errors(DescribedWheel<dim> wheel, const KnownFinerWheel<dim>& finer);

/// The wheel under the load case of that name; null if it has none.
template <int dim>
const DescribedWheel<dim>* under_load_case(const DescribedWheel<dim>& wheel, const std::string& load_case);

/// The names of the wheel's load cases; empty if it has only one load.
template <int dim>
std::vector<std::string> load_cases_of(const DescribedWheel<dim>& wheel);

/// In 2D those of the curves fitted to the edges; fails if there are none. In 3D the narrowest places of the
/// surface, without roughness.
template <int dim>
Expected<OutlineMeasures, cad::OutlineFault> outline_measures(const LevelSet<dim>& psi);

/// The clearances of a wheel; nothing if it has none or no curves could be fitted.
template <int dim>
std::optional<cad::Roughness> roughness(const DescribedWheel<dim>& wheel);

/// One number about a wheel.
template <int dim>
struct WheelNumber {
  std::string label;
  UnitKind kind;
  std::string key;  ///< for programs, with the SI unit
  /// In SI units, on the whole width: nothing if the wheel has no such number, e.g. a mass without a density;
  /// the reason if it could not be computed.
  std::function<std::optional<KnownNumber>(const DescribedWheel<dim>&)> value;
  bool is_of_shape = false;  ///< the same under every load
  Converges converges = Converges::as_an_integral;

  ShownUnit shown() const { return shown_unit(kind, dim); }
};

/// The numbers by which wheels are judged and compared, in the order of tables.
template <int dim>
const std::vector<WheelNumber<dim>>& wheel_numbers();

/// The numbers of a layer of the ring.
template <int dim>
std::vector<WheelNumber<dim>> layer_numbers(const std::string& layer);

/// The numbers of wheels, those of the wheel's layers, and the wheel's own ones.
template <int dim>
std::vector<WheelNumber<dim>> numbers_of(const DescribedWheel<dim>& wheel);

/// One sentence for every material that gets warmer than it may while the wheel rolls.
template <int dim>
std::vector<std::string> too_warm(const DescribedWheel<dim>& wheel);

/// In SI units, on the whole width; nothing if the wheel has no such number, for whatever reason.
template <int dim>
std::optional<double> known_value(const WheelNumber<dim>& number, const DescribedWheel<dim>& wheel);

/// The estimate of the discretization error of a known number (quantities/analysis/discretization_error.h),
/// in its unit, at least least_share_of_error of that of the displacements: nothing if none is wanted or the
/// finer wheel does not have the number, as for those measured on the outline; the reason if it could not be
/// computed.
template <int dim>
std::optional<KnownNumber> error_of(const WheelNumber<dim>& number, const DescribedWheel<dim>& wheel);

}  // namespace wheelwright
