#pragma once

namespace wheelwright {

/// What the side faces of a wheel do when dim = 3.
enum class SideFaces {
  free,       ///< no traction
  symmetric,  ///< no displacement along the axle and no shear: the wheel is a slice of an endless one
};

/// Whether side faces hold a component of the displacement of the node at this position among the nodes along
/// the axle, of which `last` is the last one.
template <int dim>
constexpr bool is_held(SideFaces sides, int axial_position, int last, int component) {
  return dim == 3 && sides == SideFaces::symmetric && component == 2 &&
         (axial_position == 0 || axial_position == last);
}

}  // namespace wheelwright
