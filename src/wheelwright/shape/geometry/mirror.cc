#include "wheelwright/shape/geometry/mirror.h"

#include <cmath>

namespace wheelwright {
namespace {

template <int dim>
int image_of_node(const Lattice<dim>& lattice, int node, MirrorPlane plane) {
  auto position = lattice.node_position(node);
  if (plane == MirrorPlane::azimuth)
    position[1] = -position[1];
  else if constexpr (dim == 3)
    position[2] = lattice.nodes()[2] - 1 - position[2];
  return lattice.node_index(position);
}

}  // namespace

template <int dim>
bool is_mirror_symmetric(const Lattice<dim>& lattice, std::span<const double> values, double tolerance,
                         MirrorPlane plane) {
  for (int i = 0; i < lattice.n_nodes(); ++i)
    if (!(std::abs(values[image_of_node(lattice, i, plane)] - values[i]) <= tolerance)) return false;
  return true;
}

template <int dim>
bool is_mirror_symmetric(const LevelSet<dim>& psi, MirrorPlane plane) {
  return is_mirror_symmetric<dim>(psi.lattice, psi.values, 1e-9 * psi.lattice.grid().resolution(), plane);
}

template <int dim>
std::vector<MirrorPlane> symmetries(const LevelSet<dim>& psi) {
  std::vector<MirrorPlane> result;
  for (const MirrorPlane plane : {MirrorPlane::azimuth, MirrorPlane::width})
    if (is_mirror_symmetric(psi, plane)) result.push_back(plane);
  return result;
}

template <int dim>
LevelSet<dim> mirror_symmetric_part(const LevelSet<dim>& psi, MirrorPlane plane) {
  LevelSet<dim> part = psi;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    part.values[i] = (psi.values[i] + psi.values[image_of_node(psi.lattice, i, plane)]) / 2;
  return part;
}

template <int dim>
LevelSet<dim> with_symmetries_of(const LevelSet<dim>& other, LevelSet<dim> psi) {
  for (const MirrorPlane plane : symmetries(other)) psi = mirror_symmetric_part(psi, plane);
  return psi;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                    \
  template bool is_mirror_symmetric(const Lattice<dim>&, std::span<const double>, double, MirrorPlane); \
  template bool is_mirror_symmetric(const LevelSet<dim>&, MirrorPlane);                                 \
  template std::vector<MirrorPlane> symmetries(const LevelSet<dim>&);                                   \
  template LevelSet<dim> mirror_symmetric_part(const LevelSet<dim>&, MirrorPlane);                      \
  template LevelSet<dim> with_symmetries_of(const LevelSet<dim>&, LevelSet<dim>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
