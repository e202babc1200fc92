#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {
namespace {

/// A radius must lie in its range, which must have a length.
bool check_range(const Case& c, const DesignRadius& one, Conflicts& found) {
  const auto refuse = [&](std::string problem, std::string remedy) {
    found.push_back({{one.key, key_of(&Wheel::inner_radius), key_of(&Wheel::outer_radius)},
                     std::move(problem),
                     std::move(remedy)});
    return false;
  };
  if (!(one.least < one.most))
    return refuse(fmt::format("the range from {:.6g} m to {:.6g} m has no length", one.least, one.most),
                  "write the least radius first, then the largest");
  if (one.radius < one.least || one.radius > one.most)
    return refuse(fmt::format("{} is {:.6g} m, outside of its range from {:.6g} m to {:.6g} m", one.name,
                              one.radius, one.least, one.most),
                  "begin inside the range");
  if (one.least <= c.wheel.inner_radius || one.most >= c.wheel.outer_radius)
    return refuse(
        fmt::format("the range from {:.6g} m to {:.6g} m reaches beyond the ring", one.least, one.most),
        fmt::format("the ring lies between the radii {:.6g} m and {:.6g} m", c.wheel.inner_radius,
                    c.wheel.outer_radius));
  return true;
}

/// The two sides of an edge at which layers meet must not have different ranges.
void check_both_sides(const Case& c, Conflicts& found) {
  const std::vector<DesignRadius> all = design_radii(c);
  const auto check = [&](double radius, const std::optional<std::array<double, 2>>& range,
                         const CaseKey& key) {
    if (!range) return;
    for (const DesignRadius& one : all)
      if (std::abs(one.radius - radius) < 1e-9 * c.wheel.outer_radius &&
          *range != std::array{one.least, one.most})
        found.push_back({{key, one.key},
                         fmt::format("{} has another range, and the layers meet", one.name),
                         "give the range once, or the same on both sides"});
  };
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    const auto [inner, outer] = radii(c, c.layers[i]);
    check(inner, c.layers[i].inner_radius_range, key_of(&MaterialLayer::inner_radius_range, i));
    check(outer, c.layers[i].outer_radius_range, key_of(&MaterialLayer::outer_radius_range, i));
  }
}

/// The case with one of its radii at an end of its range, and the others there too if they leave less room.
std::vector<double> with_one_at(const std::vector<DesignRadius>& all, std::size_t k, double radius) {
  std::vector<double> radii;
  for (const DesignRadius& one : all) radii.push_back(std::midpoint(one.least, one.most));
  radii[k] = radius;
  return radii;
}

/// Rows next to a moving line must keep a height: at the ends of the range they may be a quarter or four
/// times as high as in its middle, whatever the other radii are.
void check_rows(const Case& c, const std::vector<DesignRadius>& all, std::size_t k, Conflicts& found) {
  constexpr double most = 4;
  const Case middle = at_middle_radii(c);
  const PolarGrid<2> grid = polar_grid<2>(middle);
  const int line = grid.nearest_line(std::midpoint(all[k].least, all[k].most)).line;
  const EqualRows below = grid.equal_rows(line - 1), above = grid.equal_rows(line);
  const int core_rows = grid.cells[0] - tread_rows(c);
  if (line >= core_rows || above.end > core_rows) {
    found.push_back(
        {{all[k].key, key_of(&Grid::radial_cells)},
         fmt::format(
             "the outermost {} of cells, which begin{} at the radius {:.6g} m, are condensed once for "
             "all shapes, so that no layer may begin or end in or directly below them",
             core_rows == grid.cells[0] - 1 ? "row" : "rows", core_rows == grid.cells[0] - 1 ? "s" : "",
             grid.radius(core_rows)),
         "use more grid.radial_cells, or smaller radii"});
    return;
  }
  // Neighbours that move too come as near as their ranges allow.
  double inner = below.inner_radius, outer = above.outer_radius;
  if (k > 0 && all[k - 1].most > inner) inner = all[k - 1].most;
  if (k + 1 < all.size() && all[k + 1].least < outer) outer = all[k + 1].least;
  const double thinnest = std::min((all[k].least - inner) / below.count() / below.height(),
                                   (outer - all[k].most) / above.count() / above.height());
  if (thinnest >= 1 / most) return;
  found.push_back(
      {{all[k].key, key_of(&Grid::radial_cells)},
       fmt::format("the rows of cells between the radii {:.6g} m and {:.6g} m are stretched with the layers: "
                   "at an end of the range some would be less than a quarter as high as in its middle",
                   inner, outer),
       fmt::format("use a range within {:.6g} m and {:.6g} m, or narrower ones of neighbours",
                   inner + below.count() * below.height() / most,
                   outer - above.count() * above.height() / most)});
}

