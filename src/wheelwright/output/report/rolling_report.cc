#include "wheelwright/output/report/rolling_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "wheelwright/base/units.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, MPa = 1e-6, N_per_mm = 1e-3, degree = 180 / std::numbers::pi;
constexpr size_t max_harmonics_shown = 4;

/// The factor from forces of the analysis to those on the whole width.
double forces(const RollingReport& report) { return whole_width(report.dimension, report.width); }

/// A quantity over the positions.
struct ShownQuantity {
  std::string name;
  ShownUnit shown;
  Expected<RollingVariation> variation;
};

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

std::vector<ShownQuantity> quantities(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  const auto in = [&](UnitKind kind) { return shown_unit(kind, report.dimension, report.width); };
  return {
      {"rim travel at fixed load", in(UnitKind::length), variation(a.travel_at_load)},
      {"radial force at fixed travel", in(UnitKind::force), variation(a.force_at_travel)},
      {"peak of the contact pressure", in(UnitKind::stress), rolling_variation(peak_pressures(a.positions))}};
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
  return table;
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
  }
  return table;
}

std::string missing_lines(const RollingReport& report) {
  std::string lines;
  for (const ShownQuantity& q : quantities(report))
    if (!q.variation)
      lines += fmt::format("not computed: {}: {}\n", q.name, to_string(q.variation.failure()));
  for (size_t k = 0; k < report.loads.size(); ++k)
    if (!report.under_loads[k])
      lines += fmt::format("not computed: load {:.6g} N: {}\n", report.loads[k] * forces(report),
                           to_string(report.under_loads[k].failure()));
  return lines;
}

std::string stress_line(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  return fmt::format(
      "largest von Mises stress {:.4g} MPa at radius {:.1f} mm, azimuth {:.2f} deg, with the ground at "
      "{:.2f} "
      "deg\n",
      a.peak_von_mises[a.most_stressed] * MPa, a.peak_radius * mm, a.peak_azimuth * degree,
      a.azimuths[a.most_stressed] * degree);
}

std::string load_lines(const RollingReport& report) {
  std::string table =
      fmt::format("{:>11}{:>12}{:>12}{:>12}{:>12}\n{:>11}{:>12}{:>12}{:>12}{:>12}\n", "load", "mean travel",
                  "minimum", "maximum", "stiffness", "[N]", "[mm]", "[mm]", "[mm]", "[N/mm]");
  for (size_t k = 0; k < report.loads.size(); ++k) {
    if (!report.under_loads[k]) continue;
    const RollingVariation travel = travel_variation(*report.under_loads[k]);
    const double load = report.loads[k] * forces(report);
    table += fmt::format("{:11.2f}{:12.6f}{:12.6f}{:12.6f}{:12.2f}\n", load, travel.mean * mm,
                         travel.minimum * mm, travel.maximum * mm, load / travel.mean * N_per_mm);
  }
  return table;
}

using Json = nlohmann::ordered_json;

Json value_json(const Expected<std::vector<double>>& values, size_t i, double factor) {
  return values ? Json((*values)[i] * factor) : Json();
}

