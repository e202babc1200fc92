#include "wheelwright/design/explore/design.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace wheelwright {

double DesignResult::value(const RankedQuantity& quantity) const { return value(quantity.key); }

double DesignResult::value(const std::string& key) const {
  const auto found = numbers.find(key);
  return found == numbers.end() ? std::nan("") : found->second;
}

std::string key_in_case(std::string_view key, std::string_view load_case) {
  return std::string(key) + " in " + std::string(load_case);
}

std::vector<std::string> other_load_cases(const Case& c) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k < c.load.cases.size(); ++k) names.push_back(c.load.cases[k].name);
  return names;
}

double RatedDesign::value(const std::string& key) const {
  if (finer)
    if (const auto found = finer->numbers.find(key); found != finer->numbers.end()) return found->second;
  return result.value(key);
}

std::optional<double> RatedDesign::error(const std::string& key) const {
  if (!finer) return {};
  const auto found = finer->errors.find(key);
  return found == finer->errors.end() ? std::nullopt : std::optional(found->second);
}

namespace {

/// The points of designs whose value of a key is `value(design, key)`.
template <class Value>
std::vector<RatedPoint> points_of(const std::vector<RatedDesign>& designs,
                                  const std::vector<RankedQuantity>& quantities, const Value& value) {
  std::vector<RatedPoint> all;
  for (const RatedDesign& one : designs) {
    RatedPoint& point = all.emplace_back(RatedPoint{{}, one.result.violation});
    for (const RankedQuantity& quantity : quantities)
      point.costs.push_back((quantity.is_larger_better ? -1 : 1) * value(one, quantity.key));
  }
  return all;
}

}  // namespace

std::vector<RatedPoint> rated_points(const std::vector<RatedDesign>& designs,
                                     const std::vector<RankedQuantity>& quantities) {
  return points_of(designs, quantities,
                   [](const RatedDesign& one, const std::string& key) { return one.result.value(key); });
}

std::vector<RatedPoint> finest_points(const std::vector<RatedDesign>& designs,
                                      const std::vector<RankedQuantity>& quantities) {
  return points_of(designs, quantities,
                   [](const RatedDesign& one, const std::string& key) { return one.value(key); });
}

std::string to_json(const DesignResult& result) {
  nlohmann::ordered_json json{{"progression", result.progression == Progression::full ? "full" : "preview"},
                              {"status", result.status},
                              {"shapes", result.shapes},
                              {"bound_violation", result.violation},
                              {"numbers", nlohmann::ordered_json::object()}};
  for (const auto& [key, value] : result.numbers) json["numbers"][key] = value;
  return json.dump(2) + '\n';
}

DesignResult design_result(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  DesignResult result{json.at("progression") == "full" ? Progression::full : Progression::preview,
                      json.at("status"), json.at("shapes")};
  result.violation = json.at("bound_violation");
  for (const auto& [key, value] : json.at("numbers").items()) result.numbers[key] = value.get<double>();
  return result;
}

std::string to_json(const FinerNumbers& finer) {
  nlohmann::ordered_json json{
      {"grid", finer.grid}, {"failure", finer.failure}, {"bound_violation", finer.violation}};
  json["numbers"] = finer.numbers;
  json["errors"] = finer.errors;
  return json.dump(2) + '\n';
}

FinerNumbers finer_numbers(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  return {.grid = json.at("grid"),
          .failure = json.at("failure"),
          .numbers = json.at("numbers").get<std::map<std::string, double>>(),
          .errors = json.at("errors").get<std::map<std::string, double>>(),
          .violation = json.at("bound_violation")};
}

}  // namespace wheelwright
