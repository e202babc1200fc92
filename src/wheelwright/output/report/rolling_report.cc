#include "wheelwright/output/report/rolling_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "wheelwright/base/units.h"
#include "wheelwright/output/report/damage_by_load_case.h"
#include "wheelwright/output/report/heat_report.h"
#include "wheelwright/output/report/linear_theory_json.h"
#include "wheelwright/output/report/pass_report.h"
#include "wheelwright/output/report/value_with_error.h"
#include "wheelwright/quantities/analysis/discretization_error.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, MPa = 1e-6, N_per_mm = 1e-3, degree = 180 / std::numbers::pi;
constexpr size_t max_harmonics_shown = 4;

/// The factor from forces of the analysis to those on the whole width.
double forces(const RollingReport& report) { return whole_width(report.dimension, report.width); }

/// The errors of the numbers of a variation.
struct VariationErrors {
  RollingVariation of;
  double peak_to_peak;
};

/// A quantity over the positions.
struct ShownQuantity {
  std::string name;
  ShownUnit shown;
  Expected<RollingVariation> variation;
  std::optional<VariationErrors> errors = {};
  Converges converges = Converges::as_an_integral;
};

/// A number of every load position; nothing where it could not be computed.
struct PositionNumber {
  const char* key;
  std::function<std::optional<double>(const RollingAnalysis&, size_t position)> value;
  Converges converges = Converges::as_an_integral;
};

/// The same, made of single points or places.
PositionNumber extreme(PositionNumber number) {
  number.converges = Converges::as_an_extreme;
  return number;
}

PositionNumber of_contact(const char* key, double ContactSummary::*member, double factor = 1) {
  return {key, [=](const RollingAnalysis& a, size_t i) { return a.positions[i].*member * factor; }};
}

PositionNumber of_position(const char* key, std::vector<double> RollingAnalysis::*values) {
  return {key, [=](const RollingAnalysis& a, size_t i) { return (a.*values)[i]; }};
}

PositionNumber of_deformation(const char* key, double PositionDeformation::*member) {
  return {key, [=](const RollingAnalysis& a, size_t i) { return a.deformations[i].*member; }};
}

PositionNumber of_curve(const char* key, Expected<std::vector<double>> RollingAnalysis::*curve,
                        double factor) {
  return {key, [=](const RollingAnalysis& a, size_t i) {
            const auto& values = a.*curve;
            return values ? std::optional((*values)[i] * factor) : std::nullopt;
          }};
}

/// In the order of JSON.
std::vector<PositionNumber> position_numbers(const RollingReport& report) {
  const double width = forces(report);
  std::vector<PositionNumber> numbers{
      of_contact("radial_force_N", &ContactSummary::radial_force, width),
      of_contact("travel_m", &ContactSummary::travel),
      {"stiffness_N_per_m",
       [=](const RollingAnalysis& a, size_t i) {
         return a.positions[i].radial_force * width / a.positions[i].travel;
       }},
      extreme(of_contact("peak_pressure_Pa", &ContactSummary::peak_pressure)),
      extreme(of_contact("patch_length_m", &ContactSummary::patch_length)),
      extreme(of_contact("patch_extent_m", &ContactSummary::patch_extent)),
      of_contact("friction_force_N", &ContactSummary::friction_force, width),
      extreme(of_contact("peak_friction_Pa", &ContactSummary::peak_friction)),
      of_contact("travel_along_ground_m", &ContactSummary::travel_along_ground),
      of_contact("wind_up_rad", &ContactSummary::wind_up),
      extreme(of_position("peak_von_mises_Pa", &RollingAnalysis::peak_von_mises)),
      extreme(of_position("peak_strain", &RollingAnalysis::peak_strain)),
      extreme(of_deformation("largest_rotation_rad", &PositionDeformation::largest_rotation)),
      of_deformation("root_mean_strain", &PositionDeformation::root_mean_strain),
      of_deformation("root_mean_rotation_rad", &PositionDeformation::root_mean_rotation),
      of_position(report.dimension == 2 ? "strain_energy_J_per_m" : "strain_energy_J",
                  &RollingAnalysis::strain_energy),
      of_curve("travel_at_load_m", &RollingAnalysis::travel_at_load, 1),
      of_curve("force_at_travel_N", &RollingAnalysis::force_at_travel, width)};
  if (report.is_linear)
    numbers.push_back({"linear_theory_error", [](const RollingAnalysis& a, size_t i) {
                         return a.deformations[i].neglected.size();
                       }});
  return numbers;
}

const FinerReport* finer(const RollingReport& report) {
  return report.finer && *report.finer ? &**report.finer : nullptr;
}

