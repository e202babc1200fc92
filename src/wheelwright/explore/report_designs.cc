#include "wheelwright/explore/report_designs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "wheelwright/explore/design_runs.h"
#include "wheelwright/explore/pareto.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/page/assets.h"
#include "wheelwright/page/html_template.h"
#include "wheelwright/report/described_wheel.h"
#include "wheelwright/report/svg.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

const char* word(Progression progression) { return progression == Progression::full ? "full" : "preview"; }

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

double number_of(const DesignResult& result, const char* key) {
  const auto found = result.numbers.find(key);
  return found == result.numbers.end() ? std::nan("") : found->second;
}

/// The names of all parameters, in the order in which they first come.
std::vector<std::string> parameter_names(const std::vector<RankedDesign>& designs) {
  std::vector<std::string> names;
  for (const RankedDesign& one : designs)
    for (const auto& [name, value] : one.design.parameters)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

double parameter(const Design& design, const std::string& name) {
  const auto found =
      std::ranges::find(design.parameters, name, [](const auto& parameter) { return parameter.first; });
  return found == design.parameters.end() ? std::nan("") : found->second;
}

}  // namespace

std::vector<RankedDesign> ranked(const std::vector<RatedDesign>& designs,
                                 const std::vector<RankedQuantity>& quantities) {
  const auto all = costs(designs, quantities);
  const auto front = fronts(all);
  std::vector<int> order(designs.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) {
    return std::pair(front[i] == 0 ? HUGE_VAL : front[i], front[i] == 0 ? 0 : all[i].front());
  };
  std::ranges::stable_sort(order, {}, place);
  std::vector<RankedDesign> result;
  for (const int i : order) result.push_back({designs[i], front[i], {}});
  return result;
}

std::string designs_csv(const std::vector<RankedDesign>& designs) {
  const auto names = parameter_names(designs);
  std::vector<std::string> header{"rank", "design", "front", "run", "ended", "shapes", "start", "sectors"};
  header.insert(header.end(), names.begin(), names.end());
  for (const auto& number : wheel_numbers<2>()) header.emplace_back(number.key);
  std::string text = csv_line(header);
  int rank = 0;
  for (const RankedDesign& one : designs) {
    std::vector<std::string> cells{
        std::to_string(++rank),    one.design.name,
        std::to_string(one.front), word(one.result.progression),
        one.result.status,         std::to_string(one.result.shapes),
        one.design.text,           std::to_string(one.design.source.wheel.sectors)};
    for (const std::string& name : names) cells.push_back(csv_number(parameter(one.design, name)));
    for (const auto& number : wheel_numbers<2>())
      cells.push_back(csv_number(number_of(one.result, number.key)));
    text += csv_line(cells);
  }
  return text;
}

std::string designs_json(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities) {
  Json json{{"quantities", Json::array()}, {"designs", Json::array()}};
  for (const RankedQuantity& quantity : quantities)
    json["quantities"].push_back({{"name", quantity.word},
                                  {"key", quantity.key},
                                  {"better", quantity.is_larger_better ? "larger" : "smaller"}});
  for (const RankedDesign& one : designs) {
    Json entry{{"name", one.design.name},
               {"folder", fmt::format("{}/{}", folder_of_designs, one.design.name)},
               {"start", one.design.text},
               {"sectors", one.design.source.wheel.sectors},
               {"parameters", Json::object()},
               {"front", one.front},
               {"run", word(one.result.progression)},
               {"ended", one.result.status},
               {"shapes", one.result.shapes},
               {"numbers", Json::object()}};
    for (const auto& [name, value] : one.design.parameters) entry["parameters"][name] = value;
    for (const auto& number : wheel_numbers<2>())
      entry["numbers"][number.key] = number_json(number_of(one.result, number.key));
    json["designs"].push_back(std::move(entry));
  }
  return json.dump(2) + '\n';
}

std::string designs_table(const std::vector<RankedDesign>& designs,
                          const std::vector<RankedQuantity>& quantities, int most_rows) {
  std::vector<std::vector<std::string>> rows{{"rank", "design", "start"}};
  for (const RankedQuantity& quantity : quantities)
    rows[0].push_back(fmt::format("{} [{}]", quantity.word, quantity.unit));
  for (int i = 0; i < std::min(most_rows, static_cast<int>(designs.size())); ++i) {
    const RankedDesign& one = designs[i];
    std::vector<std::string> row{fmt::format("{}{}", i + 1, one.front == 1 ? "*" : ""), one.design.name,
                                 one.design.text};
    for (const RankedQuantity& quantity : quantities) {
      const double value = one.result.value(quantity);
      row.push_back(std::isnan(value) ? one.result.status : fmt::format("{:.5g}", value * quantity.factor));
    }
    rows.push_back(std::move(row));
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      std::size_t width = 0;
      for (const auto& other : rows) width = std::max(width, other[k].size());
      text += k == 2 ? fmt::format("{:<{}}  ", row[k], width) : fmt::format("{:>{}}  ", row[k], width);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

std::string designs_page(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities, const std::string& title) {
  Json data{{"asked", Json::array()}, {"quantities", Json::array()}, {"designs", Json::array()}};
  for (const RankedQuantity& quantity : quantities) data["asked"].push_back(quantity.key);
  for (const RankedQuantity& quantity : ranked_quantities())
    data["quantities"].push_back({{"key", quantity.key},
                                  {"label", quantity.label},
                                  {"unit", quantity.unit},
                                  {"factor", quantity.factor}});
  int rank = 0;
  for (const RankedDesign& one : designs) {
    Json values = Json::object();
    for (const RankedQuantity& quantity : ranked_quantities())
      values[std::string(quantity.key)] = number_json(one.result.value(quantity));
    data["designs"].push_back({{"rank", ++rank},
                               {"name", one.design.name},
                               {"text", one.design.text},
                               {"front", one.front},
                               {"progression", word(one.result.progression)},
                               {"status", one.result.status},
                               {"shapes", one.result.shapes},
                               {"values", std::move(values)},
                               {"outline", one.outline}});
  }
  return filled_template(assets::designs_html, {{"@TITLE@", escape_xml(title)},
                                                {"@STYLE@", std::string(assets::report_css)},
                                                {"@OWN_STYLE@", std::string(assets::designs_css)},
                                                {"@HEADING@", escape_xml(title)},
                                                {"@DATA@", json_in_script(data)},
                                                {"@SCRIPT@", std::string(assets::designs_js)}});
}

}  // namespace wheelwright