/// Functions whose other parts depend on the radii, and methods that do not move them.
void check_rest(const Case& c, const DesignRadius& first, Conflicts& found) {
  if (optimizer_method(c) == OptimizerMethod::descent)
    found.push_back(
        {{first.key, key_of(&Optimizer::method), key_of(&Optimizer::velocity), key_of(&Volume::control)},
         "steepest descent moves holes only",
         "use method = \"sequential_quadratic\", or omit the range"});
  const auto is_dual = [](const Quantity& quantity) { return quantity == built_in("uniformity_dual"); };
  if (c.objective.annulus_matches_dual || c.objective.uniformity_dual > 0 || is_dual(c.objective.minimize) ||
      std::ranges::any_of(c.constraints, is_dual, &Constraint::quantity) ||
      std::ranges::any_of(c.objective.terms, is_dual, &ObjectiveTerm::quantity))
    found.push_back(
        {{first.key, key_of(&Objective::uniformity_dual), key_of(&Objective::annulus_matches_dual)},
         "J_p2 contains the stiffness of the ring without holes, whose derivative with respect to "
         "radii of layers is not known",
         "use uniformity_annulus, or omit the range"});
}

/// The rows of the coarsest grid of the run must do too.
void check_coarse_rows(const Case& c, const std::vector<DesignRadius>& all, Conflicts& found) {
  const int levels = c.optimizer.coarse_levels;
  if (levels == 0 || !can_be_halved(c, levels)) return;
  const Case coarse = on_coarser_grid(c, levels);
  if (static_cast<int>(radii_of_lines(coarse).size()) >= coarse.grid.radial_cells) return;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Conflicts there;
    check_rows(coarse, all, k, there);
    if (!there.empty())
      found.push_back({{key_of(&Optimizer::coarse_levels), all[k].key, key_of(&Grid::radial_cells)},
                       "on the coarse grid: " + there.front().problem,
                       "use fewer coarse_levels, or a finer grid"});
  }
}

/// Whether bands of whole rows at rim and tread are still thick enough at both ends.
void check_bands(const Case& c, const std::vector<DesignRadius>& all, Conflicts& found) {
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const double end : {all[k].least, all[k].most}) {
      Conflicts there;
      wheel_conflicts(with_design_radii(c, with_one_at(all, k, end)), there);
      if (there.empty()) continue;
      CaseKeys keys = there.front().keys;
      keys.insert(keys.begin(), all[k].key);
      found.push_back({std::move(keys),
                       fmt::format("with {} = {:.6g} m: {}", all[k].name, end, there.front().problem),
                       there.front().remedy});
      break;
    }
}

}  // namespace

void design_radius_conflicts(const Case& c, Conflicts& found) {
  const std::vector<DesignRadius> all = design_radii(c);
  if (all.empty()) return;
  const std::size_t before = found.size();
  check_both_sides(c, found);
  for (const DesignRadius& one : all) check_range(c, one, found);
  check_rest(c, all.front(), found);
  if (found.size() > before || static_cast<int>(radii_of_lines(c).size()) >= c.grid.radial_cells) return;
  for (std::size_t k = 0; k < all.size(); ++k) check_rows(c, all, k, found);
  if (found.size() > before) return;
  check_coarse_rows(c, all, found);
  Conflicts now;
  wheel_conflicts(c, now);
  if (now.empty()) check_bands(c, all, found);
}

}  // namespace wheelwright