Json variation_json(const Expected<RollingVariation>& variation, double factor, int n_sectors) {
  if (!variation) return {};
  const RollingVariation& v = *variation;
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

Json positions_json(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  Json positions = Json::array();
  for (size_t i = 0; i < a.positions.size(); ++i) {
    const ContactSummary& p = a.positions[i];
    positions.push_back(
        {{"azimuth_rad", a.azimuths[i]},
         {"radial_force_N", p.radial_force * forces(report)},
         {"travel_m", p.travel},
         {"stiffness_N_per_m", p.radial_force * forces(report) / p.travel},
         {"peak_pressure_Pa", p.peak_pressure},
         {"patch_length_m", p.patch_length},
         {"patch_extent_m", p.patch_extent},
         {"friction_force_N", p.friction_force * forces(report)},
         {"peak_friction_Pa", p.peak_friction},
         {"travel_along_ground_m", p.travel_along_ground},
         {"wind_up_rad", p.wind_up},
         {"peak_von_mises_Pa", a.peak_von_mises[i]},
         {"peak_strain", a.peak_strain[i]},
         {report.dimension == 2 ? "strain_energy_J_per_m" : "strain_energy_J", a.strain_energy[i]},
         {"travel_at_load_m", value_json(a.travel_at_load, i, 1)},
         {"force_at_travel_N", value_json(a.force_at_travel, i, forces(report))}});
  }
  return positions;
}

Json loads_json(const RollingReport& report) {
  Json loads = Json::array();
  for (size_t k = 0; k < report.loads.size(); ++k) {
    const double load = report.loads[k] * forces(report);
    if (!report.under_loads[k]) {
      loads.push_back({{"load_N", load}, {"missing", to_string(report.under_loads[k].failure())}});
      continue;
    }
    Json positions = Json::array();
    for (const ContactSummary& p : *report.under_loads[k])
      positions.push_back({{"travel_m", p.travel},
                           {"peak_pressure_Pa", p.peak_pressure},
                           {"patch_length_m", p.patch_length},
                           {"patch_extent_m", p.patch_extent}});
    const double mean_travel = travel_variation(*report.under_loads[k]).mean;
    loads.push_back({{"load_N", load},
                     {"mean_travel_m", mean_travel},
                     {"stiffness_N_per_m", load / mean_travel},
                     {"positions", positions}});
  }
  return loads;
}

/// One value per position over the angle, with the first repeated a sector later.
LinePlot sector_plot(const RollingReport& report, const std::string& title, PlotAxis axis,
                     const std::vector<double>& values, double factor) {
  PlotCurve curve;
  for (size_t i = 0; i < values.size(); ++i) {
    curve.x.push_back(report.analysis.azimuths[i] * degree);
    curve.y.push_back(values[i] * factor);
  }
  curve.x.push_back(curve.x.front() + 360.0 / report.n_sectors);
  curve.y.push_back(curve.y.front());
  return {title, {"azimuth of the contact", "deg"}, std::move(axis), {std::move(curve)}};
}

}  // namespace

std::string rolling_table(const RollingReport& report) {
  std::string table = position_lines(report) + '\n';
  if (has_friction(report)) table += friction_lines(report) + '\n';
  if (std::ranges::any_of(report.analysis.positions, has_gaps)) table += gap_lines(report) + '\n';
  table += variation_lines(report) + '\n' + stress_line(report);
  if (!report.loads.empty()) table += '\n' + load_lines(report);
  if (const std::string lines = missing_lines(report); !lines.empty()) table += '\n' + lines;
  return table;
}

std::string rolling_json(const RollingReport& report) {
  const RollingAnalysis& a = report.analysis;
  const auto all = quantities(report);
  const auto variation = [&](const ShownQuantity& q, double factor) {
    return variation_json(q.variation, factor, report.n_sectors);
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
  if (!a.travel_at_load) json["missing"]["travel_at_load_m"] = to_string(a.travel_at_load.failure());
  if (!a.force_at_travel) json["missing"]["force_at_travel_N"] = to_string(a.force_at_travel.failure());
  if (!report.loads.empty()) json["loads"] = loads_json(report);
  return json.dump(2) + '\n';
}

LinePlot travel_plot(const RollingReport& report) {
  return sector_plot(report, "Rim travel under " + load_text(report), {"rim travel", "mm"},
                     *report.analysis.travel_at_load, mm);
}

LinePlot force_plot(const RollingReport& report) {
  return sector_plot(report, "Radial force at a rim travel of " + travel_text(report), {"radial force", "N"},
                     *report.analysis.force_at_travel, forces(report));
}

LinePlot peak_pressure_plot(const RollingReport& report) {
  return sector_plot(report, "Peak of the contact pressure", {"peak pressure", "MPa"},
                     peak_pressures(report.analysis.positions), MPa);
}

LinePlot load_plot(const RollingReport& report) {
  LinePlot plot{"Deflection against load",
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

}  // namespace wheelwright
