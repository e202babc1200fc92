#include "wheelwright/design/explore/report_designs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <tuple>

#include "wheelwright/case/dimension.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/design/explore/design_runs.h"
#include "wheelwright/design/explore/pareto.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/output/page/assets.h"
#include "wheelwright/output/page/html_template.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/output/report/value_with_error.h"
#include "wheelwright/output/report/within_errors.h"
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

/// The keys of all numbers: those of the first load case, then those of the others that depend on the load.
std::vector<std::string> number_keys(const std::vector<RankedDesign>& designs) {
  std::vector<std::string> keys, under_load;
  const auto add = [&](const std::string& key, bool is_of_shape) {
    keys.push_back(key);
    if (!is_of_shape) under_load.push_back(key);
  };
  if (designs.empty()) return keys;
  const Case& c = designs.front().design.source;
  in_dimension_of(c, [&](auto dim) {
    for (const auto& number : wheel_numbers<dim>()) add(number.key, number.is_of_shape);
    for (const std::string& layer : names_of_layers(c))
      for (const auto& number : layer_numbers<dim>(layer)) add(number.key, number.is_of_shape);
    for (const Quantity& own : c.vocabulary.quantities.own())
      add(number_key(own, dim), own->of == Positions::none);
  });
  for (const std::string& load_case : load_cases_of(designs))
    for (const std::string& key : under_load) keys.push_back(key_in_case(key, load_case));
  return keys;
}

/// All quantities of the designs.
std::vector<RankedQuantity> all_quantities(const std::vector<RankedDesign>& designs) {
  return designs.empty() ? ranked_quantities() : ranked_quantities(designs.front().design.source);
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

std::string violation_text(double violation) {
  return fmt::format("violates a bound by {:.2g} %", 100 * violation);
}

/// Returns what a reader must know of a design besides its numbers; empty if there is nothing.
std::string mark(const RatedDesign& one) {
  if (one.result.violation > 0) return violation_text(one.result.violation);
  if (!one.finer) return "";
  if (!one.finer->failure.empty()) return "not solved on a finer grid: " + one.finer->failure;
  return one.finer->violation > 0 ? violation_text(one.finer->violation) + " on a finer grid" : "";
}

/// How a design's run ended, and its mark.
std::string status(const RatedDesign& one) {
  const std::string marked = mark(one);
  return text_of_stop(one.result.status) + (marked.empty() ? "" : ", " + marked);
}

/// For the column of starts.
std::string start_text(const RatedDesign& one) {
  if (one.result.violation > 0) return fmt::format("{} ({})", one.design.text, status(one));
  const std::string marked = mark(one);
  return marked.empty() ? one.design.text : fmt::format("{} ({})", one.design.text, marked);
}

/// The keys of those numbers that some design has on a finer grid.
std::vector<std::string> finer_keys(const std::vector<RankedDesign>& designs) {
  std::vector<std::string> keys = number_keys(designs);
  std::erase_if(keys, [&](const std::string& key) {
    return std::ranges::none_of(designs, [&](const RankedDesign& one) { return one.error(key).has_value(); });
  });
  return keys;
}

Json finer_json(const FinerNumbers& finer, const std::vector<std::string>& keys) {
  if (!finer.failure.empty()) return {{"missing", finer.failure}};
  Json json{{"grid", finer.grid},
            {"bound_violation", finer.violation},
            {"numbers", Json::object()},
            {"errors", Json::object()}};
  for (const std::string& key : keys)
    if (finer.numbers.contains(key)) {
      json["numbers"][key] = finer.numbers.at(key);
      json["errors"][key] = finer.errors.at(key);
    }
  return json;
}

/// The undecided_designs, each with its quantity.
Json undecided_json(const std::vector<RankedDesign>& designs, const std::vector<RankedQuantity>& quantities) {
  Json json = Json::array();
  for (const UndecidedDesigns& undecided : undecided_designs(designs, quantities))
    json.push_back({{"quantity", undecided.quantity}, {"designs", undecided.designs}});
  return json;
}

bool is_on_finer_grid(const RatedDesign& one) { return one.finer && one.finer->failure.empty(); }

/// On their own grids, except for those on a finer one, which are compared with each other.
std::vector<int> fronts_of(const std::vector<RatedDesign>& designs,
                           const std::vector<RankedQuantity>& quantities) {
  std::vector<int> front = fronts(rated_points(designs, quantities));
  const auto finest = finest_points(designs, quantities);
  std::vector<RatedPoint> points;
  for (std::size_t i = 0; i < designs.size(); ++i)
    if (is_on_finer_grid(designs[i])) points.push_back(finest[i]);
  const std::vector<int> on_finer = fronts(points);
  for (std::size_t i = 0, k = 0; i < designs.size(); ++i)
    if (is_on_finer_grid(designs[i])) front[i] = on_finer[k++];
  return front;
}

}  // namespace

