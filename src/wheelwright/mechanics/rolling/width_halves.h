#pragma once

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The model of the first half of a wheel's width, whose last side face is the middle plane. The loads of the
/// model must be their own mirror image there, and the number of cells along the axle must be even.
RollingModel<3> first_half(RollingModel<3> whole);

/// The nodes before the middle of the width and in it.
LevelSet<3> first_half(const LevelSet<3>& whole);

/// Which numbers of a wheel are those of the first half of its width, whose states are their own mirror image
/// in the middle plane: a number of the other half is that of its image, with the opposite sign for
/// components along the axle.
class WidthHalves {
 public:
  /// `half`: what the tread of the half wheel observes.
  WidthHalves(const PolarGrid<3>& whole, const TreadSurface<3>& half);

  /// The observed points of the tread of the whole wheel.
  const TreadSurface<3>& surface() const { return surface_; }

  Matrix observations(const Matrix& of_half) const;
  ContactPatch<3> patch(const ContactPatch<3>& of_half) const;
  /// First the points of the half, then their images, in the same order.
  std::vector<SurfacePoint<3>> boundary(const std::vector<SurfacePoint<3>>& of_half) const;
  RingField at_nodes(const RingField& of_half, int degree) const;

  /// The cell of the half with the same displacement, and whether it is the image of `cell`.
  struct Place {
    int cell;
    bool is_image;
  };
  Place place(int cell) const;

  /// How half of a function depends on the states of the half wheel, if the function of the whole wheel
  /// depends on them as `whole` says. Of the dependence on what is not even across the middle plane nothing
  /// is left.
  FunctionalDerivative<3> derivative_of_half(const FunctionalDerivative<3>& whole) const;

 private:
  /// Where a vector that the whole tread observes stands in the half one.
  struct Observed {
    int vector;
    bool is_image;
  };
  Matrix loads(const Matrix& on_whole) const;
  std::vector<Vec<3>> tractions(const std::vector<Vec<3>>& on_whole) const;
  /// The points of a column that a point of the whole wheel's column is equal to.
  Observed point(int of_whole) const {
    return {observed_[2 * of_whole].vector / 2, observed_[2 * of_whole].is_image};
  }

  PolarGrid<3> whole_;
  int half_rows_;                   ///< of what the half tread observes
  std::vector<Observed> observed_;  ///< all vectors but the integrals
  TreadSurface<3> surface_;
};

}  // namespace wheelwright
