#pragma once

#include <span>
#include <vector>

#include "wheelwright/optimization/optimizer/optimization_state.h"
#include "wheelwright/shape/evolution/deformation_space.h"

namespace wheelwright {

/// Deformations of a shape, followed by the changes of the radii of design lines [m]. The inner product is
/// that of the deformations (DeformationSpace) plus the products of the changes times the measure of a
/// sector: a line counts as if it moved all of it. A load has the derivatives with respect to the radii last.
template <int dim>
class DesignSpace {
 public:
  /// The deformations must outlive this.
  DesignSpace(const DeformationSpace<dim>& shapes, const PolarGrid<dim>& grid, std::size_t n_radii)
      : shapes_(&shapes), n_radii_(n_radii), measure_(sector_measure<dim>(grid)) {}

  std::size_t n_radii() const { return n_radii_; }

  /// The part of a vector that belongs to the shape, and that of the radii.
  std::span<const double> of_shape(std::span<const double> vector) const {
    return vector.first(vector.size() - n_radii_);
  }
  std::span<const double> of_radii(std::span<const double> vector) const { return vector.last(n_radii_); }

  /// The design t with (t, w) = load . w for all w.
  std::vector<double> representative(std::span<const double> load) const {
    return with_radii(shapes_->representative(of_shape(load)), of_radii(load), 1 / measure_);
  }

  /// The load l with l . w = (design, w) for all w.
  std::vector<double> load(std::span<const double> design) const {
    return with_radii(shapes_->load(of_shape(design)), of_radii(design), measure_);
  }

  /// The load of this size whose product with a design is the change of one radius.
  std::vector<double> unit_load(std::size_t size, std::size_t radius) const {
    std::vector<double> load(size, 0.0);
    load[size - n_radii_ + radius] = 1;
    return load;
  }

 private:
  static std::vector<double> with_radii(std::vector<double> vector, std::span<const double> radii,
                                        double factor) {
    for (const double radius : radii) vector.push_back(factor * radius);
    return vector;
  }

  const DeformationSpace<dim>* shapes_;
  std::size_t n_radii_;
  double measure_;  ///< of a sector, holes included
};

}  // namespace wheelwright
