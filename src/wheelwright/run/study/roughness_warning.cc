#include "wheelwright/run/study/roughness_warning.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

std::string remedy(const Case& c) {
  if (level_set_degree(c) > 1)
    return "level_set_degree = 1 under [grid] gives cleaner edges at nearly the same objective";
  if (c.optimizer.smoothing == 0) return "smoothing = 0.1 under [optimizer] gives cleaner edges";
  return "a larger smoothing under [optimizer] gives cleaner edges";
}

std::optional<cad::Roughness> initial_roughness(const Case& c) {
  constexpr double tolerance = 1e-4;  // of the tread's radius
  const LevelSet<2> shape = initial_shape<2>(c);
  const PolarGrid<2>& grid = shape.lattice.grid();
  const auto outline = cad::fit_outline(shape, tolerance * grid.outer_radius);
  return outline ? cad::roughness(*outline, grid.n_sectors, grid.resolution()) : std::nullopt;
}

}  // namespace

std::string roughness_warning(const Case& c, const std::optional<cad::Roughness>& measured,
                              const std::optional<cad::Roughness>& initial) {
  constexpr double mm = 1e3;
  const bool is_drawn = c.saved_shape.from.empty() && initial;
  const double allowed = std::max(most_turns, is_drawn ? initial->edge.turns + turns_beyond_drawing : 0);
  if (!measured || measured->edge.turns <= allowed) return {};
  return fmt::format(
      "an edge makes {:.2f} turns where its radius is below {:.3g} mm, one cell, most sharply at {}: it has "
      "teeth or ripples of that size, which cannot be cut; {}",
      measured->edge.turns, measured->length * mm, cad::place_of(measured->edge.sharpest.place), remedy(c));
}

std::string roughness_warning(const Case& c, const std::optional<cad::Roughness>& measured) {
  const bool may_be_too_rough = measured && measured->edge.turns > most_turns;
  return roughness_warning(c, measured, may_be_too_rough ? initial_roughness(c) : std::nullopt);
}

}  // namespace wheelwright
