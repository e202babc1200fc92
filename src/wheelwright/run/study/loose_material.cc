#include "wheelwright/run/study/loose_material.h"

#include <fmt/format.h>

#include <limits>

#include "wheelwright/run/study/fitting.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/evolution/islands.h"
#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {
namespace {

template <int dim>
std::vector<std::string> loose_pieces(const Case& c) {
  const auto attached = without_islands(initial_shape<dim>(c), std::numeric_limits<double>::infinity());
  if (!attached) {
    const std::string remedy = remedy_of_fitting<dim>(c);
    return {attached.failure().detail + (remedy.empty() ? "" : "; made to fit: " + remedy)};
  }
  std::vector<std::string> pieces;
  for (const ShapeEvent<dim>& piece : attached->removed)
    pieces.push_back(
        fmt::format("material of {} at {} is loose: connect it to the rim by material, or remove it",
                    measure_text<dim>(piece.measure), place_text<dim>(piece.place)));
  return pieces;
}

}  // namespace

std::vector<std::string> loose_material(const Case& c) {
  return c.wheel.dimension == 3 ? loose_pieces<3>(c) : loose_pieces<2>(c);
}

}  // namespace wheelwright
