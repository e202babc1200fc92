#include "wheelwright/output/report/accurate_numbers.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/output/report/value_with_error.h"

namespace wheelwright {

std::string accuracy_table(const AccurateNumbers& numbers) {
  std::vector<std::string> labels;
  std::size_t width = 0;
  for (const AccurateNumber& number : numbers.numbers) {
    labels.push_back(fmt::format("{} [{}]", number.label, number.shown.name));
    width = std::max(width, labels.back().size());
  }
  std::string table = fmt::format("errors are at most {:.3g} % unless a reason is given, on {}\n",
                                  100 * numbers.accuracy, numbers.grid);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const auto& [label, key, kind, shown, value, error, reason] = numbers.numbers[k];
    table += fmt::format("{:<{}}  {:>22}{}{}\n", labels[k], width,
                         text_with_error(value * shown.factor, error.value_or(0) * shown.factor, kind),
                         reason.empty() ? "" : "  ", reason);
  }
  return table;
}

}  // namespace wheelwright
