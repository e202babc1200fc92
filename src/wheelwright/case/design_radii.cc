#include "wheelwright/case/design_radii.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"

namespace wheelwright {
namespace {

bool are_same(const Case& c, double a, double b) { return std::abs(a - b) < 1e-9 * c.wheel.outer_radius; }

}  // namespace

std::vector<DesignRadius> design_radii(const Case& c) {
  std::vector<DesignRadius> result;
  const auto add = [&](std::size_t layer, const char* edge, double radius,
                       std::optional<std::array<double, 2>> MaterialLayer::*range) {
    const auto& given = c.layers[layer].*range;
    if (!given || std::ranges::any_of(
                      result, [&](const DesignRadius& other) { return are_same(c, other.radius, radius); }))
      return;
    result.push_back({fmt::format("{} of {}", edge, name_of_layer(c, layer)), radius, given->front(),
                      given->back(), key_of(range, layer)});
  };
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    const auto [inner, outer] = radii(c, c.layers[i]);
    add(i, "inner_radius", inner, &MaterialLayer::inner_radius_range);
    add(i, "outer_radius", outer, &MaterialLayer::outer_radius_range);
  }
  std::ranges::stable_sort(result, {}, &DesignRadius::radius);
  return result;
}

Case with_design_radii(Case c, std::span<const double> chosen) {
  const Case before = c;
  const std::vector<DesignRadius> all = design_radii(before);
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    const auto [inner, outer] = radii(before, before.layers[i]);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (are_same(before, inner, all[k].radius)) c.layers[i].inner_radius = chosen[k];
      if (are_same(before, outer, all[k].radius)) c.layers[i].outer_radius = chosen[k];
    }
  }
  return c;
}

Case at_middle_radii(const Case& c) {
  std::vector<double> middles;
  for (const DesignRadius& one : design_radii(c)) middles.push_back(std::midpoint(one.least, one.most));
  return with_design_radii(c, middles);
}

std::vector<int> design_lines(const Case& c) {
  const PolarGrid<2> grid = polar_grid<2>(c);
  std::vector<int> lines;
  for (const DesignRadius& one : design_radii(c)) lines.push_back(grid.nearest_line(one.radius).line);
  return lines;
}

template <int dim>
std::optional<Case> with_radii_of(const Case& c, const PolarGrid<dim>& grid, int level) {
  std::vector<double> chosen;
  for (const int line : design_lines(on_coarser_grid(c, level))) {
    const auto fixed = std::ranges::find(grid.fixed_lines, line, &FixedLine::line);
    if (fixed == grid.fixed_lines.end()) return {};
    chosen.push_back(fixed->radius);
  }
  return chosen.empty() ? c : with_design_radii(c, chosen);
}

template decltype(with_radii_of<2>) with_radii_of<2>;
template decltype(with_radii_of<3>) with_radii_of<3>;

}  // namespace wheelwright
