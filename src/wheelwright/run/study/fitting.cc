#include "wheelwright/run/study/fitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/case/derived.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/evolution/islands.h"
#include "wheelwright/shape/evolution/printed_shapes.h"

namespace wheelwright {
namespace {

bool is_saved(const Case& c) { return c.saved_shape.shape.contents.get() != nullptr; }

/// Whether a shape may be changed to be made as the case asks.
bool may_be_fitted(const Case& c) {
  return mould(c) || print(c) || (is_saved(c) && invariance(c) != Invariance::none);
}

/// The largest change of the level set near an edge [m].
template <int dim>
double farthest_move(const LevelSet<dim>& given, const LevelSet<dim>& fitted) {
  const double cell = given.lattice.grid().resolution();
  double farthest = 0;
  for (std::size_t i = 0; i < given.values.size(); ++i)
    if (std::min(std::abs(given.values[i]), std::abs(fitted.values[i])) < cell)
      farthest = std::max(farthest, std::abs(given.values[i] - fitted.values[i]));
  return farthest;
}

/// Whether a shape that is printed needs no support.
template <int dim>
bool needs_no_support(const LevelSet<dim>& shape, const Case& c) {
  if constexpr (dim == 3)
    if (const auto layers = print(c)) return rises_from_the_plate(shape, layers->plate);
  return false;
}

/// Tells what is wrong with the given shape, and how it is changed.
template <int dim>
std::string problem(const LevelSet<dim>& given, const Case& c) {
  switch (c.optimizer.made) {
    case Manufacture::turned:
      return "is not a body of revolution: it is averaged";
    case Manufacture::extruded:
      return "is not the same along the axle: it is averaged";
    case Manufacture::printed:
      return needs_no_support(given, c)
                 ? "has edges that the layers of cells do not resolve: they are rounded"
                 : "cannot be printed without support: it is made to fit";
    default:
      return "does not come out of the mould: it is made to fit";
  }
}

template <int dim>
bool is_connected(const LevelSet<dim>& shape) {
  const auto attached = without_islands(shape, std::numeric_limits<double>::infinity());
  return attached && attached->removed.empty();
}

}  // namespace

template <int dim>
std::optional<std::string> fitting_of_initial_shape(const Case& c) {
  if (!may_be_fitted(c)) return {};
  const LevelSet<dim> fitted = initial_shape<dim>(c), given = shape_before_fitting<dim>(c);
  const double farthest = farthest_move(given, fitted);
  if (farthest < 1e-6 * given.lattice.grid().resolution()) return {};
  std::string effect = fmt::format("moves its edges by up to about {:.2g} mm", 1e3 * farthest);
  if (has_holes(given) && !has_holes(fitted))
    effect = "fills all its holes; smaller cells in [grid] may resolve them";
  else if (needs_no_support(given, c))
    effect += "; more grid.axial_cells, or larger fillets, move them less";
  return fmt::format("the {} {}, which {}", is_saved(c) ? "saved shape" : "initial shape", problem(given, c),
                     effect);
}

template <int dim>
std::string remedy_of_fitting(const Case& c) {
  if (!may_be_fitted(c) || !is_connected(shape_before_fitting<dim>(c))) return "";
  switch (c.optimizer.made) {
    case Manufacture::printed:
      return "a hole continues from the plate to the other side face, or it would need a roof: draw grooves "
             "in the side face that is not on the plate (side, optimizer.stands_on), or use a larger "
             "optimizer.overhang with more grid.axial_cells";
    case Manufacture::moulded:
      return "a hole in the parting plane goes through the wheel, and the draft widens it: use shallower "
             "grooves, another optimizer.parting_plane, or a smaller optimizer.draft";
    default:
      return "averaged along the axle or around it, its holes join: begin with another shape";
  }
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                              \
  template std::optional<std::string> fitting_of_initial_shape<dim>(const Case&); \
  template std::string remedy_of_fitting<dim>(const Case&);

WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)

}  // namespace wheelwright
