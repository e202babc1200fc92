#include "wheelwright/output/report/wheel_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "wheelwright/output/report/comparison_table.h"
#include "wheelwright/output/report/numbers_json.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

constexpr std::array colours{"#3b6ea5", "#d1495b", "#2e8b57", "#b8860b", "#7b4fa3", "#008b8b"};

std::string heading(const ComparedWheel& wheel) {
  const LayerCircles& layers = wheel.numbers.layers;
  return fmt::format("{}, {}{}", wheel.numbers.name, wheel.numbers.which,
                     layers.empty() ? "" : "; dashed: " + text(layers));
}

std::vector<ComparedRow> rows(const std::vector<ComparedWheel>& wheels) {
  std::vector<const DescribedWheel<2>*> described;
  for (const ComparedWheel& wheel : wheels) described.push_back(&wheel.numbers);
  return compared_rows(described);
}

/// The undecided_numbers by the keys of the numbers and the names of the wheels.
nlohmann::ordered_json within_errors_json(const std::vector<ComparedWheel>& wheels) {
  const auto all = rows(wheels);
  auto json = nlohmann::ordered_json::array();
  for (const UndecidedNumbers& undecided : undecided_numbers(all)) {
    nlohmann::ordered_json entry;
    for (const std::size_t wheel : undecided.wheels) entry["wheels"].push_back(wheels[wheel].numbers.name);
    for (const std::size_t row : undecided.rows) entry["numbers"].push_back(all[row].key);
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace

std::string wheels_table(const std::vector<ComparedWheel>& wheels) {
  std::vector<std::string> names;
  for (const ComparedWheel& wheel : wheels) names.push_back(wheel.numbers.name);
  return comparison_table(names, rows(wheels));
}

std::string wheels_json(const std::vector<ComparedWheel>& wheels) {
  auto json = nlohmann::ordered_json::array();
  for (const ComparedWheel& wheel : wheels) {
    nlohmann::ordered_json entry{
        {"name", wheel.numbers.name}, {"shape", wheel.numbers.which}, {"width_m", wheel.numbers.grid.width}};
    add_numbers(wheel.numbers, entry);
    json.push_back(std::move(entry));
  }
  return nlohmann::ordered_json{{"wheels", std::move(json)}, {"within_errors", within_errors_json(wheels)}}
             .dump(2) +
         '\n';
}

std::string overlay_svg(const std::vector<ComparedWheel>& wheels) {
  constexpr double size = 640, margin = 30, line_height = 24;
  double radius = 0;
  for (const ComparedWheel& wheel : wheels) radius = std::max(radius, wheel.numbers.grid.outer_radius);
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
                    material_path(wheels[k].numbers.grid, wheels[k].contours, scale, 2, 0.5 / scale));
  for (std::size_t k = 0; k < wheels.size(); ++k)
    for (const double layer : wheels[k].numbers.layers.radii)
      svg += fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-dasharray=\"5 3\" d=\"{}\"/>\n",
                         colours[k % colours.size()], circle_path(layer * scale, 2));
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
