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

RatedPoint rated_point(const DesignResult& result, const std::vector<RankedQuantity>& quantities) {
  RatedPoint point{{}, result.violation};
  for (const RankedQuantity& quantity : quantities)
    point.costs.push_back((quantity.is_larger_better ? -1 : 1) * result.value(quantity));
  return point;
}

std::vector<RatedPoint> rated_points(const std::vector<RatedDesign>& designs,
                                     const std::vector<RankedQuantity>& quantities) {
  std::vector<RatedPoint> all;
  for (const RatedDesign& one : designs) all.push_back(rated_point(one.result, quantities));
  return all;
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

}  // namespace wheelwright