/// The values of a number at all positions; empty if it could not be computed at one of them.
std::vector<double> values_of(const PositionNumber& number, const RollingAnalysis& analysis) {
  std::vector<double> values;
  for (size_t i = 0; i < analysis.positions.size(); ++i) {
    const auto value = number.value(analysis, i);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

/// The errors of a number at all positions; empty if they are not known.
std::vector<double> errors_of(const PositionNumber& number, const RollingReport& report) {
  if (!finer(report)) return {};
  const auto values = values_of(number, report.analysis),
             on_finer = values_of(number, finer(report)->analysis);
  if (values.empty() || on_finer.empty()) return {};
  return discretization_errors(values, on_finer, finer(report)->refinement, number.converges);
}

PositionNumber position_number(const RollingReport& report, std::string_view key) {
  const auto numbers = position_numbers(report);
  return *std::ranges::find_if(numbers, [&](const PositionNumber& one) { return one.key == key; });
}

/// NaN if it is not known.
double largest_error(const char* key, const RollingReport& report) {
  const auto errors = errors_of(position_number(report, key), report);
  return errors.empty() ? NAN : std::ranges::max(errors);
}

VariationErrors variation_errors(const RollingVariation& of, const RollingVariation& on_finer,
                                 double refinement, Converges how) {
  const auto error = [&](double a, double b) { return discretization_error(a, b, refinement, how); };
  const auto error_of_difference = [&](double a, double b) {
    return discretization_error(a, b, refinement, Converges::as_an_extreme);
  };
  VariationErrors errors{{error(of.mean, on_finer.mean),
                          error(of.minimum, on_finer.minimum),
                          error(of.maximum, on_finer.maximum),
                          {}},
                         error_of_difference(of.peak_to_peak(), on_finer.peak_to_peak())};
  for (size_t k = 0; k < of.harmonics.size(); ++k)
    errors.of.harmonics.push_back(error_of_difference(of.harmonics[k], on_finer.harmonics[k]));
  return errors;
}

Expected<RollingVariation> variation(const Expected<std::vector<double>>& values) {
  if (!values) return values.failure();
  return rolling_variation(*values);
}

std::vector<double> peak_pressures(const std::vector<ContactSummary>& positions) {
  std::vector<double> result;
  for (const ContactSummary& position : positions) result.push_back(position.peak_pressure);
  return result;
}

/// The variation of the axle's height, about the mean travel.
RollingVariation travel_variation(const std::vector<ContactSummary>& positions) {
  std::vector<double> descent;
  double growth = 0;
  for (const ContactSummary& position : positions) {
    descent.push_back(position.descent);
    growth += (position.travel - position.descent) / static_cast<double>(positions.size());
  }
  for (double& travel : descent) travel += growth;
  return rolling_variation(descent);
}

std::vector<ShownQuantity> quantities_of(const RollingReport& report, const RollingAnalysis& a) {
  const auto in = [&](UnitKind kind) { return shown_unit(kind, report.dimension, report.width); };
  return {{"rim travel at fixed load", in(UnitKind::length), variation(a.travel_at_load)},
          {"radial force at fixed travel", in(UnitKind::force), variation(a.force_at_travel)},
          {"peak of the contact pressure",
           in(UnitKind::stress),
           rolling_variation(peak_pressures(a.positions)),
           {},
           Converges::as_an_extreme}};
}

std::vector<ShownQuantity> quantities(const RollingReport& report) {
  auto all = quantities_of(report, report.analysis);
  if (!finer(report)) return all;
  const auto on_finer = quantities_of(report, finer(report)->analysis);
  for (size_t k = 0; k < all.size(); ++k)
    if (all[k].variation && on_finer[k].variation)
      all[k].errors = variation_errors(*all[k].variation, *on_finer[k].variation, finer(report)->refinement,
                                       all[k].converges);
  return all;
}

std::string load_text(const RollingReport& report) {
  return fmt::format("{:.6g} N", report.analysis.load * forces(report));
}

std::string travel_text(const RollingReport& report) {
  return fmt::format("{:.4g} mm", report.analysis.travel * mm);
}

/// A cell of the table of positions; a dash where the values could not be computed.
std::string cell(const Expected<std::vector<double>>& values, size_t i, double factor, int digits) {
  constexpr int width = 13;
  return values ? fmt::format("{:{}.{}f}", (*values)[i] * factor, width, digits)
                : fmt::format("{:>{}}", "-", width);
}

/// The largest errors of the columns of the positions; empty if they are not known.
std::string largest_errors_line(const RollingReport& report) {
  if (!finer(report)) return "";
  const auto error = [&](const char* key, double factor, int width) {
    const double value = largest_error(key, report) * factor;
    return std::isfinite(value) ? fmt::format("{:>{}.2g}", value, width) : fmt::format("{:>{}}", "-", width);
  };
  return fmt::format("{:>9}{}{}{}{}{}{}{}\n", "+- up to", error("stiffness_N_per_m", N_per_mm, 11),
                     error("peak_pressure_Pa", MPa, 11), error("patch_length_m", mm, 9),
                     error("peak_von_mises_Pa", MPa, 11),
                     error(report.dimension == 2 ? "strain_energy_J_per_m" : "strain_energy_J", 1, 11),
                     error("travel_at_load_m", mm, 13), error("force_at_travel_N", 1, 13));
}

std::string position_lines(const RollingReport& report) {
  constexpr const char* words = "{:>9}{:>11}{:>11}{:>9}{:>11}{:>11}{:>13}{:>13}\n";
  const RollingAnalysis& a = report.analysis;
  std::string table = fmt::format(
      "stiffness, contact, stress and strain energy at every position {}\n\n",
      a.held == Held::load ? "under " + load_text(report) : "at a rim travel of " + travel_text(report));
  table += fmt::format(words, "azimuth", "stiffness", "pressure", "patch", "von Mises", "energy", "travel at",
                       "force at");
  table += fmt::format(words, "", "", "peak", "length", "peak", "", load_text(report), travel_text(report));
  table += fmt::format(words, "[deg]", "[N/mm]", "[MPa]", "[mm]", "[MPa]",
                       fmt::format("[{}]", unit(UnitKind::energy, report.dimension)), "[mm]", "[N]");
  for (size_t i = 0; i < a.positions.size(); ++i) {
    const ContactSummary& p = a.positions[i];
    const double force = p.radial_force * forces(report);
    table += fmt::format("{:9.3f}{:11.2f}{:11.4f}{:9.3f}{:11.4f}{:11.5f}{}{}\n", a.azimuths[i] * degree,
                         force / p.travel * N_per_mm, p.peak_pressure * MPa, p.patch_length * mm,
                         a.peak_von_mises[i] * MPa, a.strain_energy[i], cell(a.travel_at_load, i, mm, 6),
                         cell(a.force_at_travel, i, forces(report), 2));
  }
  return table + largest_errors_line(report);
}

/// Whether there are forces along the ground or torques.
bool has_friction(const RollingReport& report) {
  return std::ranges::any_of(report.analysis.positions, [](const ContactSummary& p) {
    return p.peak_friction > 0 || p.wind_up != 0 || p.travel_along_ground != 0;
  });
}

std::string friction_lines(const RollingReport& report) {
  constexpr const char* words = "{:>9}{:>13}{:>13}{:>13}{:>13}\n";
  std::string table = fmt::format(words, "azimuth", "friction", "friction", "rim along", "wind-up");
  table += fmt::format(words, "", "force", "peak", "the ground", "of the rim");
  table += fmt::format(words, "[deg]", "[N]", "[MPa]", "[mm]", "[deg]");
  for (size_t i = 0; i < report.analysis.positions.size(); ++i) {
    const ContactSummary& p = report.analysis.positions[i];
    table += fmt::format("{:9.3f}{:13.2f}{:13.4f}{:13.6f}{:13.6f}\n", report.analysis.azimuths[i] * degree,
                         p.friction_force * forces(report), p.peak_friction * MPa, p.travel_along_ground * mm,
                         p.wind_up * degree);
  }
  return table;
}

bool has_gaps(const ContactSummary& p) { return p.patch_extent > p.patch_length; }

/// The positions whose contact patch has gaps.
std::string gap_lines(const RollingReport& report) {
  std::string table = fmt::format("{:>9}{:>13}{:>13}\n{:>9}{:>13}{:>13}\n{:>9}{:>13}{:>13}\n", "azimuth",
                                  "patch", "patch", "", "length", "with gaps", "[deg]", "[mm]", "[mm]");
  for (size_t i = 0; i < report.analysis.positions.size(); ++i)
    if (const ContactSummary& p = report.analysis.positions[i]; has_gaps(p))
      table += fmt::format("{:9.3f}{:13.3f}{:13.3f}\n", report.analysis.azimuths[i] * degree,
                           p.patch_length * mm, p.patch_extent * mm);
  return table;
}

std::string variation_errors_line(const VariationErrors& errors, double factor, size_t n_harmonics) {
  std::string line = fmt::format("{:>36}{:>11.2g}{:>11.2g}{:>15}", "+-", errors.of.mean * factor,
                                 errors.peak_to_peak * factor, "");
  for (size_t k = 0; k < n_harmonics; ++k) line += fmt::format("{:>11.2g}", errors.of.harmonics[k] * factor);
  return line + '\n';
}

std::string variation_lines(const RollingReport& report) {
  std::string waves;
  const auto all = quantities(report);
  const size_t shown = std::min(max_harmonics_shown, (report.analysis.positions.size() - 1) / 2);
  for (size_t k = 0; k < shown; ++k)
    waves += fmt::format("{:>11}", fmt::format("{} waves", (k + 1) * report.n_sectors));
  std::string table =
      fmt::format("{:<36}{:>11}{:>11}{:>13}{}\n", "in rolling", "mean", "pk to pk", "of the mean", waves);
  for (const ShownQuantity& q : all) {
    if (!q.variation) continue;
    const RollingVariation& v = *q.variation;
    table += fmt::format("{:<36}{:>11.5g}{:>11.4g}{:>11.3g} %", fmt::format("{} [{}]", q.name, q.shown.name),
                         v.mean * q.shown.factor, v.peak_to_peak() * q.shown.factor,
                         100 * v.peak_to_peak() / v.mean);
    for (size_t k = 0; k < shown; ++k) table += fmt::format("{:>11.3g}", v.harmonics[k] * q.shown.factor);
    table += '\n';
    if (q.errors) table += variation_errors_line(*q.errors, q.shown.factor, shown);
  }
  return table;
}

/// Where the curve of loads ends.
struct EndOfCurve {
  double carried, too_large;  ///< loads on the whole width [N]
  const Failure& failure;     ///< of the latter
};

/// Nothing if all loads were computed, or none.
std::optional<EndOfCurve> end_of_curve(const RollingReport& report) {
  const auto failed = std::ranges::find_if(report.under_loads, [](const auto& state) { return !state; });
  if (failed == report.under_loads.end() || failed == report.under_loads.begin()) return {};
  const auto k = static_cast<size_t>(failed - report.under_loads.begin());
  return EndOfCurve{report.loads[k - 1] * forces(report), report.loads[k] * forces(report),
                    failed->failure()};
}

std::string largest_load_line(const RollingReport& report) {
  const auto end = end_of_curve(report);
  if (!end) return "";
  const auto& largest = end->failure.largest_load;
  return fmt::format("the curve ends between {:.6g} N and {:.6g} N; ", end->carried, end->too_large) +
         (largest ? fmt::format("{} about {:.4g} N\n",
                                end->failure.reason == FailureReason::material_overlaps ? "its edges meet at"
                                                                                        : "the wheel carries",
                                *largest * forces(report))
                  : fmt::format("--loads {:.6g}:{:.6g}:5 narrows it down\n", end->carried, end->too_large));
}

/// Why a curve ends, in words for a title.
std::string reason_text(FailureReason reason) {
  switch (reason) {
    case FailureReason::overload:
      return "the load has a maximum";
    case FailureReason::material_overlaps:
      return "edges meet";
    case FailureReason::not_positive_definite:
      return "the wheel buckles";
    default:
      return to_string(reason);
  }
}

/// The title of a plot over the loads.
std::string title_over_loads(const RollingReport& report, const std::string& what) {
  const auto end = end_of_curve(report);
  if (!end) return what + " against load";
  return fmt::format("{} against load; ends between {:.6g} and {:.6g} N: {}", what, end->carried,
                     end->too_large, reason_text(end->failure.reason));
}

std::string missing_lines(const RollingReport& report) {
  std::string lines;
  if (report.finer && !*report.finer)
    lines += fmt::format("errors are not estimated: {}\n", report.finer->failure());
  for (const ShownQuantity& q : quantities(report))
    if (!q.variation)
      lines += fmt::format("not computed: {}: {}\n", q.name, to_string(q.variation.failure()));
  if (report.losses && !*report.losses)
    lines += fmt::format("not computed: rolling resistance: {}\n", to_string(report.losses->failure()));
  if (report.fatigue && !*report.fatigue)
    lines += fmt::format("not computed: fatigue: {}\n", to_string(report.fatigue->failure()));
  if (report.damage && !*report.damage)
    lines +=
        fmt::format("not computed: fatigue in all load cases: {}\n", to_string(report.damage->failure()));
  if (report.heat && !*report.heat)
    lines += fmt::format("not computed: temperature: {}\n", to_string(report.heat->failure()));
  for (size_t k = 0; k < report.loads.size(); ++k)
    if (!report.under_loads[k])
      lines += fmt::format("not computed: load {:.6g} N: {}\n", report.loads[k] * forces(report),
                           to_string(report.under_loads[k].failure()));
  return lines + largest_load_line(report);
}

double largest_stress(const RollingAnalysis& analysis) { return std::ranges::max(analysis.peak_von_mises); }

/// On the finer grid the largest stress may be elsewhere.
double stress_error(const RollingReport& report) {
  return discretization_error(largest_stress(report.analysis), largest_stress(finer(report)->analysis),
                              finer(report)->refinement, Converges::as_an_extreme);
}

/// A number with its error if that is known.
std::string with_known_error(double value, double error, double factor) {
  return std::isfinite(error) ? text_with_error(value * factor, error * factor)
                              : fmt::format("{:.4g}", value * factor);
}

std::string stress_line(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  return fmt::format(
      "largest von Mises stress {} MPa at radius {:.1f} mm, azimuth {:.2f} deg, with the ground at {:.2f} "
      "deg\n",
      with_known_error(largest_stress(a), finer(report) ? stress_error(report) : NAN, MPa),
      a.peak_radius * mm, a.peak_azimuth * degree, a.azimuths[a.most_stressed] * degree);
}

/// A number of a layer; nothing if it has none.
struct LayerNumber {
  const char *key, *heading;
  double factor;  ///< from SI units to those of the heading
  std::function<std::optional<double>(const LayerResults&)> value;
  Converges converges;
};

/// In the order of tables and JSON.
std::vector<LayerNumber> layer_numbers(const RollingReport& report) {
  return {{"mass_kg", "mass [kg]", 1,
           [width = forces(report)](const LayerResults& layer) {
             return layer.mass ? std::optional(*layer.mass * width) : std::nullopt;
           },
           Converges::as_an_integral},
          {"peak_von_mises_Pa", "von Mises [MPa]", MPa,
           [](const LayerResults& layer) { return std::optional(layer.peak_von_mises); },
           Converges::as_an_extreme},
          {"largest_strain", "strain [%]", 100,
           [](const LayerResults& layer) { return std::optional(layer.largest_strain); },
           Converges::as_an_extreme}};
}

/// Nothing if it is not known.
std::optional<double> error_of(const LayerNumber& number, const RollingReport& report, size_t layer) {
  if (!finer(report)) return {};
  const auto value = number.value(report.analysis.layers[layer]),
             on_finer = number.value(finer(report)->analysis.layers[layer]);
  if (!value || !on_finer) return {};
  return discretization_error(*value, *on_finer, finer(report)->refinement, number.converges);
}

/// One line per layer, from the rim to the tread.
std::string layer_lines(const RollingReport& report) {
  const auto& layers = report.analysis.layers;
  const auto numbers = layer_numbers(report);
  std::string table = fmt::format("{:<16}", "layer");
  for (const LayerNumber& number : numbers) table += fmt::format("{:>20}", number.heading);
  table += fmt::format("{:>13}{:>14}{:>17}\n", "at r [mm]", "azimuth [deg]", "ground at [deg]");
  for (size_t k = 0; k < layers.size(); ++k) {
    table += fmt::format("{:<16}", layers[k].name);
    for (const LayerNumber& number : numbers) {
      const auto value = number.value(layers[k]);
      table += fmt::format(
          "{:>20}",
          value ? with_known_error(*value, error_of(number, report, k).value_or(NAN), number.factor) : "-");
    }
    table += fmt::format("{:13.1f}{:14.2f}{:17.2f}\n", layers[k].peak_place[0] * mm,
                         layers[k].peak_place[1] * degree, layers[k].peak_ground * degree);
  }
  return table;
}

/// The position with the largest error of linear theory.
const PositionDeformation& least_linear(const RollingAnalysis& analysis) {
  return *std::ranges::max_element(analysis.deformations, {}, [](const PositionDeformation& position) {
    return position.neglected.size();
  });
}

std::string linear_theory_lines(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  const PositionDeformation& worst = least_linear(a);
  const double rotation =
      std::ranges::max(a.deformations, {}, &PositionDeformation::largest_rotation).largest_rotation;
  const std::string sizes = fmt::format(
      "largest strain {} %, largest rotation {} deg\n",
      with_known_error(std::ranges::max(a.peak_strain), largest_error("peak_strain", report), 100),
      with_known_error(rotation, largest_error("largest_rotation_rad", report), degree));
  if (!report.is_linear) return sizes;
  return sizes +
         fmt::format(
             "error of linear theory, estimated: {} % of travel and stiffness: the real wheel is stiffer by "
             "{:+.2g} % (rotation) +-{:.2g} % (strain) {:+.2g} % (bending){}\n",
             with_known_error(worst.neglected.size(), largest_error("linear_theory_error", report), 100),
             100 * worst.neglected.of_rotation, 100 * std::abs(worst.neglected.of_strain),
             100 * worst.neglected.of_bending,
             report.is_ground_flat ? "" : "; what the shape of the ground adds is not in it");
}

/// Null if they are not known.
const RollingLosses* losses(const std::optional<Expected<RollingLosses>>& known) {
  return known && *known ? &**known : nullptr;
}

/// Nothing if the losses are not known on the finer grid.
std::optional<double> error_of_losses(const RollingReport& report, double RollingLosses::*number) {
  const RollingLosses* on_finer = finer(report) ? losses(finer(report)->losses) : nullptr;
  if (!on_finer) return {};
  return discretization_error(losses(report.losses)->*number, on_finer->*number, finer(report)->refinement);
}

std::string losses_line(const RollingReport& report) {
  const RollingLosses& found = *losses(report.losses);
  return fmt::format(
      "rolling resistance {} N, {} of the load; the load positions do not resolve at most {:.2g} N of it\n",
      with_known_error(found.resistance, error_of_losses(report, &RollingLosses::resistance).value_or(NAN),
                       forces(report)),
      with_known_error(found.coefficient, error_of_losses(report, &RollingLosses::coefficient).value_or(NAN),
                       1),
      found.beyond * forces(report));
}

/// Null if they are not known.
template <class Results>
const Results* fatigue(const std::optional<Expected<Results>>& known) {
  return known && *known ? &**known : nullptr;
}

/// The worst place of the ring, or of a layer.
template <class Results>
const auto& worst_of(const Results& results, const std::optional<size_t>& layer) {
  return layer ? results.by_layer[*layer] : results.worst;
}

/// Of the utilization there; nothing if it is not known on the finer grid. `results` is a member of reports.
template <class Results>
std::optional<double> error_of_utilization(const RollingReport& report, const Results& found,
                                           std::optional<Expected<Results>> FinerReport::*results,
                                           const std::optional<size_t>& layer) {
  const Results* on_finer = finer(report) ? fatigue(finer(report)->*results) : nullptr;
  if (!on_finer) return {};
  return discretization_error(worst_of(found, layer).utilization, worst_of(*on_finer, layer).utilization,
                              finer(report)->refinement, Converges::as_an_extreme);
}

double kilometres(const RollingReport& report, double turns) {
  return turns * 2 * std::numbers::pi * report.outer_radius / 1000;
}

/// What each load case contributes; empty if the results are those of one load case.
std::string text_by_case(const RollingReport&, const FatigueResults::Worst&) { return ""; }

std::string text_by_case(const RollingReport& report, const FatigueDamage::Worst& worst) {
  return "; " + damage_text(worst, report.load_cases);
}

/// The worst place of the ring and those of the layers; `where` is the load.
template <class Results>
std::string fatigue_lines(const RollingReport& report, const Results& found,
                          std::optional<Expected<Results>> FinerReport::*results, const std::string& where) {
  const auto line = [&](const std::string& of, const std::optional<size_t>& layer) {
    const auto& worst = worst_of(found, layer);
    std::string text =
        fmt::format("fatigue utilization{}{} {} %, at radius {:.1f} mm, azimuth {:.2f} deg", of, where,
                    with_known_error(worst.utilization,
                                     error_of_utilization(report, found, results, layer).value_or(NAN), 100),
                    worst.place[0] * mm, worst.place[1] * degree);
    if (worst.life)
      text += fmt::format("; life {:.2g} turns, {:.2g} km", *worst.life, kilometres(report, *worst.life));
    return text + text_by_case(report, worst) + '\n';
  };
  std::string lines = line("", {});
  for (size_t k = 0; k < found.by_layer.size(); ++k)
    lines += line(" of " + report.analysis.layers[k].name, k);
  return lines;
}

std::string fatigue_lines(const RollingReport& report) {
  std::string lines;
  if (const FatigueResults* found = fatigue(report.fatigue))
    lines += fatigue_lines(report, *found, &FinerReport::fatigue, "");
  if (const FatigueDamage* found = fatigue(report.damage))
    lines += fatigue_lines(report, *found, &FinerReport::damage, " in all load cases");
  return lines;
}

/// Null if they are not known.
const HeatResults* heat(const std::optional<Expected<HeatResults>>& known) {
  return known && *known ? &**known : nullptr;
}

HeatContext heat_context(const RollingReport& report) {
  HeatContext context{
      .layers = {}, .width_factor = forces(report), .dimension = report.dimension, .error = {}};
  for (const LayerResults& layer : report.analysis.layers) context.layers.push_back(layer.name);
  if (const HeatResults* on_finer = finer(report) ? heat(finer(report)->heat) : nullptr)
    context.error = discretization_error(heat(report.heat)->peak.temperature, on_finer->peak.temperature,
                                         finer(report)->refinement, Converges::as_an_extreme);
  return context;
}

double mean_travel_under(const RollingReport& report, size_t load) {
  return travel_variation(*report.under_loads[load]).mean;
}

std::optional<double> mean_travel_error(const RollingReport& report, size_t load) {
  if (!finer(report) || !finer(report)->under_loads[load]) return {};
  return discretization_error(mean_travel_under(report, load),
                              travel_variation(*finer(report)->under_loads[load]).mean,
                              finer(report)->refinement);
}

/// A stiffness per metre of width on the whole width, when dim = 2.
std::optional<double> on_width(const RollingReport& report, std::optional<double> stiffness) {
  return stiffness ? std::optional(*stiffness * forces(report)) : std::nullopt;
}

/// Load by mean travel [N/m].
double secant_under(const RollingReport& report, size_t load) {
  return report.loads[load] * forces(report) / mean_travel_under(report, load);
}

std::optional<double> secant_error(const RollingReport& report, size_t load) {
  const auto of_travel = mean_travel_error(report, load);
  if (!of_travel) return {};
  return secant_under(report, load) * *of_travel / mean_travel_under(report, load);
}

/// dF/d(mean travel) at a load [N/m].
std::optional<double> tangent_under(const RollingReport& report, size_t load) {
  return on_width(report, tangent_stiffness(*report.under_loads[load]));
}

std::optional<double> tangent_error(const RollingReport& report, size_t load) {
  if (!finer(report) || !finer(report)->under_loads[load]) return {};
  const auto tangent = tangent_under(report, load),
             of_finer = on_width(report, tangent_stiffness(*finer(report)->under_loads[load]));
  if (!tangent || !of_finer) return {};
  return discretization_error(*tangent, *of_finer, finer(report)->refinement);
}

std::string load_lines(const RollingReport& report) {
  constexpr const char* words = "{:>11}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n";
  const char *error = finer(report) ? "+-" : "", *unit_of_error = finer(report) ? "[N/mm]" : "";
  std::string table =
      fmt::format(words, "load", "mean travel", "minimum", "maximum", "stiffness", error, "tangent", error) +
      fmt::format(words, "[N]", "[mm]", "[mm]", "[mm]", "[N/mm]", unit_of_error, "[N/mm]", unit_of_error);
  const auto of_error = [](std::optional<double> stiffness) {
    return stiffness ? fmt::format("{:12.2g}", *stiffness * N_per_mm) : fmt::format("{:12}", "");
  };
  for (size_t k = 0; k < report.loads.size(); ++k) {
    if (!report.under_loads[k]) continue;
    const RollingVariation travel = travel_variation(*report.under_loads[k]);
    const double load = report.loads[k] * forces(report);
    table += fmt::format("{:11.2f}{:12.6f}{:12.6f}{:12.6f}{:12.2f}", load, travel.mean * mm,
                         travel.minimum * mm, travel.maximum * mm, secant_under(report, k) * N_per_mm);
    table += of_error(secant_error(report, k));
    const auto tangent = tangent_under(report, k);
    table += tangent ? fmt::format("{:12.2f}", *tangent * N_per_mm) : fmt::format("{:>12}", "-");
    table += of_error(tangent_error(report, k)) + '\n';
  }
  return table;
}

using Json = nlohmann::ordered_json;

Json variation_json(const RollingVariation& v, double factor, int n_sectors) {
  Json harmonics = Json::array();
  for (size_t k = 0; k < v.harmonics.size(); ++k)
    harmonics.push_back(
        {{"waves_per_revolution", (k + 1) * n_sectors}, {"amplitude", v.harmonics[k] * factor}});
  return {{"mean", v.mean * factor},
          {"minimum", v.minimum * factor},
          {"maximum", v.maximum * factor},
          {"peak_to_peak", v.peak_to_peak() * factor},
          {"harmonics", harmonics}};
}

Json variation_json(const ShownQuantity& q, double factor, int n_sectors) {
  if (!q.variation) return {};
  Json json = variation_json(*q.variation, factor, n_sectors);
  if (!q.errors) return json;
  json["errors"] = variation_json(q.errors->of, factor, n_sectors);
  json["errors"]["peak_to_peak"] = q.errors->peak_to_peak * factor;
  return json;
}

Json positions_json(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  Json positions = Json::array();
  for (size_t i = 0; i < a.positions.size(); ++i) {
    positions.push_back({{"azimuth_rad", a.azimuths[i]}});
    if (report.is_linear) positions[i]["linear_theory"] = to_json(a.deformations[i].neglected);
  }
  for (const PositionNumber& number : position_numbers(report)) {
    const auto errors = errors_of(number, report);
    for (size_t i = 0; i < a.positions.size(); ++i) {
      const auto value = number.value(a, i);
      positions[i][number.key] = value ? Json(*value) : Json();
      if (!errors.empty()) positions[i]["errors"][number.key] = errors[i];
    }
  }
  return positions;
}

Json layers_json(const RollingReport& report) {
  Json layers = Json::array();
  for (size_t k = 0; k < report.analysis.layers.size(); ++k) {
    const LayerResults& layer = report.analysis.layers[k];
    Json json{{"name", layer.name}};
    for (const LayerNumber& number : layer_numbers(report)) {
      if (const auto value = number.value(layer)) json[number.key] = *value;
      if (const auto error = error_of(number, report, k)) json["errors"][number.key] = *error;
    }
    json["peak_von_mises_place"] = {{"radius_m", layer.peak_place[0]},
                                    {"azimuth_rad", layer.peak_place[1]},
                                    {"load_position_rad", layer.peak_ground}};
    if (report.dimension == 3) json["peak_von_mises_place"]["z_m"] = layer.peak_place[2];
    layers.push_back(std::move(json));
  }
  return layers;
}

Json losses_json(const RollingReport& report) {
  const RollingLosses& found = *losses(report.losses);
  const auto on_width = [&](std::vector<double> values) {
    for (double& value : values) value *= forces(report);
    return values;
  };
  Json json{{"force_N", found.resistance * forces(report)},
            {"coefficient", found.coefficient},
            {"unresolved_N", found.beyond * forces(report)},
            {"by_harmonic_N", on_width(found.by_harmonic)}};
  for (size_t k = 0; k < found.by_layer.size(); ++k)
    json["by_layer_N"][report.analysis.layers[k].name] = found.by_layer[k] * forces(report);
  if (const auto error = error_of_losses(report, &RollingLosses::resistance))
    json["errors"] = {{"force_N", *error * forces(report)},
                      {"coefficient", *error_of_losses(report, &RollingLosses::coefficient)}};
  return json;
}

Json worst_json(const RollingReport& report, const FatigueResults::Worst& worst) {
  Json json{{"utilization", worst.utilization},
            {"place", {{"radius_m", worst.place[0]}, {"azimuth_rad", worst.place[1]}}}};
  if (report.dimension == 3) json["place"]["z_m"] = worst.place[2];
  if (worst.life && std::isfinite(*worst.life)) {
    json["life_turns"] = *worst.life;
    json["life_km"] = kilometres(report, *worst.life);
  }
  return json;
}

Json worst_json(const RollingReport& report, const FatigueDamage::Worst& worst) {
  Json json = worst_json(report, static_cast<const FatigueResults::Worst&>(worst));
  json["damage_by_load_case"] = damage_json(worst, report.load_cases);
  return json;
}

template <class Results>
Json fatigue_json(const RollingReport& report, const Results& found,
                  std::optional<Expected<Results>> FinerReport::*results) {
  Json json = worst_json(report, found.worst);
  const auto add_error = [&](const std::optional<size_t>& layer, Json& of) {
    if (const auto error = error_of_utilization(report, found, results, layer))
      of["errors"] = {{"utilization", *error}};
  };
  for (size_t k = 0; k < found.by_layer.size(); ++k) {
    Json& of_layer = json["by_layer"][report.analysis.layers[k].name];
    of_layer = worst_json(report, found.by_layer[k]);
    add_error(k, of_layer);
  }
  add_error({}, json);
  return json;
}

Json known(std::optional<double> number) { return number ? Json(*number) : Json(); }

Json loads_json(const RollingReport& report) {
  Json loads = Json::array();
  for (size_t k = 0; k < report.loads.size(); ++k) {
    const double load = report.loads[k] * forces(report);
    if (!report.under_loads[k]) {
      const Failure& failure = report.under_loads[k].failure();
      loads.push_back({{"load_N", load}, {"missing", to_string(failure)}});
      if (failure.largest_load) loads.back()["largest_load_N"] = *failure.largest_load * forces(report);
      continue;
    }
    Json positions = Json::array();
    for (const ContactSummary& p : *report.under_loads[k])
      positions.push_back({{"travel_m", p.travel},
                           {"peak_pressure_Pa", p.peak_pressure},
                           {"patch_length_m", p.patch_length},
                           {"patch_extent_m", p.patch_extent},
                           {"tangent_stiffness_N_per_m", known(on_width(report, p.stiffness))}});
    loads.push_back({{"load_N", load},
                     {"mean_travel_m", mean_travel_under(report, k)},
                     {"stiffness_N_per_m", secant_under(report, k)},
                     {"tangent_stiffness_N_per_m", known(tangent_under(report, k))},
                     {"positions", positions}});
    if (const auto error = mean_travel_error(report, k))
      loads.back()["errors"] = {{"mean_travel_m", *error}, {"stiffness_N_per_m", *secant_error(report, k)}};
    if (const auto error = tangent_error(report, k))
      loads.back()["errors"]["tangent_stiffness_N_per_m"] = *error;
  }
  return loads;
}

Json pass_json(const RollingReport& report) {
  Json pass = Json::array();
  for (const PassPlace& place : report.pass) {
    Json json{{"moved_m", place.shift}};
    if (!place.positions) {
      json["missing"] = to_string(place.positions.failure());
      pass.push_back(std::move(json));
      continue;
    }
    Json& positions = json["positions"] = Json::array();
    for (const ContactSummary& p : *place.positions)
      positions.push_back({{"axle_raised_m", place.rise - p.descent},
                           {"travel_m", p.travel},
                           {"force_up_N", forces(report) * p.radial_force},
                           {"force_along_N", forces(report) * p.friction_force},
                           {"peak_pressure_Pa", p.peak_pressure}});
    pass.push_back(std::move(json));
  }
  return pass;
}

/// The grid, and value, error and reason of each number by its key.
Json accuracy_json(const AccurateNumbers& numbers) {
  Json json{{"accuracy", numbers.accuracy}, {"grid", numbers.grid}};
  for (const AccurateNumber& number : numbers.numbers) {
    auto& of = json["numbers"][number.key];
    of["value"] = number.value;
    of["error"] = number.error ? Json(*number.error) : Json();
    if (!number.reason.empty()) of["not_accurate"] = number.reason;
  }
  return json;
}

/// One value per position over the angle, with the first repeated a sector later.
LinePlot sector_plot(const RollingReport& report, const std::string& title, PlotAxis axis, const char* key,
                     double factor) {
  const PositionNumber number = position_number(report, key);
  const auto values = values_of(number, report.analysis), errors = errors_of(number, report);
  PlotCurve curve;
  for (size_t i = 0; i < values.size(); ++i) {
    curve.x.push_back(report.analysis.azimuths[i] * degree);
    curve.y.push_back(values[i] * factor);
    if (!errors.empty()) curve.errors.push_back(errors[i] * factor);
  }
  curve.x.push_back(curve.x.front() + 360.0 / report.n_sectors);
  curve.y.push_back(curve.y.front());
  if (!errors.empty()) curve.errors.push_back(curve.errors.front());
  return {title, {"azimuth of the contact", "deg"}, std::move(axis), {std::move(curve)}};
}

}  // namespace

std::string rolling_table(const RollingReport& report) {
  std::string table = position_lines(report) + '\n';
  if (has_friction(report)) table += friction_lines(report) + '\n';
  if (std::ranges::any_of(report.analysis.positions, has_gaps)) table += gap_lines(report) + '\n';
  table += variation_lines(report) + '\n';
  if (!report.analysis.layers.empty()) table += layer_lines(report) + '\n';
  table += stress_line(report) + linear_theory_lines(report);
  if (losses(report.losses)) table += losses_line(report);
  table += fatigue_lines(report);
  if (heat(report.heat)) table += heat_lines(*heat(report.heat), heat_context(report));
  if (!report.loads.empty()) table += '\n' + load_lines(report);
  if (const std::string lines = missing_lines(report); !lines.empty()) table += '\n' + lines;
  if (report.accurate) table += '\n' + accuracy_table(*report.accurate);
  if (!report.pass.empty()) table += '\n' + pass_table(report.pass, forces(report));
  return table;
}

std::string rolling_json(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  const auto all = quantities(report);
  const auto variation = [&](const ShownQuantity& q, double factor) {
    return variation_json(q, factor, report.n_sectors);
  };
  Json json{{"title", report.title},
            {"width_m", report.width},
            {"sectors", report.n_sectors},
            {"load_N", a.load * forces(report)},
            {"travel_m", a.travel},
            {"positions", positions_json(report)},
            {"peak_von_mises",
             {{"value_Pa", a.peak_von_mises[a.most_stressed]},
              {"radius_m", a.peak_radius},
              {"azimuth_rad", a.peak_azimuth},
              {"load_position_rad", a.azimuths[a.most_stressed]}}},
            {"travel_at_load_m", variation(all[0], 1)},
            {"force_at_travel_N", variation(all[1], forces(report))},
            {"peak_pressure_Pa", variation(all[2], 1)}};
  if (finer(report)) json["peak_von_mises"]["error_Pa"] = stress_error(report);
  if (!a.layers.empty()) json["layers"] = layers_json(report);
  if (report.finer && !*report.finer) json["missing_errors"] = report.finer->failure();
  if (!a.travel_at_load) json["missing"]["travel_at_load_m"] = to_string(a.travel_at_load.failure());
  if (!a.force_at_travel) json["missing"]["force_at_travel_N"] = to_string(a.force_at_travel.failure());
  if (losses(report.losses)) json["rolling_resistance"] = losses_json(report);
  if (report.losses && !*report.losses)
    json["missing"]["rolling_resistance"] = to_string(report.losses->failure());
  if (const FatigueResults* found = fatigue(report.fatigue))
    json["fatigue"] = fatigue_json(report, *found, &FinerReport::fatigue);
  if (report.fatigue && !*report.fatigue) json["missing"]["fatigue"] = to_string(report.fatigue->failure());
  if (const FatigueDamage* found = fatigue(report.damage))
    json["fatigue_in_all_load_cases"] = fatigue_json(report, *found, &FinerReport::damage);
  if (report.damage && !*report.damage)
    json["missing"]["fatigue_in_all_load_cases"] = to_string(report.damage->failure());
  if (heat(report.heat)) json["heat"] = heat_json(*heat(report.heat), heat_context(report));
  if (report.heat && !*report.heat) json["missing"]["heat"] = to_string(report.heat->failure());
  if (!report.loads.empty()) json["loads"] = loads_json(report);
  if (!report.pass.empty()) json["pass"] = pass_json(report);
  if (report.accurate) json["accuracy"] = accuracy_json(*report.accurate);
  return json.dump(2) + '\n';
}

LinePlot travel_plot(const RollingReport& report) {
  return sector_plot(report, "Rim travel under " + load_text(report), {"rim travel", "mm"},
                     "travel_at_load_m", mm);
}

LinePlot force_plot(const RollingReport& report) {
  return sector_plot(report, "Radial force at a rim travel of " + travel_text(report), {"radial force", "N"},
                     "force_at_travel_N", 1);
}

LinePlot peak_pressure_plot(const RollingReport& report) {
  return sector_plot(report, "Peak of the contact pressure", {"peak pressure", "MPa"}, "peak_pressure_Pa",
                     MPa);
}

LinePlot load_plot(const RollingReport& report) {
  LinePlot plot{title_over_loads(report, "Deflection"),
                {"load", "N"},
                {"rim travel", "mm"},
                {{"softest", {0}, {0}}, {"mean", {0}, {0}}, {"stiffest", {0}, {0}}}};
  for (size_t k = 0; k < report.loads.size(); ++k) {
    if (!report.under_loads[k]) continue;
    const RollingVariation travel = travel_variation(*report.under_loads[k]);
    const double travels[] = {travel.maximum, travel.mean, travel.minimum};
    for (size_t i = 0; i < plot.curves.size(); ++i) {
      plot.curves[i].x.push_back(report.loads[k] * forces(report));
      plot.curves[i].y.push_back(travels[i] * mm);
    }
  }
  return plot;
}

LinePlot stiffness_plot(const RollingReport& report) {
  LinePlot plot{title_over_loads(report, "Stiffness"),
                {"load", "N"},
                {"stiffness", "N/mm"},
                {{"secant", {}, {}}, {"tangent", {}, {}}}};
  for (size_t k = 0; k < report.loads.size(); ++k) {
    if (!report.under_loads[k]) continue;
    const std::optional<double> stiffnesses[] = {secant_under(report, k), tangent_under(report, k)};
    for (size_t i = 0; i < plot.curves.size(); ++i) {
      if (!stiffnesses[i]) continue;
      plot.curves[i].x.push_back(report.loads[k] * forces(report));
      plot.curves[i].y.push_back(*stiffnesses[i] * N_per_mm);
    }
  }
  return plot;
}

}  // namespace wheelwright
