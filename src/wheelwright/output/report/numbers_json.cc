#include "wheelwright/output/report/numbers_json.h"

#include <cmath>

#include "wheelwright/output/report/damage_by_load_case.h"
#include "wheelwright/output/report/linear_theory_json.h"

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

/// A place in the body, and the load position, whose azimuth is that of the ground.
template <int dim, class Place>
Json place_json(const Place& place, double ground) {
  Json json{{"radius_m", place[0]}, {"azimuth_rad", place[1]}, {"load_position_rad", ground}};
  if constexpr (dim == 3) json["z_m"] = place[2];
  return json;
}

template <int dim>
Json place_json(const FatigueResults::Worst& worst) {
  Json json{{"radius_m", worst.place[0]}, {"azimuth_rad", worst.place[1]}};
  if constexpr (dim == 3) json["z_m"] = worst.place[2];
  return json;
}

/// Where the material lasts least, and which load cases do the damage.
template <int dim>
void add_places_of_fatigue(const DescribedWheel<dim>& wheel, Json& json) {
  const std::string in_all = " in all load cases", fatigue_place = "fatigue_place";
  const auto& layers = wheel.loaded->rolling.layers;
  if (const auto& fatigue = wheel.loaded->fatigue; fatigue && *fatigue) {
    json[fatigue_place] = place_json<dim>((*fatigue)->worst);
    for (std::size_t k = 0; k < (*fatigue)->by_layer.size(); ++k)
      json[fatigue_place + " of " + layers[k].name] = place_json<dim>((*fatigue)->by_layer[k]);
  }
  if (!wheel.damage || !*wheel.damage) return;
  const auto add = [&](const std::string& of, const FatigueDamage::Worst& worst) {
    json[fatigue_place + of + in_all] = place_json<dim>(worst);
    json["damage_by_load_case" + of] = damage_json(worst, load_cases_of(wheel));
  };
  add("", (*wheel.damage)->worst);
  for (std::size_t k = 0; k < (*wheel.damage)->by_layer.size(); ++k)
    add(" of " + layers[k].name, (*wheel.damage)->by_layer[k]);
}

/// Facts about the load that the numbers do not contain.
template <int dim>
void add_details(const LoadedWheel<dim>& loaded, Json& json) {
  const ShapeSummary<dim>& summary = loaded.summary;
  json["pressure_spread"] = summary.rolling.pressure_spread;
  json["peak_von_mises_place"] = place_json<dim>(summary.von_mises.place, summary.von_mises.ground_azimuth);
  for (const LayerResults& layer : loaded.rolling.layers)
    json["peak_von_mises_place of " + layer.name] = place_json<dim>(layer.peak_place, layer.peak_ground);
  if (loaded.deformation.of_linear_theory) json["linear_theory"] = to_json(loaded.deformation.error);
  json["edges_overlap"] = loaded.deformation.edges_overlap;
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

template <int dim>
Json shape_json(const SummarizedShape<dim>& shape, const std::string& minimized) {
  Json json{{"shape", shape.iteration}};
  const char* objective = !minimized.empty() ? "objective" : dim == 2 ? "objective_J_per_m" : "objective_J";
  json[objective] = shape.objective ? Json(*shape.objective) : Json();
  add_numbers(shape.wheel, json);
  if (!shape.objective) json["missing"][objective] = shape.objective.failure();
  if (const auto& error = shape.objective_error) {
    json["errors"][objective] = *error ? Json(**error) : Json();
    if (!*error) json["missing_errors"][objective] = error->failure();
  }
  if (shape.wheel.loaded) {
    add_details(*shape.wheel.loaded, json);
    add_places_of_fatigue(shape.wheel, json);
  }
  if (const auto rough = roughness(shape.wheel)) {
    const Vec<2>& place = rough->edge.sharpest.place;
    json["roughness_place"] = {{"radius_m", norm<2>(place)}, {"azimuth_rad", std::atan2(place[1], place[0])}};
  }
  return json;
}

template decltype(shown_numbers<2>) shown_numbers<2>;
template decltype(shown_numbers<3>) shown_numbers<3>;
template decltype(add_numbers<2>) add_numbers<2>;
template decltype(add_numbers<3>) add_numbers<3>;
template decltype(shape_json<2>) shape_json<2>;
template decltype(shape_json<3>) shape_json<3>;

}  // namespace wheelwright
