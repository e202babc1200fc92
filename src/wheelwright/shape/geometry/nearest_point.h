#pragma once

#include <algorithm>
#include <limits>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// Finds the nearest of many points of R^dim with nanoflann's k-d tree. Of several equally near points, finds
/// the first one, whatever the structure of the tree.
template <int dim>
class NearestPoint {
 public:
  /// Requires at least one point.
  explicit NearestPoint(std::vector<Vec<dim>> points) : cloud_{std::move(points)}, tree_(dim, cloud_) {}

  const std::vector<Vec<dim>>& points() const { return cloud_.points; }

  /// Index of the point nearest to x.
  int index_of_nearest(const Vec<dim>& x) const {
    return std::max(searched(x, std::numeric_limits<double>::infinity()), 0);
  }

  /// The same, faster if the point of index `guess` is about as near.
  int index_of_nearest(const Vec<dim>& x, int guess) const {
    const int nearest = index_of_nearest_within(norm(x - points()[guess]), x);
    return nearest < 0 ? guess : nearest;
  }

  /// Index of the point nearest to x if it is not farther away than `distance`, up to rounding; -1 if it is.
  int index_of_nearest_within(double distance, const Vec<dim>& x) const {
    constexpr double margin = 1e-9;
    return searched(x, (1 + margin) * distance * distance + std::numeric_limits<double>::min());
  }

 private:
  /// Of the points whose squared distance is less than this; -1 if there are none.
  int searched(const Vec<dim>& x, double distance2) const {
    FirstOfTheNearest result(distance2);
    tree_.findNeighbors(result, x.data(), nanoflann::SearchParams());
    return result.index();
  }

  /// The points in the form that nanoflann requires.
  struct Cloud {
    std::vector<Vec<dim>> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t point, std::size_t axis) const { return points[point][axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  /// The result of a search so far. The tree skips branches whose distance, up to rounding, exceeds
  /// worstDist(), and points that are not below it. The margin lets it visit all equally near points.
  class FirstOfTheNearest {
   public:
    explicit FirstOfTheNearest(double distance2) : distance2_(distance2) {}
    double worstDist() const {
      constexpr double margin = 1e-12;
      return (1 + margin) * distance2_ + std::numeric_limits<double>::min();
    }
    bool full() const { return index_ >= 0; }
    /// Returns true: the search continues.
    bool addPoint(double distance2, int index) {
      if (distance2 < distance2_ || (distance2 == distance2_ && index < index_)) {
        distance2_ = distance2;
        index_ = index;
      }
      return true;
    }
    int index() const { return index_; }

   private:
    double distance2_;
    int index_ = -1;
  };

  using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud>;

  Cloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, dim> tree_;
};

}  // namespace wheelwright
