#pragma once

#include <vector>

#include "wheelwright/mechanics/state/ring_field.h"

namespace wheelwright {

/// The scalar at every point, of components [component][point].
std::vector<float> scalars(const std::vector<std::vector<float>>& components, const PointScalar& scalar);

/// Points of sector 0 at which fields are evaluated in all sectors.
template <int dim>
class FieldPoints {
 public:
  /// `lattice` carries the fields.
  explicit FieldPoints(const Lattice<dim>& lattice) : lattice_(lattice) {}

  /// Adds the point xi of a cell of sector 0.
  void add(const std::array<int, dim>& cell, const Vec<dim>& xi);

  std::size_t size() const { return points_.size(); }

  /// The components of a field at the points: [component][point + size() * sector].
  std::vector<std::vector<float>> components(const RingField& field) const;

  /// The components, or the field's scalar if it has one.
  std::vector<std::vector<float>> values(const NamedField& field) const;

 private:
  struct Point {
    int cell;                                                      ///< index of cells_
    std::array<double, ShapeFunctions<dim>::max_nodes> functions;  ///< values of the shape functions
  };

  template <int n_components>
  std::vector<std::vector<float>> components(const RingField& field) const;

  Lattice<dim> lattice_;
  std::array<int, dim> last_cell_{};
  std::vector<RingCellNodes<dim>> cells_;  ///< of consecutive points
  std::vector<int> rows_;                  ///< of these cells
  std::vector<Point> points_;
};

}  // namespace wheelwright
