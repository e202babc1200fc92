#include "wheelwright/output/report/numbers_json.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

/// A number, and why it is missing.
void add_number(const std::string& key, const std::optional<KnownNumber>& value, Json& json, Json& missing) {
  if (!value) return;
  json[key] = *value ? Json(**value) : Json();
  if (!*value) missing[key] = value->failure();
}

/// The numbers of a wheel with `errors`, the estimates of their errors, and `missing`, the reasons for nulls;
/// `missing_errors` has those for errors.
template <int dim>
void add_with_errors(const std::vector<WheelNumber<dim>>& numbers, const DescribedWheel<dim>& wheel,
                     Json& json) {
  Json missing, errors, missing_errors;
  for (const WheelNumber<dim>& number : numbers) {
    add_number(number.key, number.value(wheel), json, missing);
    add_number(number.key, error_of(number, wheel), errors, missing_errors);
  }
  if (!missing.empty()) json["missing"] = std::move(missing);
  if (!errors.empty()) json["errors"] = std::move(errors);
  if (!missing_errors.empty()) json["missing_errors"] = std::move(missing_errors);
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
  auto numbers = numbers_of(wheel);
  add_with_errors(numbers, wheel, json);
  if (!wheel.load_case.empty()) json["load_case"] = wheel.load_case;
  std::erase_if(numbers, [](const WheelNumber<dim>& number) { return number.is_of_shape; });
  for (const DescribedWheel<dim>& other : wheel.others)
    add_with_errors(numbers, other, json["load_cases"][other.load_case]);
}

template decltype(shown_numbers<2>) shown_numbers<2>;
template decltype(shown_numbers<3>) shown_numbers<3>;
template decltype(add_numbers<2>) add_numbers<2>;
template decltype(add_numbers<3>) add_numbers<3>;

}  // namespace wheelwright
