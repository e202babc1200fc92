#include "wheelwright/shape/geometry/invariance.h"

#include <cmath>

namespace wheelwright {
namespace {

/// The nodes that a motion maps to each other, one line after the other, and the share of each in its line.
template <int dim>
class Lines {
 public:
  Lines(const Lattice<dim>& lattice, Invariance invariance)
      : lattice_(lattice), axis_(invariance == Invariance::about_axle ? 1 : 2) {}

  /// Calls visit(node, share) for the nodes of the line through each node that is the first of one.
  template <class Sum, class Set>
  void for_each(const Sum& sum, const Set& set) const {
    if (axis_ >= dim) {  // along the axle of a plane wheel
      for (int node = 0; node < lattice_.n_nodes(); ++node) set(node, 1.0, sum(node, 1.0));
      return;
    }
    for (int node = 0; node < lattice_.n_nodes(); ++node) {
      auto place = lattice_.node_position(node);
      if (place[axis_] != 0) continue;
      double total = 0;
      for (int k = 0; k < count(); ++k) total += sum(on_line(place, k), share(k));
      for (int k = 0; k < count(); ++k) set(on_line(place, k), share(k), total);
    }
  }

 private:
  int count() const { return lattice_.nodes()[axis_]; }
  double share(int k) const {
    if (axis_ == 1) return 1.0 / count();
    const bool is_end = k == 0 || k == count() - 1;
    return (is_end ? 0.5 : 1.0) / (count() - 1);
  }
  int on_line(std::array<int, dim> place, int k) const {
    place[axis_] = k;
    return lattice_.node_index(place);
  }

  const Lattice<dim>& lattice_;
  int axis_;
};

}  // namespace

template <int dim>
std::vector<double> invariant_part(const Lattice<dim>& lattice, std::span<const double> values,
                                   Invariance invariance) {
  std::vector<double> result(values.begin(), values.end());
  if (invariance == Invariance::none) return result;
  Lines<dim>(lattice, invariance)
      .for_each([&](int node, double share) { return share * values[node]; },
                [&](int node, double, double mean) { result[node] = mean; });
  return result;
}

template <int dim>
bool is_invariant(const LevelSet<dim>& psi, Invariance invariance) {
  const auto mean = invariant_part<dim>(psi.lattice, psi.values, invariance);
  const double rounding = 1e-9 * psi.lattice.grid().resolution();
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (!(std::abs(psi.values[i] - mean[i]) <= rounding)) return false;
  return true;
}

template <int dim>
std::vector<double> invariant_load(const Lattice<dim>& lattice, std::span<const double> load,
                                   Invariance invariance) {
  std::vector<double> result(load.begin(), load.end());
  if (invariance == Invariance::none) return result;
  Lines<dim>(lattice, invariance)
      .for_each([&](int node, double) { return load[node]; },
                [&](int node, double share, double sum) { result[node] = share * sum; });
  return result;
}

template std::vector<double> invariant_part(const Lattice<2>&, std::span<const double>, Invariance);
template std::vector<double> invariant_part(const Lattice<3>&, std::span<const double>, Invariance);
template bool is_invariant(const LevelSet<2>&, Invariance);
template bool is_invariant(const LevelSet<3>&, Invariance);
template std::vector<double> invariant_load(const Lattice<2>&, std::span<const double>, Invariance);
template std::vector<double> invariant_load(const Lattice<3>&, std::span<const double>, Invariance);

}  // namespace wheelwright
