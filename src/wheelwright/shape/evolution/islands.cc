#include "wheelwright/shape/evolution/islands.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/geometry/finite.h"
#include "wheelwright/shape/geometry/nearest_point.h"
#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {
namespace {

template <int dim>
bool is_island(const Component<dim>& component) {
  return component.is_material && !component.at_rim;
}

/// The reason why an island cannot be removed, if there is one.
template <int dim>
std::optional<Failure> check(const Component<dim>& island, double largest) {
  if (island.at_tread)
    return Failure{
        FailureReason::tread_cut_off,
        fmt::format(
            "holes join all around and cut the tread off from the rim; the piece at the tread begins at {}",
            place_text<dim>(island.innermost))};
  if (island.measure > largest)
    return Failure{FailureReason::disconnected_material,
                   fmt::format("an island of {} is not attached to the rim: {}; islands up to {} are removed",
                               measure_text<dim>(island.measure), place_text<dim>(island.centre),
                               measure_text<dim>(largest))};
  return {};
}

/// Distance to the samples of all islands and of their images in the neighbouring sectors.
template <int dim>
class DistanceToIslands {
 public:
  explicit DistanceToIslands(const Components<dim>& pieces) : samples_(images(pieces)) {}

  double operator()(const Vec<dim>& polar) const {
    const Vec<dim> x = cartesian<dim>(polar);
    return norm(x - samples_.points()[samples_.index_of_nearest(x)]);
  }

 private:
  static std::vector<Vec<dim>> images(const Components<dim>& pieces) {
    std::vector<Vec<dim>> points;
    for (int sample = 0; sample < pieces.samples.n_nodes(); ++sample) {
      if (!is_island(pieces.all[pieces.of_sample[sample]])) continue;
      for (int sector = -1; sector <= 1; ++sector) {
        Vec<dim> polar = pieces.samples.polar_point(sample);
        polar[1] += sector * pieces.samples.grid().sector_angle();
        points.push_back(cartesian<dim>(polar));
      }
    }
    return points;
  }

  NearestPoint<dim> samples_;
};

/// The shape without its islands.
template <int dim>
LevelSet<dim> emptied(const LevelSet<dim>& psi, const Components<dim>& pieces) {
  const Lattice<dim>& lattice = psi.lattice;
  LevelSet<dim> without = psi;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    auto p = lattice.node_position(node);
    for (int& x : p) x *= component_samples / lattice.degree();
    if (is_island(pieces.all[pieces.of_sample[pieces.samples.node_index(p)]]))
      without.values[node] = std::abs(psi.values[node]);
  }
  const DistanceToIslands<dim> to_islands(pieces);
  const LevelSet<dim> to_boundary = redistance(without);
  for (int node = 0; node < lattice.n_nodes(); ++node)
    if (without.values[node] >= 0 && to_islands(lattice.polar_point(node)) < to_boundary.values[node])
      without.values[node] = to_boundary.values[node];
  return without;
}

}  // namespace

template <int dim>
Expected<AttachedShape<dim>> without_islands(const LevelSet<dim>& psi, double largest) {
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  const Components<dim> pieces = components(psi);
  std::vector<ShapeEvent<dim>> removed;
  for (const auto& piece : pieces.all) {
    if (!is_island(piece)) continue;
    if (auto failure = check(piece, largest)) return *failure;
    removed.push_back({ShapeEventKind::island_removed, piece.centre, piece.measure});
  }
  if (removed.empty()) return AttachedShape<dim>{psi, {}};
  return AttachedShape<dim>{emptied(psi, pieces), std::move(removed)};
}

template decltype(without_islands<2>) without_islands<2>;
template decltype(without_islands<3>) without_islands<3>;

}  // namespace wheelwright
