#include "wheelwright/output/report/gains.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace wheelwright {
namespace {

/// Words for a value that increased, decreased, or stayed the same.
struct Words {
  const char *larger, *smaller, *same;
};

/// Nothing if there is no relative change, as from a run-out of 0.
std::optional<std::string> change(double before, double after, const Words& words) {
  const double percents = 100 * (after / before - 1);
  constexpr double minimum = 0.05, most = 1000;
  if (!std::isfinite(percents)) return {};
  if (std::abs(percents) < minimum) return words.same;
  if (percents > most) return fmt::format("more than ten times {}", words.larger);
  return fmt::format("{:.1f} % {}", std::abs(percents), percents > 0 ? words.larger : words.smaller);
}

/// In degrees Celsius, whose zero is arbitrary.
std::string change_of_temperature(double before, double after) {
  constexpr double minimum = 0.05;
  if (std::abs(after - before) < minimum) return "as before";
  return fmt::format("{:.1f} K {}", std::abs(after - before), after > before ? "higher" : "lower");
}

/// The number with this key in summary.json.
template <int dim>
std::optional<double> value(const DescribedWheel<dim>& wheel, std::string_view key) {
  for (const WheelNumber<dim>& number : wheel_numbers<dim>())
    if (number.key == key) return known_value(number, wheel);
  return {};
}

template <int dim>
std::optional<std::string> change(const RunSummary<dim>& summary, std::string_view key, const Words& words) {
  const auto before = value(summary.before.wheel, key), after = value(summary.after.wheel, key);
  if (!before || !after) return {};
  return change(*before, *after, words);
}

}  // namespace

template <int dim>
std::string gains(const RunSummary<dim>& summary) {
  std::vector<std::string> parts;
  const auto add = [&](const std::string& subject, const std::optional<std::string>& changed) {
    if (changed) parts.push_back(subject + *changed);
  };
  add("", change(summary, "stiffness_N_per_m", {"stiffer", "softer", "as stiff as before"}));
  add("run-out ", change(summary, "run_out_m", {"larger", "smaller", "as large as before"}));
  const KnownNumber &before = summary.before.objective, &after = summary.after.objective;
  if (before && after)
    add(summary.minimized.empty() ? "objective " : summary.minimized + " ",
        summary.objective_kind == UnitKind::temperature
            ? change_of_temperature(*before, *after)
            : change(*before, *after, {"higher", "lower", "as before"}));
  return parts.empty() ? "" : fmt::format("Compared with before: {}", fmt::join(parts, ", "));
}

template decltype(gains<2>) gains<2>;
template decltype(gains<3>) gains<3>;

}  // namespace wheelwright
