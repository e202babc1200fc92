#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/evolution/made_shapes.h"
#include "wheelwright/shape/geometry/mould.h"

namespace wheelwright {

/// The shapes of one lattice that come out of a mould, by a condition on the coefficients of their splines:
/// away from the parting plane, every coefficient is above the one before it by at least the mould's slope
/// times their distance. A spline is a mean of its coefficients and rises as steeply, except beside a parting
/// plane from which both sides rise: there a rise by 5/3 of that, and by at least a quarter of the rise on
/// the other side plus 5/4 of it, makes the values at the vertices rise enough. A level set of degree 2
/// interpolates the spline and could fall between the nodes: its control points between the vertices
/// (shape/geometry/control_points.h) are limited to values that rise, so that the level set rises that
/// steeply along every line parallel to the axle. The vertices keep their values, and with them the
/// coefficients.
template <int dim>
class MouldedShapes : public MadeShapes<dim> {
 public:
  /// `ceiling`: coefficients that rise in this way and that no shape exceeds, e.g. of protected bands.
  MouldedShapes(const Lattice<dim>& lattice, const Mould& mould, std::span<const double> ceiling);

  LevelSet<dim> keep_coefficients(LevelSet<dim> coefficients) const override;

  /// The vertices of a level set whose coefficients are allowed are not changed.
  LevelSet<dim> keep(LevelSet<dim> psi) const override;

  bool follow(const LevelSet<dim>& coefficients, const LevelSet<dim>& moved,
              Following& following) const override;

 private:
  using Place = std::array<int, dim>;
  struct Bound {
    double value;
    std::vector<Dependence> of;  ///< other values
  };

  /// Says by which coefficients another one is limited: by those of the layer before it, or by that on the
  /// other side of the first layer.
  enum class Limit { before, other_side };

  Bound bound(std::span<const double> values, const Place& place, Limit limit) const;
  bool is_beside_start(int layer) const;
  Bound bound_in_column(std::span<const double> points, const Place& place, int to) const;
  template <class Visit>
  void for_each_vertex_outwards(Visit visit) const;
  template <class Visit>
  void for_each_middle(Visit visit) const;
  std::vector<double> limited_vertices(std::vector<double> values) const;
  std::vector<double> limited_points(std::vector<double> points) const;
  int outwards(int layer) const { return layer > start_ ? 1 : -1; }
  bool is_vertex_of_column(const Place& place) const;

  Lattice<dim> lattice_;
  double slope_;
  int start_;       ///< the layer of nodes from which all others are limited
  double spacing_;  ///< of layers of nodes [m]
  double unchanged_;
  std::vector<double> ceiling_, ceiling_of_points_;
};

}  // namespace wheelwright
