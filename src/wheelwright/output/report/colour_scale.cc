#include "wheelwright/output/report/colour_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wheelwright/output/report/colour_map.h"
#include "wheelwright/output/report/plot_svg.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

constexpr double bar_width = 18, bar_height = 320;
constexpr int max_ticks = 6;

/// The smallest round number not below the value, which must be > 0.
double rounded_up(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double digits : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (digits * decade >= value) return digits * decade;
  return 10 * decade;
}

std::vector<double> finite(std::span<const double> values) {
  std::vector<double> result;
  std::ranges::copy_if(values, std::back_inserter(result), [](double v) { return std::isfinite(v); });
  return result;
}

/// The value with the given number of smaller ones. Reorders them.
double with_smaller(std::vector<double>& values, std::size_t n) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::ranges::nth_element(values, place);
  return *place;
}

/// Round numbers in the unit with its prefix; the value itself if there is only one.
std::vector<double> ticks(const ColourScale& scale, const SiPrefix& prefix) {
  const double lower = scale.lower / prefix.factor, upper = scale.upper / prefix.factor;
  if (!(upper > lower)) return {lower};
  return axis_ticks(lower, upper, max_ticks);
}

}  // namespace

SiPrefix si_prefix(double value) {
  struct Range {
    double from;
    SiPrefix prefix;
  };
  constexpr std::array<Range, 7> ranges{{{1e9, {1e9, "G"}},
                                         {1e5, {1e6, "M"}},
                                         {1e3, {1e3, "k"}},
                                         {1, {1, ""}},
                                         {1e-4, {1e-3, "m"}},
                                         {1e-7, {1e-6, "\u00b5"}},
                                         {1e-10, {1e-9, "n"}}}};
  for (const Range& range : ranges)
    if (std::abs(value) >= range.from) return range.prefix;
  return {1, ""};
}

SiPrefix si_prefix(double value, const std::string& unit) {
  return unit.starts_with("deg") ? SiPrefix{1, ""} : si_prefix(value);
}

std::string value_text(double value, const std::string& unit) {
  const SiPrefix prefix = si_prefix(value, unit);
  return fmt::format("{:.3g} {}{}", value / prefix.factor, prefix.symbol, unit);
}

ColourScale colour_scale(std::span<const double> values, double outliers) {
  std::vector<double> all = finite(values);
  if (all.empty()) return {0, 0};
  const auto [minimum, maximum] = std::ranges::minmax(all);
  const auto out = static_cast<std::size_t>(outliers * static_cast<double>(all.size()));
  const double lower = with_smaller(all, out), upper = with_smaller(all, all.size() - 1 - out);
  return {lower, upper, minimum, maximum};
}

ColourScale colour_scale_from_zero(std::span<const double> values, double outliers) {
  const ColourScale all = colour_scale(values, outliers);
  if (!(all.upper > 0)) return {0, 0};
  return {.lower = 0, .upper = rounded_up(all.upper), .smallest = 0, .largest = all.largest};
}

std::string level_colour(int level) { return viridis((level + 0.5) / ColourScale::levels); }

std::string colour_bar(const ColourScale& scale, const std::string& name, const std::string& unit, double x,
                       double y) {
  const SiPrefix prefix = si_prefix(std::max(std::abs(scale.lower), std::abs(scale.upper)), unit);
  const double step = bar_height / ColourScale::levels;
  std::string svg;
  for (int level = 0; level < ColourScale::levels; ++level)
    svg += fmt::format("<rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
                       y - step * (level + 1), bar_width, step + 0.3, level_colour(level));
  if (scale.is_cut_above())
    svg += fmt::format(
        "<path fill=\"{}\" d=\"M{} {}l{} -14 {} 14z\"/><text x=\"{}\" y=\"{}\">up to {:.3g}</text>\n",
        level_colour(ColourScale::levels - 1), x, y - bar_height, 0.5 * bar_width, 0.5 * bar_width,
        x + bar_width + 9, y - bar_height - 12, scale.largest / prefix.factor);
  if (scale.is_cut_below())
    svg += fmt::format("<path fill=\"{}\" d=\"M{} {}l{} 14 {} -14z\"/>\n", level_colour(0), x, y,
                       0.5 * bar_width, 0.5 * bar_width);
  for (const double tick : ticks(scale, prefix)) {
    const double height = y - bar_height * scale.fraction(tick * prefix.factor);
    svg += fmt::format(
        "<path stroke=\"#24292f\" d=\"M{0} {1:.2f}h5\"/><text x=\"{2}\" y=\"{3:.2f}\">{4:.6g}</text>\n",
        x + bar_width, height, x + bar_width + 9, height + 5, tick);
  }
  svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y - bar_height - 50, escape_xml(name));
  svg += fmt::format("<text x=\"{}\" y=\"{}\">[{}{}]</text>\n", x, y - bar_height - 30, prefix.symbol,
                     escape_xml(unit));
  return svg;
}

}  // namespace wheelwright
