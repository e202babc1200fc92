#include "wheelwright/design/explore/report_designs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "wheelwright/design/explore/design_runs.h"
#include "wheelwright/design/explore/pareto.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/output/page/assets.h"
#include "wheelwright/output/page/html_template.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/run/results/stop_text.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

const char* word(Progression progression) { return progression == Progression::full ? "full" : "preview"; }

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// The names of the designs' load cases except the first.
std::vector<std::string> load_cases_of(const std::vector<RankedDesign>& designs) {
  std::vector<std::string> names;
  for (const RankedDesign& one : designs)
    for (const std::string& name : other_load_cases(one.design.source))
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

/// The quantities that the designs' program has added.
std::vector<RankedQuantity> own_quantities(const std::vector<RankedDesign>& designs) {
  std::vector<RankedQuantity> own;
  if (!designs.empty())
    for (const Quantity& quantity : designs.front().design.source.vocabulary.quantities.own())
      own.push_back(ranked(quantity));
  return own;
}

/// The keys of all numbers: those of the first load case, then those of the others that depend on the load.
std::vector<std::string> number_keys(const std::vector<RankedDesign>& designs) {
  std::vector<std::string> keys, under_load;
  const auto add = [&](const std::string& key, bool is_of_shape) {
    keys.push_back(key);
    if (!is_of_shape) under_load.push_back(key);
  };
  for (const auto& number : wheel_numbers<2>()) add(number.key, number.is_of_shape);
  for (const RankedQuantity& own : own_quantities(designs)) add(own.key, own.is_of_shape);
  for (const std::string& load_case : load_cases_of(designs))
    for (const std::string& key : under_load) keys.push_back(key_in_case(key, load_case));
  return keys;
}

/// All quantities of the designs.
std::vector<RankedQuantity> all_quantities(const std::vector<RankedDesign>& designs) {
  std::vector<RankedQuantity> all = ranked_quantities();
  const auto own = own_quantities(designs);
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

/// A column of the displayed table.
struct ShownNumber {
  std::string heading, key;
  double factor;  ///< from SI units
};

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

/// How a design's run ended, and by how much it violates its bounds.
std::string status(const DesignResult& result) {
  if (result.violation == 0) return text_of_stop(result.status);
  return fmt::format("{}, violates a bound by {:.2g} %", text_of_stop(result.status), 100 * result.violation);
}

}  // namespace

std::vector<RankedDesign> ranked(const std::vector<RatedDesign>& designs,
                                 const std::vector<RankedQuantity>& quantities) {
  const auto all = rated_points(designs, quantities);
  const auto front = fronts(all);
  std::vector<int> order(designs.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) {
    return std::pair(front[i] == 0 ? HUGE_VAL : front[i], front[i] == 0 ? 0 : all[i].costs.front());
  };
  std::ranges::stable_sort(order, {}, place);
  std::vector<RankedDesign> result;
  for (const int i : order)
    result.push_back({designs[i], designs[i].result.violation > 0 ? 0 : front[i], {}});
  return result;
}

std::string designs_csv(const std::vector<RankedDesign>& designs) {
  const auto names = parameter_names(designs);
  std::vector<std::string> header{"rank",   "design", "front",  "run", "ended", "bound_violation",
                                  "shapes", "start",  "sectors"};
  header.insert(header.end(), names.begin(), names.end());
  const auto keys = number_keys(designs);
  header.insert(header.end(), keys.begin(), keys.end());
  std::string text = csv_line(header);
  int rank = 0;
  for (const RankedDesign& one : designs) {
    std::vector<std::string> cells{std::to_string(++rank),
                                   one.design.name,
                                   std::to_string(one.front),
                                   word(one.result.progression),
                                   one.result.status,
                                   csv_number(one.result.violation),
                                   std::to_string(one.result.shapes),
                                   one.design.text,
                                   std::to_string(one.design.source.wheel.sectors)};
    for (const std::string& name : names) cells.push_back(csv_number(parameter(one.design, name)));
    for (const std::string& key : keys) cells.push_back(csv_number(one.result.value(key)));
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
               {"bound_violation", one.result.violation},
               {"shapes", one.result.shapes},
               {"numbers", Json::object()}};
    for (const auto& [name, value] : one.design.parameters) entry["parameters"][name] = value;
    for (const std::string& key : number_keys(designs))
      entry["numbers"][key] = number_json(one.result.value(key));
    json["designs"].push_back(std::move(entry));
  }
  return json.dump(2) + '\n';
}

std::string designs_table(const std::vector<RankedDesign>& designs,
                          const std::vector<RankedQuantity>& quantities, int max_rows) {
  std::vector<std::vector<std::string>> rows{{"rank", "design", "start"}};
  std::vector<ShownNumber> shown;
  for (const RankedQuantity& quantity : quantities)
    shown.push_back(
        {fmt::format("{} [{}]", quantity.word, quantity.shown.name), quantity.key, quantity.shown.factor});
  for (const std::string& load_case : load_cases_of(designs))
    for (const RankedQuantity& quantity : quantities)
      if (!quantity.is_of_shape)
        shown.push_back({fmt::format("{} in {} [{}]", quantity.word, load_case, quantity.shown.name),
                         key_in_case(quantity.key, load_case), quantity.shown.factor});
  for (const ShownNumber& number : shown) rows[0].push_back(number.heading);
  for (int i = 0; i < std::min(max_rows, static_cast<int>(designs.size())); ++i) {
    const RankedDesign& one = designs[i];
    std::vector<std::string> row{fmt::format("{}{}", i + 1, one.front == 1 ? "*" : ""), one.design.name,
                                 one.result.violation == 0
                                     ? one.design.text
                                     : fmt::format("{} ({})", one.design.text, status(one.result))};
    for (const auto& [heading, key, factor] : shown) {
      const double value = one.result.value(key);
      row.push_back(std::isnan(value) ? one.result.status : fmt::format("{:.5g}", value * factor));
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
  const auto all = all_quantities(designs);
  for (const RankedQuantity& quantity : all)
    data["quantities"].push_back({{"key", quantity.key},
                                  {"label", quantity.label},
                                  {"unit", quantity.shown.name},
                                  {"factor", quantity.shown.factor}});
  const auto others = load_cases_of(designs);
  for (const std::string& load_case : others)
    for (const RankedQuantity& quantity : all)
      if (!quantity.is_of_shape)
        data["quantities"].push_back({{"key", key_in_case(quantity.key, load_case)},
                                      {"label", fmt::format("{} in {}", quantity.label, load_case)},
                                      {"unit", quantity.shown.name},
                                      {"factor", quantity.shown.factor}});
  int rank = 0;
  for (const RankedDesign& one : designs) {
    Json values = Json::object();
    for (const auto& quantity : data["quantities"]) {
      const std::string key = quantity["key"];
      values[key] = number_json(one.result.value(key));
    }
    data["designs"].push_back({{"rank", ++rank},
                               {"name", one.design.name},
                               {"text", one.design.text},
                               {"front", one.front},
                               {"progression", word(one.result.progression)},
                               {"status", status(one.result)},
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
