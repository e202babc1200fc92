#include "wheelwright/functionals/shape_function.h"

#include <algorithm>

namespace wheelwright {

template <int dim>
bool weights_are_mirror_symmetric(std::span<const ShapeFunction<dim>> functions) {
  // Position i's image is n - i; position 0 is its own.
  return std::ranges::all_of(functions, [](const ShapeFunction<dim>& function) {
    const auto& w = function.position_weights;
    return w.empty() || std::equal(w.begin() + 1, w.end(), w.rbegin());
  });
}

template bool weights_are_mirror_symmetric(std::span<const ShapeFunction<2>>);
template bool weights_are_mirror_symmetric(std::span<const ShapeFunction<3>>);

}  // namespace wheelwright
