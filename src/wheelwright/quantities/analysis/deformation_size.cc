#include "wheelwright/quantities/analysis/deformation_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "wheelwright/mechanics/state/material_edges.h"

namespace wheelwright {
namespace {

template <int dim>
Lattice<dim> displacement_lattice(const StateSolver<dim>& solver) {
  return {solver.model().grid, solver.model().degree};
}

}  // namespace

template <int dim>
bool edges_overlap(const StateSolver<dim>& solver, const LevelSet<dim>& psi, const State<dim>& state) {
  const MaterialEdges<dim> edges(psi, displacement_lattice(solver));
  for (int position = 0; position < state.positions().size(); ++position)
    if (edges.overlap(state.displacement().at_nodes(position))) return true;
  return false;
}

template <int dim>
double travel_by_thickness(const StateSolver<dim>& solver, const State<dim>& state) {
  double largest = 0;
  for (const ContactPatch<dim>& contact : state.contacts())
    largest = std::max(largest, std::abs(contact.travel()));
  const PolarGrid<dim>& grid = solver.model().grid;
  return largest / (grid.outer_radius - grid.inner_radius);
}

template <int dim>
DeformationSize deformation_size(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                 const State<dim>& state, std::span<const PositionDeformation> positions) {
  DeformationSize size{.strain = std::ranges::max(state.strain_peaks().principal),
                       .rotation = 0,
                       .travel = travel_by_thickness(solver, state),
                       .error = {},
                       .edges_overlap = edges_overlap(solver, psi, state),
                       .of_linear_theory = solver.model().materials.are_linear()};
  for (const PositionDeformation& position : positions) {
    size.rotation = std::max(size.rotation, position.largest_rotation);
    if (position.neglected.size() > size.error.size()) size.error = position.neglected;
  }
  return size;
}

template <int dim>
DeformationSize deformation_size(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                 const State<dim>& state) {
  return deformation_size<dim>(solver, psi, state, position_deformations(solver, state));
}

template <int dim>
std::optional<Failure> material_overlaps(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                         const State<dim>& state) {
  const double travel = travel_by_thickness(solver, state);
  if (travel < smallest_travel_of_overlap) return {};
  const MaterialEdges<dim> edges(psi, displacement_lattice(solver));
  for (int position = 0; position < state.positions().size(); ++position)
    if (const auto place = edges.first_crossing(state.displacement().at_nodes(position)))
      return overlap_failure(travel, *place);
  return {};
}

double share_of_small_load(const DeformationSize& size) {
  return std::min(
      {small_strain / size.strain, small_travel / size.travel, share_within(size.error, small_error)});
}

std::string deformation_warning(const DeformationSize& size) {
  if (!size.of_linear_theory) {
    if (size.edges_overlap) return "edges of holes cross each other: their contact is not computed";
    if (size.strain <= moderate_strain) return "";
    return fmt::format(
        "strains reach {:.3g} %: beyond about {:.0f} % real rubber departs from the stored energies of this "
        "program; compare the material's law with its tests",
        100 * size.strain, 100 * moderate_strain);
  }
  if (size.strain <= small_strain && size.travel <= small_travel && size.error.size() <= small_error &&
      !size.edges_overlap)
    return "";
  const double share = share_of_small_load(size);
  std::string remedy =
      share < 1
          ? fmt::format(
                "About {:.2g} % of the load would stay within that, or a material {:.2g} times as stiff.",
                100 * share, 1 / share)
          : "A smaller load or a stiffer material helps.";
  remedy += " In 2D, material.model = \"neo_hookean\" computes large deformation.";
  return fmt::format(
      "large deformation: strains reach {:.3g} %, the material turns by up to {:.2g} deg, the rim travels "
      "{:.3g} % of the ring's thickness, and linear theory errs by about {:.2g} % in travel and stiffness{}. "
      "Linear elasticity holds up to about {:.0f} % of strain, {:.0f} % of travel and {:.0f} % of that "
      "error; "
      "beyond, travel, pressures and stresses of the real wheel are different. {}",
      100 * size.strain, size.rotation * 180 / std::numbers::pi, 100 * size.travel, 100 * size.error.size(),
      size.edges_overlap ? ", and edges of holes cross each other" : "", 100 * small_strain,
      100 * small_travel, 100 * small_error, remedy);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                            \
  template DeformationSize deformation_size<dim>(const StateSolver<dim>&, const LevelSet<dim>&, \
                                                 const State<dim>&);                            \
  template DeformationSize deformation_size<dim>(const StateSolver<dim>&, const LevelSet<dim>&, \
                                                 const State<dim>&, std::span<const PositionDeformation>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE
template decltype(travel_by_thickness<2>) travel_by_thickness<2>;
template decltype(edges_overlap<2>) edges_overlap<2>;
template decltype(material_overlaps<2>) material_overlaps<2>;
template decltype(travel_by_thickness<3>) travel_by_thickness<3>;
template decltype(edges_overlap<3>) edges_overlap<3>;
template decltype(material_overlaps<3>) material_overlaps<3>;

}  // namespace wheelwright
