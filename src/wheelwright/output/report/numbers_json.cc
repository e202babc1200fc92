#include "wheelwright/output/report/numbers_json.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

template <int dim>
void add_number(const WheelNumber<dim>& number, const DescribedWheel<dim>& wheel, Json& json, Json& missing) {
  const auto value = number.value(wheel);
  if (!value) return;
  json[number.key] = *value ? Json(**value) : Json();
  if (!*value) missing[number.key] = value->failure();
}

}  // namespace

template <int dim>
Json shown_numbers(const std::vector<WheelNumber<dim>>& numbers) {
  Json rows = Json::array();
  for (const WheelNumber<dim>& number : numbers)
    rows.push_back({{"key", number.key},
                    {"label", number.label},
                    {"unit", number.shown().name},
                    {"factor", number.shown().factor}});
  return rows;
}

template <int dim>
void add_numbers(const DescribedWheel<dim>& wheel, Json& json) {
  Json missing;
  const auto numbers = numbers_of(wheel);
  for (const WheelNumber<dim>& number : numbers) add_number(number, wheel, json, missing);
  if (!missing.empty()) json["missing"] = std::move(missing);
  if (!wheel.load_case.empty()) json["load_case"] = wheel.load_case;
  for (const DescribedWheel<dim>& other : wheel.others) {
    Json& of_case = json["load_cases"][other.load_case];
    Json missing_of_case;
    for (const WheelNumber<dim>& number : numbers)
      if (!number.is_of_shape) add_number(number, other, of_case, missing_of_case);
    if (!missing_of_case.empty()) of_case["missing"] = std::move(missing_of_case);
  }
}

template decltype(shown_numbers<2>) shown_numbers<2>;
template decltype(shown_numbers<3>) shown_numbers<3>;
template decltype(add_numbers<2>) add_numbers<2>;
template decltype(add_numbers<3>) add_numbers<3>;

}  // namespace wheelwright
