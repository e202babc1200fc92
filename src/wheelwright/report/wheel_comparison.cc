#include "wheelwright/report/wheel_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "wheelwright/report/comparison_table.h"
#include "wheelwright/report/svg.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, MPa = 1e-6, N_per_mm = 1e-3, percent = 100;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> of_positions(const ComparedWheel& wheel, double ContactSummary::*member) {
  std::vector<double> values;
  for (const ContactSummary& position : wheel.rolling.positions) values.push_back(position.*member);
  return values;
}

/// The amplitude of the lowest harmonic that a wheel of equal sectors can have.
double first_harmonic(const std::vector<double>& values) {
  const auto harmonics = rolling_variation(values).harmonics;
  return harmonics.empty() ? 0 : harmonics.front();
}

/// One number about a wheel.
struct Number {
  const char* label;
  const char* unit;  ///< for people
  double factor;     ///< from SI to that unit
  const char* key;   ///< for programs, with the SI unit
  double (*value)(const ComparedWheel&);
};

constexpr std::array numbers{
    Number{"volume of the ring", "%", percent, "volume_fraction",
           [](const ComparedWheel& w) { return w.volume_fraction; }},
    Number{"load", "N", 1, "load_N", [](const ComparedWheel& w) { return w.rolling.load * w.grid.width; }},
    Number{"mean travel", "mm", mm, "mean_travel_m",
           [](const ComparedWheel& w) { return mean(of_positions(w, &ContactSummary::travel)); }},
    Number{"stiffness", "N/mm", N_per_mm, "stiffness_N_per_m",
           [](const ComparedWheel& w) { return w.summary.stiffness * w.grid.width; }},
    Number{"run-out at fixed load", "mm", mm, "run_out_m",
           [](const ComparedWheel& w) { return rolling_variation(w.rolling.travel_at_load).peak_to_peak(); }},
    Number{"  its first sector harmonic", "mm", mm, "run_out_first_harmonic_m",
           [](const ComparedWheel& w) { return first_harmonic(w.rolling.travel_at_load); }},
    Number{"radial force variation at fixed travel", "N", 1, "force_variation_N",
           [](const ComparedWheel& w) {
             return rolling_variation(w.rolling.force_at_travel).peak_to_peak() * w.grid.width;
           }},
    Number{"  its first sector harmonic", "N", 1, "force_first_harmonic_N",
           [](const ComparedWheel& w) { return first_harmonic(w.rolling.force_at_travel) * w.grid.width; }},
    Number{"peak contact pressure", "MPa", MPa, "peak_pressure_Pa",
           [](const ComparedWheel& w) { return w.summary.rolling.peak_pressure; }},
    Number{"mean length of the contact patch", "mm", mm, "patch_length_m",
           [](const ComparedWheel& w) { return mean(of_positions(w, &ContactSummary::patch_length)); }},
    Number{"peak von Mises stress", "MPa", MPa, "peak_von_mises_Pa",
           [](const ComparedWheel& w) { return w.summary.von_mises.value; }},
    Number{"largest strain", "%", percent, "largest_strain",
           [](const ComparedWheel& w) { return w.summary.deformation.strain; }},
    Number{"strain energy per position", "J/m", 1, "strain_energy_J_per_m",
           [](const ComparedWheel& w) { return w.summary.strain_energy; }},
};

constexpr std::array colours{"#3b6ea5", "#d1495b", "#2e8b57", "#b8860b", "#7b4fa3", "#008b8b"};

std::string heading(const ComparedWheel& wheel) { return fmt::format("{}, {}", wheel.name, wheel.which); }

}  // namespace

std::string wheels_table(const std::vector<ComparedWheel>& wheels) {
  std::vector<std::string> names;
  for (const ComparedWheel& wheel : wheels) names.push_back(wheel.name);
  std::vector<ComparedRow> rows;
  for (const Number& number : numbers) {
    ComparedRow row{fmt::format("{} [{}]", number.label, number.unit), {}};
    for (const ComparedWheel& wheel : wheels) row.values.push_back(number.value(wheel) * number.factor);
    rows.push_back(std::move(row));
  }
  return comparison_table(names, rows);
}

std::string wheels_json(const std::vector<ComparedWheel>& wheels) {
  auto json = nlohmann::ordered_json::array();
  for (const ComparedWheel& wheel : wheels) {
    nlohmann::ordered_json entry{{"name", wheel.name}, {"shape", wheel.which}, {"width_m", wheel.grid.width}};
    for (const Number& number : numbers) entry[number.key] = number.value(wheel);
    json.push_back(std::move(entry));
  }
  return nlohmann::ordered_json{{"wheels", std::move(json)}}.dump(2) + '\n';
}

std::string overlay_svg(const std::vector<ComparedWheel>& wheels) {
  constexpr double size = 640, margin = 30, line_height = 24;
  double radius = 0;
  for (const ComparedWheel& wheel : wheels) radius = std::max(radius, wheel.grid.outer_radius);
  const double scale = (0.5 * size - margin) / radius;
  const double height = size + line_height * static_cast<double>(wheels.size()) + margin;
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<title>Wheels over each other</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" rx=\"8\" fill=\"#ffffff\"/>\n"
      "<g fill-rule=\"evenodd\" stroke-linejoin=\"round\" transform=\"translate({2} {2})\">\n",
      size, height, 0.5 * size);
  for (std::size_t k = 0; k < wheels.size(); ++k)
    svg +=
        fmt::format("<path fill=\"{}\" fill-opacity=\"0.25\" stroke=\"{}\" stroke-width=\"{}\" d=\"{}\"/>\n",
                    k == 0 ? colours[0] : "none", colours[k % colours.size()], k == 0 ? 1 : 1.6,
                    material_path(wheels[k].grid, wheels[k].contours, scale, 2, 0.5 / scale));
  svg += "</g>\n";
  for (std::size_t k = 0; k < wheels.size(); ++k) {
    const double y = size + line_height * static_cast<double>(k);
    svg += fmt::format(
        "<rect x=\"{0}\" y=\"{1}\" width=\"24\" height=\"12\" fill=\"{2}\" fill-opacity=\"{3}\" "
        "stroke=\"{2}\"/>\n"
        "<text x=\"{4}\" y=\"{5}\" font-family=\"Helvetica,Arial,DejaVu Sans,sans-serif\" font-size=\"15\" "
        "fill=\"#24292f\">{6}</text>\n",
        margin, y, colours[k % colours.size()], k == 0 ? 0.25 : 0.0, margin + 36, y + 11,
        escape_xml(heading(wheels[k])));
  }
  return svg + "</svg>\n";
}

}  // namespace wheelwright
