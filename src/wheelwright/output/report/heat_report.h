#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/quantities/analysis/heat_results.h"

namespace wheelwright {

/// What a report says beside the temperatures.
struct HeatContext {
  std::vector<std::string> layers;  ///< their names, from the rim to the tread; empty: one material
  double width_factor;              ///< from powers of the results to those of the whole width
  int dimension;
  std::optional<double> error;  ///< estimate of that of the peak temperature [K]
};

/// For display: the peak temperature and its place, where the heat goes, and a line for every layer.
std::string heat_lines(const HeatResults& results, const HeatContext& context);

/// The same for programs, with SI units and degrees Celsius.
nlohmann::ordered_json heat_json(const HeatResults& results, const HeatContext& context);

/// One sentence for every material that gets warmer than it may.
std::vector<std::string> too_warm(const HeatResults& results, const std::vector<std::string>& layers);

}  // namespace wheelwright
