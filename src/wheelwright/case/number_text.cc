#include "wheelwright/case/number_text.h"

#include <fmt/format.h>

namespace wheelwright {

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (const auto plus = text.find('+'); plus != std::string::npos) return text.erase(plus, 1);
  constexpr std::size_t shortest_run_of_zeros = 6;
  const std::size_t n_digits = text.find_last_not_of('0') + 1, n_zeros = text.size() - n_digits;
  return n_zeros < shortest_run_of_zeros ? text : fmt::format("{}e{}", text.substr(0, n_digits), n_zeros);
}

}  // namespace wheelwright
