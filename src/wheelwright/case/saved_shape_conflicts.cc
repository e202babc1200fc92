#include <fmt/format.h>
#include <fmt/ranges.h>

#include <variant>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/shape_symmetry.h"
#include "wheelwright/shape/geometry/values_on.h"

namespace wheelwright {

namespace {

/// The ring and the sectors of a saved shape must be those of the wheel; in three dimensions its width too.
template <int dim>
void check_saved_grid(const Case& c, const PolarGrid<dim>& grid, Conflicts& found) {
  if (dim == 3 && c.wheel.dimension == 2) {
    found.push_back({{key_of(&SavedShape::from), key_of(&Wheel::dimension)},
                     "a 2D wheel cannot start from a 3D shape",
                     "use wheel.dimension = 3, or the shape of a 2D run"});
    return;
  }
  const std::string problem = misfit(grid, polar_grid<dim>(c));
  if (problem.empty()) return;
  CaseKeys keys{key_of(&SavedShape::from), key_of(&Wheel::inner_radius), key_of(&Wheel::outer_radius),
                key_of(&Wheel::sectors)};
  std::string width;
  if (dim == 3) {
    keys.push_back(key_of(&Wheel::width));
    width = fmt::format("wheel.width = {}, ", number_text(grid.width));
  }
  found.push_back({std::move(keys), fmt::format("the saved shape does not fit: {}", problem),
                   fmt::format("set wheel.inner_radius = {}, wheel.outer_radius = {}, {}and wheel.sectors to "
                               "one of {}",
                               number_text(grid.inner_radius), number_text(grid.outer_radius), width,
                               fmt::join(divisors(grid.n_sectors), ", "))});
}

}  // namespace

/// A saved shape replaces holes and drawn shapes, and must fit the ring and its sectors.
void saved_shape_conflicts(const Case& c, Conflicts& found) {
  if (c.saved_shape.from.empty()) return;
  const auto refuse_besides = [&](const CaseKey& key) {
    found.push_back({{key, key_of(&SavedShape::from)},
                     "holes and shapes cannot be drawn over the shape of another run",
                     "keep the shape of the other run, or the drawn ones"});
  };
  if (!c.holes.rings.empty()) refuse_besides(table_of<HoleRing>(0));
  if (!c.holes.circles.empty()) refuse_besides(table_of<HoleCircle>(0));
  for_each_shape_section([&](const auto& section) {
    using Shape = typename std::decay_t<decltype(section.of(c))>::value_type;
    if (!section.of(c).empty()) refuse_besides(table_of<Shape>(0));
  });
  const SavedLevelSet* shape = c.saved_shape.shape.contents.get();
  if (!shape || c.wheel.inner_radius >= c.wheel.outer_radius) return;
  if (const auto* solid = std::get_if<LevelSet<3>>(shape))
    check_saved_grid<3>(c, solid->lattice.grid(), found);
  else
    check_saved_grid<2>(c, std::get<LevelSet<2>>(*shape).lattice.grid(), found);
}

}  // namespace wheelwright
