#pragma once

#include <nlohmann/json.hpp>

#include "wheelwright/output/report/run_summary.h"

namespace wheelwright {

/// How to display numbers of wheels, in the order of tables: key, label, unit, and the factor from SI units
/// to it.
template <int dim>
nlohmann::ordered_json shown_numbers(const std::vector<WheelNumber<dim>>& numbers);

/// Adds the numbers of a wheel (numbers_of) by their keys, and under `load_cases` those that depend on the
/// load under every other load case. A number that could not be computed is null; `missing` next to it has
/// its key with the reason. If errors are estimated, `errors` has them by the keys of their numbers, and
/// `missing_errors` the reasons for those that are null.
template <int dim>
void add_numbers(const DescribedWheel<dim>& wheel, nlohmann::ordered_json& json);

/// A shape of a run: its number and its objective with its error, the numbers of its wheel as added by
/// add_numbers(), and facts about its load. `minimized` as in RunSummary.
template <int dim>
nlohmann::ordered_json shape_json(const SummarizedShape<dim>& shape, const std::string& minimized);

}  // namespace wheelwright
