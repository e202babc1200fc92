#include "wheelwright/mechanics/rolling/preload.h"

#include <algorithm>

#include "wheelwright/mechanics/ring/tread_ring.h"
#include "wheelwright/mechanics/rolling/rolled_contact.h"

namespace wheelwright {
namespace {

/// Distributed loads at some load positions, and what the tread observes of them without the ground.
template <int dim>
struct WithoutGround {
  AppliedLoads applied;
  CondensedLoads<dim> condensed;
  Matrix observed;
};

template <int dim>
WithoutGround<dim> without_ground(const DistributedLoads<dim>& loads, const ElementTable<dim>& elements,
                                  const Tread<dim>& tread, const FactoredShape<dim>& shape,
                                  std::span<const GroundPosition> grounds) {
  const CyclicStiffness<dim>& ring = shape.ring;
  AppliedLoads applied = applied_loads<dim>(loads, shape.domain, elements, ring, tread, grounds);
  SectorFields core = applied.core;
  auto boundary = ring.eliminate_interface(condense<dim>(ring, ring.sector_factor().full_sweep(), core));
  CondensedLoads<dim> condensed{std::move(core), std::move(boundary)};
  const TreadLoads on_tread = tread_loads(tread, applied.tread);
  const Matrix outer = ring.outer_displacements(sum(condensed.boundary.outer, base_loads(tread, on_tread)));
  Matrix observed = observations(tread, tread_field(tread, outer, on_tread), on_tread);
  return {std::move(applied), std::move(condensed), std::move(observed)};
}

/// Where a rotating wheel stands without load at every position; empty for a wheel that does not rotate.
template <int dim>
std::vector<StandingPoint<dim>> standing_points(const RollingModel<dim>& model,
                                                const ElementTable<dim>& elements, const Tread<dim>& tread,
                                                const FactoredShape<dim>& shape,
                                                const LoadPositions& positions) {
  std::vector<StandingPoint<dim>> result;
  if (model.distributed.angular_speed == 0 || has_linear_contact(model)) return result;
  const DistributedLoads<dim> rotation{.angular_speed = model.distributed.angular_speed};
  // What is observed does not depend on the position.
  const Matrix observed =
      without_ground<dim>(rotation, elements, tread, shape, std::span(positions.grounds).first(1)).observed;
  for (const GroundPosition& ground : positions.grounds)
    result.push_back(standing_point(tread, model.grid, ground, model.ground, observed));
  return result;
}

/// The mean over all positions.
template <int dim>
double mean_growth(const std::vector<StandingPoint<dim>>& standing, const LoadPositions& positions) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < standing.size(); ++i) {
    sum += positions.multiplicities[i] * standing[i].growth;
    count += positions.multiplicities[i];
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

template <int dim>
Preloaded<dim> preload(const RollingModel<dim>& model, const ElementTable<dim>& elements,
                       const Tread<dim>& tread, const FactoredShape<dim>& shape,
                       const LoadPositions& positions) {
  const int n_positions = positions.size(), n_columns = tread.n_columns();
  if (!model.distributed.any())
    return {{},
            Matrix(tread.n_observations(), n_positions * n_columns),
            {{}, {{}, Matrix(shape.ring.n_outer(), n_positions * shape.ring.n_sectors())}},
            std::vector<Preload>(n_positions),
            {}};
  WithoutGround<dim> free = without_ground<dim>(model.distributed, elements, tread, shape, positions.grounds);
  auto standing = standing_points(model, elements, tread, shape, positions);
  const double mean = mean_growth(standing, positions);
  std::vector<Preload> of_positions;
  for (int i = 0; i < n_positions; ++i) {
    Preload one{.observations = Matrix(free.observed.rows(), n_columns),
                .resultant = free.applied.on_the_rim[i],
                .growth = standing.empty() ? 0 : standing[i].growth,
                .mean_growth = mean};
    std::copy_n(free.observed.column(i * n_columns), one.observations.entries().size(),
                one.observations.data());
    of_positions.push_back(std::move(one));
  }
  return {std::move(free.applied.core), std::move(free.applied.tread), std::move(free.condensed),
          std::move(of_positions), std::move(standing)};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                     \
  template Preloaded<dim> preload(const RollingModel<dim>&, const ElementTable<dim>&, const Tread<dim>&, \
                                  const FactoredShape<dim>&, const LoadPositions&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
