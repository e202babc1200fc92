#pragma once

#include "wheelwright/shape/geometry/nearest_point.h"

namespace wheelwright {

/// The radius of the largest ball that touches an edge at p, with its centre in the direction of the unit
/// normal n, and contains none of the points, which lie on edges. The ball starts with the given radius. Each
/// of at most `max_steps` steps shrinks it until it touches the point that was nearest to its centre, and
/// calls touch(index of the point, new radius). A point counts as outside if its distance from the centre is
/// at least (1 - slack) radii.
template <int dim, class Touch>
double shrunk_radius(const NearestPoint<dim>& points, const Vec<dim>& p, const Vec<dim>& n, double radius,
                     double slack, int max_steps, Touch touch) {
  for (int step = 0; step < max_steps; ++step) {
    const Vec<dim> centre = p + radius * n;
    const int nearest = points.index_of_nearest_within(radius, centre);
    if (nearest < 0) break;
    const Vec<dim>& other = points.points()[nearest];
    const Vec<dim> apart = other - p;
    if (norm(other - centre) >= radius * (1 - slack)) break;
    const double smaller = dot(apart, apart) / (2 * dot(apart, n));
    if (!(smaller > 0 && smaller < radius)) break;
    radius = smaller;
    touch(nearest, radius);
  }
  return radius;
}

}  // namespace wheelwright
