#pragma once

#include <vector>

#include "evolution/cubic_interpolant.h"

namespace wheelwright {

/// Points on {psi = 0} of one sector, about a third of the node spacing apart: one on every lattice edge
/// whose ends differ in sign, and projections of sample points from the elements that have both signs. In
/// units of the lattice's node spacing.
template <int dim>
std::vector<Vec<dim>> zero_seeds(const CubicInterpolant<dim>& psi);

/// Finds the nearest of a set of points of one sector and their images in the others. Points are binned by
/// lattice element.
template <int dim>
class SeedIndex {
 public:
  /// At least one seed; points in units of the lattice's node spacing.
  SeedIndex(const Lattice<dim>& lattice, const std::vector<Vec<dim>>& seeds);

  /// The seed nearest to a node of the sector, as the image that lies next to the node.
  Vec<dim> nearest(const std::array<int, dim>& node) const;

 private:
  struct Seed {
    Vec<dim> point, position;  ///< in lattice units; Cartesian
  };
  struct Candidate {
    double distance2;
    Vec<dim> point;
  };
  void search_element(const std::array<int, dim>& element, const Vec<dim>& node_polar, Candidate& best) const;
  void search_shell(int shell, const std::array<int, dim>& node, Candidate& best) const;
  double distance_outside(int shell) const;

  Lattice<dim> lattice_;
  std::vector<Seed> seeds_;     ///< sorted by element
  std::vector<int> bin_start_;  ///< first seed of each element, and their number at the end
};

}  // namespace wheelwright
