#include "wheelwright/mechanics/equilibrium/elimination_order.h"

#include <algorithm>

#include "wheelwright/mechanics/ring/nested_dissection.h"

namespace wheelwright {
namespace {

/// The numbers from first to before last, every middle one after those on both of its sides.
void append_by_halves(int first, int last, std::vector<int>& order) {
  if (first >= last) return;
  const int middle = (first + last) / 2;
  append_by_halves(first, middle, order);
  append_by_halves(middle + 1, last, order);
  order.push_back(middle);
}

}  // namespace

template <int dim>
EliminationOrders<dim>::EliminationOrders(const RingForms<dim>& forms)
    : n_nodes_(forms.space().n_nodes()),
      per_sector_(forms.space().n_nodes_of_sector()),
      n_sectors_(forms.domain().grid.n_sectors) {
  const RingSpace<dim>& space = forms.space();
  // A sector with both of its faces, whose nodes inside are to be ordered.
  SectorStiffness<dim> sector{SectorSpace<dim>(forms.domain(), space.degree(), forms.domain().grid.cells[0],
                                               SideFaces::free, GhostPenalty{.xi = 0}),
                              {},
                              {}};
  std::vector<bool> divides(per_sector_, false);
  for (int node = 0; node < per_sector_; ++node) divides[node] = space.position_in_sector(node)[1] == 0;
  for (const auto& coupling : forms.couplings()) {
    if (coupling.into_next_sector) {  // then the plus cell's nodes are coupled with the sector before
      for (const int node : space.cell_nodes(coupling.plus, 0))
        if (node >= 0) divides[node % per_sector_] = true;
      continue;
    }
    auto nodes = sector.space.cell_nodes(coupling.minus);
    const auto plus = sector.space.cell_nodes(coupling.plus);
    nodes.insert(nodes.end(), plus.begin(), plus.end());
    sector.ghosts.push_back({std::move(nodes), coupling.stiffness});
  }
  std::vector<int> inside;
  for (int node = 0; node < sector.space.n_nodes(); ++node) {
    const auto& p = sector.space.position(node);
    if (p[1] > 0 && p[1] < sector.space.last_line() && !divides[space.number(p)]) inside.push_back(node);
  }
  for (const int node : nested_dissection(sector, std::move(inside)))
    inside_.push_back(space.number(sector.space.position(node)));
  for (int node = 0; node < per_sector_; ++node)
    if (divides[node]) face_.push_back(node);
}

template <int dim>
EliminationOrder EliminationOrders<dim>::with_trailing(std::span<const int> trailing) const {
  std::vector<bool> is_trailing(n_nodes_, false);
  for (const int node : trailing) is_trailing[node] = true;
  EliminationOrder order{{}, static_cast<int>(trailing.size())};
  const auto append = [&](const std::vector<int>& nodes, int sector) {
    for (const int node : nodes)
      if (const int of_ring = node + sector * per_sector_; !is_trailing[of_ring])
        order.nodes.push_back(of_ring);
  };
  for (int sector = 0; sector < n_sectors_; ++sector) append(inside_, sector);
  std::vector<int> faces;
  append_by_halves(1, n_sectors_, faces);
  faces.push_back(0);
  for (const int face : faces) append(face_, face);
  order.nodes.insert(order.nodes.end(), trailing.begin(), trailing.end());
  return order;
}

template class EliminationOrders<2>;
template class EliminationOrders<3>;

}  // namespace wheelwright
