#pragma once

namespace wheelwright {

/// The boundary condition at the side faces of a wheel when dim = 3.
enum class SideFaces {
  free,       ///< no traction
  symmetric,  ///< no displacement along the axle and no shear: the wheel is a slice of an endless one
  // Half of such a wheel, whose last side face is the middle plane of the whole one, its mirror plane.
  half_of_free,
  half_of_symmetric,
};

/// Whether the last side face is the middle plane of a wheel of twice the width.
constexpr bool is_half(SideFaces sides) {
  return sides == SideFaces::half_of_free || sides == SideFaces::half_of_symmetric;
}

/// The side faces of half of a whole wheel.
constexpr SideFaces half_of(SideFaces whole) {
  return whole == SideFaces::free ? SideFaces::half_of_free : SideFaces::half_of_symmetric;
}

/// Whether side faces fix a component of the displacement of the node at this position among the nodes along
/// the axle, 0 to `last`.
template <int dim>
constexpr bool is_held(SideFaces sides, int axial_position, int last, int component) {
  if (dim == 2 || component != 2) return false;
  const bool first_is_held = sides == SideFaces::symmetric || sides == SideFaces::half_of_symmetric;
  return (axial_position == 0 && first_is_held) || (axial_position == last && sides != SideFaces::free);
}

}  // namespace wheelwright
