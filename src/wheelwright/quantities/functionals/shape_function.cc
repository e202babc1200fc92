#include "wheelwright/quantities/functionals/shape_function.h"

#include <algorithm>

namespace wheelwright {

template <int dim>
bool are_mirror_symmetric(std::span<const ShapeFunction<dim>> functions, MirrorPlane plane) {
  // Position i's image is n - i; position 0 is its own.
  return std::ranges::all_of(functions, [&](const ShapeFunction<dim>& function) {
    const auto& w = function.position_weights;
    const bool weights_images_alike =
        plane != MirrorPlane::azimuth || w.empty() || std::equal(w.begin() + 1, w.end(), w.rbegin());
    return weights_images_alike && std::ranges::all_of(function.terms, [&](const auto& term) {
             return term.functional->is_mirror_symmetric(plane);
           });
  });
}

template decltype(are_mirror_symmetric<2>) are_mirror_symmetric<2>;
template decltype(are_mirror_symmetric<3>) are_mirror_symmetric<3>;

}  // namespace wheelwright
