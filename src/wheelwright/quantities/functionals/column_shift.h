#pragma once

#include <array>
#include <optional>
#include <vector>

#include "wheelwright/mechanics/state/tread_surface.h"

namespace wheelwright {

/// What columns of the tread observe, as it would be observed at the same points of columns that lie a
/// fraction of a column farther round the ring, in those columns' own frames. On each face of the tread, and
/// on each line of points in the annulus, what is observed is the polynomial through the face's Gauss points;
/// at a point between two faces, it is the mean of theirs. The integrals are interpolated linearly. With
/// the fraction 0 nothing changes.
template <int dim>
class ColumnShift {
 public:
  /// 0 <= fraction < 1.
  ColumnShift(const TreadSurface<dim>& tread, double fraction);

  /// Adds `factor` times what the shifted column observes, from what the column and the next one observe.
  void add(double factor, const double* column, const double* next, double* shifted) const;

  /// The transpose: adds `factor` times loads on the shifted column's observations to loads on those of the
  /// column and of the next one.
  void add_transposed(double factor, const double* shifted, double* column, double* next) const;

 private:
  /// A share of one observation in another; observations are counted as vectors of dim rows.
  struct Share {
    int to, from;
    bool from_next;  ///< from the next column
    double weight;
  };

  void interpolate(const FaceRow& row, double fraction);

  double fraction_;
  std::optional<int> number_;  ///< row of the observation that is no vector

  std::vector<Share> shares_;
  /// Cosine and sine of the turn from the column's frame, and from the next one's, to the shifted column's.
  std::array<std::array<double, 2>, 2> to_shifted_frame_;
};

}  // namespace wheelwright
