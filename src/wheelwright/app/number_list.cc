#include "wheelwright/app/number_list.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace wheelwright {
namespace {

constexpr std::size_t max_numbers = 1000;

std::optional<std::vector<double>> parse_numbers(std::string_view text, char separator) {
  std::vector<double> numbers;
  const char *p = text.data(), *end = p + text.size();
  while (true) {
    double number;
    const auto [rest, error] = std::from_chars(p, end, number);
    if (error != std::errc{} || !std::isfinite(number)) return {};
    numbers.push_back(number);
    if (rest == end) return numbers;
    if (*rest != separator || numbers.size() == max_numbers) return {};
    p = rest + 1;
  }
}

/// Without the rounding errors of a step, as in 0.1 + 2 * 0.1.
double to_twelve_digits(double x) {
  const std::string text = fmt::format("{:.12g}", x);
  std::from_chars(text.data(), text.data() + text.size(), x);
  return x;
}

}  // namespace

std::optional<std::vector<double>> parse_number_list(std::string_view text) {
  constexpr std::string_view log_suffix = ":log";
  if (text.find(':') == std::string_view::npos) return parse_numbers(text, ',');
  const bool is_log = text.ends_with(log_suffix);
  if (is_log) text.remove_suffix(log_suffix.size());
  const auto parts = parse_numbers(text, ':');
  if (!parts || parts->size() != 3) return {};
  const double first = (*parts)[0], last = (*parts)[1], n = (*parts)[2];
  if (n != std::floor(n) || n < 2 || n > max_numbers || (is_log && !(first > 0 && last > 0))) return {};
  std::vector<double> numbers;
  for (int k = 0; k < n; ++k) {
    const double share = k / (n - 1);
    numbers.push_back(k == n - 1 ? last
                      : is_log   ? first * std::pow(last / first, share)
                                 : to_twelve_digits(first + share * (last - first)));
  }
  return numbers;
}

}  // namespace wheelwright
