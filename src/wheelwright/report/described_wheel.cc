#include "wheelwright/report/described_wheel.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "wheelwright/base/units.h"
#include "wheelwright/cad/fit_outline.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, MPa = 1e-6, N_per_mm = 1e-3, percent = 100;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

template <int dim>
std::vector<double> of_positions(const DescribedWheel<dim>& wheel, double ContactSummary::*member) {
  std::vector<double> values;
  for (const ContactSummary& position : wheel.rolling.positions) values.push_back(position.*member);
  return values;
}

/// The amplitude of the lowest harmonic that a wheel of equal sectors can have.
double first_harmonic(const std::vector<double>& values) {
  const auto harmonics = rolling_variation(values).harmonics;
  return harmonics.empty() ? 0 : harmonics.front();
}

template <int dim>
std::optional<double> mass(const StateSolver<dim>& solver, double volume_fraction) {
  const RollingModel<dim>& model = solver.model();
  const std::optional<double> density = model.materials.at_tread().density;
  if (!density) return {};
  const PolarGrid<dim>& grid = model.grid;
  const double area =
      std::numbers::pi * (grid.outer_radius * grid.outer_radius - grid.inner_radius * grid.inner_radius);
  return *density * volume_fraction * area * (dim == 3 ? grid.width : 1);
}

/// How far the curves may be from the edge, by the tread's radius: as exported outlines are.
constexpr double curve_tolerance = 3e-5;

std::optional<double> width(const std::optional<cad::Clearance>& clearance) {
  return clearance ? std::optional(clearance->width) : std::nullopt;
}

}  // namespace

template <int dim>
cad::Clearances outline_clearances(const LevelSet<dim>& psi) {
  if constexpr (dim == 2) {
    const PolarGrid<2>& grid = psi.lattice.grid();
    const auto outline = cad::fit_outline(psi, curve_tolerance * grid.outer_radius);
    if (outline) return cad::clearances(*outline, grid.n_sectors, cad::clearance_step * grid.outer_radius);
  }
  return {};
}

template <int dim>
Expected<DescribedWheel<dim>> described_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                              double volume_fraction, const State<dim>& state) {
  auto rolling = rolling_analysis(solver, state);
  if (!rolling) return rolling.failure();
  return DescribedWheel<dim>{.name = {},
                             .which = {},
                             .grid = solver.model().grid,
                             .volume_fraction = volume_fraction,
                             .mass = mass(solver, volume_fraction),
                             .clearances = outline_clearances(psi),
                             .summary = shape_summary(solver, psi, state),
                             .rolling = *std::move(rolling)};
}

template <int dim>
Expected<DescribedWheel<dim>> described_wheel(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                              double volume_fraction, const State<dim>& state,
                                              const LoadCases<dim>& cases) {
  auto wheel = described_wheel(solver, psi, volume_fraction, state);
  for (std::size_t k = 0; k < cases.size() && wheel; ++k) {
    if (k == 0) {
      wheel->load_case = cases[k].name;
      continue;
    }
    const auto other_state = state.under(with_loads_of(state.model(), cases[k].model), Interrupt());
    if (!other_state) return other_state.failure();
    auto other = described_wheel(solver, psi, volume_fraction, **other_state);
    if (!other) return other.failure();
    other->load_case = cases[k].name;
    wheel->others.push_back(*std::move(other));
  }
  return wheel;
}

template <int dim>
const DescribedWheel<dim>* under_load_case(const DescribedWheel<dim>& wheel, const std::string& load_case) {
  const auto found = std::ranges::find(wheel.others, load_case, &DescribedWheel<dim>::load_case);
  return found == wheel.others.end() ? nullptr : &*found;
}

template <int dim>
const std::vector<WheelNumber<dim>>& wheel_numbers() {
  using Wheel = DescribedWheel<dim>;
  using Number = std::optional<double>;
  static const std::vector<WheelNumber<dim>> numbers{
      {"volume of the ring", "%", percent, "volume_fraction",
       [](const Wheel& w) -> Number { return w.volume_fraction; }, true},
      {"mass", "kg", 1, "mass_kg",
       [](const Wheel& w) -> Number {
         return w.mass ? Number(*w.mass * whole_width(dim, w.grid.width)) : std::nullopt;
       },
       true},
      {"load", "N", 1, "load_N",
       [](const Wheel& w) -> Number { return w.rolling.load * whole_width(dim, w.grid.width); }},
      {"mean travel", "mm", mm, "mean_travel_m",
       [](const Wheel& w) -> Number { return mean(of_positions(w, &ContactSummary::travel)); }},
      {"stiffness", "N/mm", N_per_mm, "stiffness_N_per_m",
       [](const Wheel& w) -> Number { return w.summary.stiffness * whole_width(dim, w.grid.width); }},
      {"run-out at fixed load", "mm", mm, "run_out_m",
       [](const Wheel& w) -> Number { return rolling_variation(w.rolling.travel_at_load).peak_to_peak(); }},
      {"  its first sector harmonic", "mm", mm, "run_out_first_harmonic_m",
       [](const Wheel& w) -> Number { return first_harmonic(w.rolling.travel_at_load); }},
      {"radial force variation at fixed travel", "N", 1, "force_variation_N",
       [](const Wheel& w) -> Number {
         return rolling_variation(w.rolling.force_at_travel).peak_to_peak() * whole_width(dim, w.grid.width);
       }},
      {"  its first sector harmonic", "N", 1, "force_first_harmonic_N",
       [](const Wheel& w) -> Number {
         return first_harmonic(w.rolling.force_at_travel) * whole_width(dim, w.grid.width);
       }},
      {"peak contact pressure", "MPa", MPa, "peak_pressure_Pa",
       [](const Wheel& w) -> Number { return w.summary.rolling.peak_pressure; }},
      {"mean length of the contact patch", "mm", mm, "patch_length_m",
       [](const Wheel& w) -> Number { return mean(of_positions(w, &ContactSummary::patch_length)); }},
      {"peak von Mises stress", "MPa", MPa, "peak_von_mises_Pa",
       [](const Wheel& w) -> Number { return w.summary.von_mises.value; }},
      {"largest strain", "%", percent, "largest_strain",
       [](const Wheel& w) -> Number { return w.summary.deformation.strain; }},
      {"strain energy per position", unit<dim>(UnitKind::energy), 1,
       dim == 2 ? "strain_energy_J_per_m" : "strain_energy_J",
       [](const Wheel& w) -> Number { return w.summary.strain_energy; }},
      {"thinnest wall", "mm", mm, "minimum_wall_m",
       [](const Wheel& w) -> Number { return width(w.clearances.wall); }, true},
      {"narrowest gap", "mm", mm, "minimum_gap_m",
       [](const Wheel& w) -> Number { return width(w.clearances.gap); }, true},
  };
  return numbers;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                        \
  template Expected<DescribedWheel<dim>> described_wheel(const StateSolver<dim>&, const LevelSet<dim>&,     \
                                                         double, const State<dim>&);                        \
  template Expected<DescribedWheel<dim>> described_wheel(const StateSolver<dim>&, const LevelSet<dim>&,     \
                                                         double, const State<dim>&, const LoadCases<dim>&); \
  template const DescribedWheel<dim>* under_load_case(const DescribedWheel<dim>&, const std::string&);      \
  template cad::Clearances outline_clearances(const LevelSet<dim>&);                                        \
  template const std::vector<WheelNumber<dim>>& wheel_numbers();
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
