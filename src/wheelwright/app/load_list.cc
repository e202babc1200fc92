#include "wheelwright/app/load_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace wheelwright {
namespace {

constexpr size_t most_loads = 1000;

std::optional<std::vector<double>> parse_numbers(std::string_view text, char separator) {
  std::vector<double> numbers;
  const char *p = text.data(), *end = p + text.size();
  while (true) {
    double number;
    const auto [rest, error] = std::from_chars(p, end, number);
    if (error != std::errc{} || !(number > 0) || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (rest == end) return numbers;
    if (*rest != separator || numbers.size() == most_loads) return {};
    p = rest + 1;
  }
}

std::optional<std::vector<double>> parse_range(std::string_view text) {
  const auto parts = parse_numbers(text, ':');
  if (!parts || parts->size() != 3) return {};
  const double first = (*parts)[0], last = (*parts)[1], n = (*parts)[2];
  if (n != std::floor(n) || n < 2 || n > most_loads) return {};
  std::vector<double> loads;
  for (int k = 0; k < n; ++k) loads.push_back(first + k * (last - first) / (n - 1));
  return loads;
}

}  // namespace

std::optional<std::vector<double>> parse_loads(const std::string& text) {
  auto loads = text.find(':') == std::string::npos ? parse_numbers(text, ',') : parse_range(text);
  if (!loads) return {};
  std::ranges::sort(*loads);
  loads->erase(std::unique(loads->begin(), loads->end()), loads->end());
  return loads;
}

}  // namespace wheelwright
