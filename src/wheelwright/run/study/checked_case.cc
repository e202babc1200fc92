#include "wheelwright/run/study/checked_case.h"

#include <nlohmann/json.hpp>

#include "wheelwright/case/derived.h"
#include "wheelwright/run/study/problem_size.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

const char* to_string(Diagnostic::Kind kind) {
  using enum Diagnostic::Kind;
  switch (kind) {
    case unreadable:
      return "unreadable";
    case empty:
      return "empty";
    case syntax:
      return "syntax";
    case unknown_key:
      return "unknown_key";
    case missing_key:
      return "missing_key";
    case wrong_type:
      return "wrong_type";
    case out_of_range:
      return "out_of_range";
    case conflict:
      return "conflict";
    case drawing:
      return "drawing";
  }
  return "unknown";
}

Json problem_json(const Diagnostic& problem) {
  const auto place = [](int number) { return number > 0 ? Json(number) : Json(); };
  return {{"kind", to_string(problem.kind)}, {"file", problem.file},    {"line", place(problem.line)},
          {"column", place(problem.column)}, {"key", problem.key},      {"value", problem.value},
          {"problem", problem.problem},      {"remedy", problem.remedy}};
}

/// Of the contact under one load; estimates by Hertz are null for a given travel and for bushings.
Json contact_json(const Case& c) {
  const bool is_estimated = !c.load.travel && c.contact.with == Counterpart::ground;
  const auto estimate = [&](double (*number)(const Case&)) {
    return is_estimated ? Json(number(c)) : Json();
  };
  return {{"hertz_half_width_m", estimate(hertz_half_width)},
          {"hertz_peak_pressure_Pa", estimate(hertz_peak_pressure)},
          {"cells_in_contact", estimate(cells_per_contact_patch)}};
}

Json loads_json(const Case& c) {
  Case refined = c;
  refined.grid.tread_levels = tread_levels(c);
  const std::size_t n_named = c.load.cases.size();
  if (n_named == 0) return Json::array({contact_json(refined)});
  Json loads = Json::array();
  for (std::size_t k = 0; k < n_named; ++k) {
    Json load{{"load_case", c.load.cases[k].name}};
    load.update(contact_json(with_load_case(refined, static_cast<int>(k))));
    loads.push_back(load);
  }
  return loads;
}

Json width_json(const std::optional<cad::Clearance>& clearance) {
  return clearance ? Json(clearance->width) : Json();
}

Json derived_json(const CheckedCase& checked) {
  const Case& c = *checked.value;
  const auto& measured = checked.clearances;
  return {{"dimension", c.wheel.dimension},
          {"output_folder", c.output.folder},
          {"positions_per_sector", c.load.positions},
          {"unknowns", dof_bound(c)},
          {"memory_bytes", estimated_memory(problem_size(c))},
          {"tread_levels", tread_levels(c)},
          {"tread_levels_of_results", tread_levels_of_results(c)},
          {"thinnest_wall_m", measured ? width_json(measured->wall) : Json()},
          {"narrowest_gap_m", measured ? width_json(measured->gap) : Json()},
          {"loads", loads_json(c)}};
}

}  // namespace

std::string check_json(const CheckedCase& checked) {
  Json problems = Json::array();
  for (const Diagnostic& problem : checked.problems) problems.push_back(problem_json(problem));
  const Json json{{"case", checked.file},
                  {"problems", problems},
                  {"warnings", checked.warnings},
                  {"derived", checked.value ? derived_json(checked) : Json()}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace wheelwright