std::vector<UndecidedDesigns> undecided_designs(const std::vector<RankedDesign>& designs,
                                                const std::vector<RankedQuantity>& quantities) {
  std::vector<UndecidedDesigns> result;
  for (const RankedQuantity& quantity : quantities) {
    std::vector<EstimatedValue> values;
    std::vector<std::string> names;
    for (const RankedDesign& one : designs)
      if (const auto error = one.error(quantity.key)) {
        values.push_back({(quantity.is_larger_better ? -1 : 1) * one.value(quantity.key), *error});
        names.push_back(one.design.name);
      }
    for (const auto& group : groups_within_errors(values)) {
      result.push_back({quantity.word, {}});
      for (const std::size_t member : group) result.back().designs.push_back(names[member]);
    }
  }
  return result;
}

std::string text(const UndecidedDesigns& undecided) {
  return fmt::format("{}: {} differ by less than their errors", undecided.quantity,
                     listed(undecided.designs));
}

std::vector<RankedDesign> ranked(const std::vector<RatedDesign>& designs,
                                 const std::vector<RankedQuantity>& quantities) {
  const auto finest = finest_points(designs, quantities);
  const auto front = fronts_of(designs, quantities);
  std::vector<int> order(designs.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int i) {
    const bool has_result = front[i] > 0;
    return std::tuple(!has_result, designs[i].result.violation > 0, front[i], !is_on_finer_grid(designs[i]),
                      has_result ? finest[i].costs.front() : 0);
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
  const auto keys_on_finer = finer_keys(designs);
  for (const std::string& key : keys_on_finer) {
    header.push_back(key + " on a finer grid");
    header.push_back(key + " error");
  }
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
    for (const std::string& key : keys_on_finer) {
      const auto error = one.error(key);
      cells.push_back(error ? csv_number(one.value(key)) : "");
      cells.push_back(error ? csv_number(*error) : "");
    }
    text += csv_line(cells);
  }
  return text;
}

std::string designs_json(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities) {
  Json json{{"quantities", Json::array()},
            {"within_errors", undecided_json(designs, quantities)},
            {"designs", Json::array()}};
  const auto keys = number_keys(designs);
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
    for (const std::string& key : keys) entry["numbers"][key] = number_json(one.result.value(key));
    if (one.finer) entry["on_finer_grid"] = finer_json(*one.finer, keys);
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
                                 start_text(one)};
    for (const auto& [heading, key, factor] : shown) {
      const double value = one.value(key);
      const auto error = one.error(key);
      row.push_back(std::isnan(value) ? one.result.status
                    : error           ? text_with_error(value * factor, *error * factor)
                                      : fmt::format("{:.5g}", value * factor));
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
  Json data{{"asked", Json::array()},
            {"quantities", Json::array()},
            {"undecided", Json::array()},
            {"designs", Json::array()}};
  for (const UndecidedDesigns& undecided : undecided_designs(designs, quantities))
    data["undecided"].push_back(text(undecided));
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
    Json values = Json::object(), errors = Json::object();
    for (const auto& quantity : data["quantities"]) {
      const std::string key = quantity["key"];
      values[key] = number_json(one.value(key));
      if (const auto error = one.error(key)) errors[key] = *error;
    }
    data["designs"].push_back({{"rank", ++rank},
                               {"name", one.design.name},
                               {"text", one.design.text},
                               {"front", one.front},
                               {"progression", word(one.result.progression)},
                               {"status", status(one)},
                               {"shapes", one.result.shapes},
                               {"values", std::move(values)},
                               {"errors", std::move(errors)},
                               {"outline", one.outline}});
    if (!one.layers.empty()) data["designs"].back()["layers"] = one.layers;
  }
  return filled_template(assets::designs_html,
                         {{"@TITLE@", escape_xml(title)},
                          {"@STYLE@", std::string(assets::report_css)},
                          {"@OWN_STYLE@", std::string(assets::designs_css)},
                          {"@HEADING@", escape_xml(title)},
                          {"@DATA@", json_in_script(data)},
                          {"@SCRIPT@", std::string(assets::formats_js).append(assets::designs_js)}});
}

}  // namespace wheelwright
