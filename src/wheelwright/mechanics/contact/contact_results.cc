#include "wheelwright/mechanics/contact/contact_results.h"

#include <algorithm>
#include <limits>

#include "wheelwright/base/periodic.h"

namespace wheelwright {

template <int dim>
Matrix contact_loads(const ReducedContact<dim>& contact, const ContactState<dim>& state) {
  const ContactPoints<dim>& at = contact.tread().at;
  const ObservationRows<dim> rows = at.observation_rows();
  Matrix loads(rows.n_contact(), at.zone.n_columns);
  for (int i = 0; i < contact.n_points(); ++i) {
    const ZonePoint<dim>& point = contact.points()[i];
    const Vec<dim> traction = point.frame.template contact_to_body<dim>(state.traction[i]);
    double* load = loads.column(at.column(i));
    const int q = at.point_of_column(i);
    for (int d = 0; d < dim; ++d) {
      load[rows.displacement(q) + d] = point.weight * traction[d];
      load[rows.traction(q) + d] = -contact.tread().theta / point.gamma * point.weight * traction[d];
    }
  }
  return loads;
}

template <int dim>
ContactPatch<dim> contact_patch(const ReducedContact<dim>& contact, const ContactState<dim>& state) {
  const ContactPoints<dim>& at = contact.tread().at;
  ContactPatch<dim> patch{.points = {},
                          .rim = state.rim,
                          .rim_force = state.rim_force,
                          .newton_iterations = state.newton_iterations,
                          .growth = contact.growth()};
  for (int i = 0; i < contact.n_points(); ++i)
    patch.points.push_back({.column = wrap(at.zone.first_column + at.column(i), at.ring_columns),
                            .point = at.point_of_column(i),
                            .frame = contact.points()[i].frame,
                            .position = contact.points()[i].position,
                            .gap = contact.points()[i].gap,
                            .weight = contact.points()[i].weight,
                            .augmented = state.augmented[i],
                            .traction = state.traction[i]});
  return patch;
}

template <int dim>
double smallest_gap(const ReducedContact<dim>& contact, const ContactState<dim>& state) {
  double gap = std::numeric_limits<double>::infinity();
  for (int i = 0; i < contact.n_points(); ++i)
    gap = std::min(gap, state.augmented[i][0] / contact.points()[i].gamma);
  return gap;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                              \
  template Matrix contact_loads(const ReducedContact<dim>&, const ContactState<dim>&);            \
  template ContactPatch<dim> contact_patch(const ReducedContact<dim>&, const ContactState<dim>&); \
  template double smallest_gap(const ReducedContact<dim>&, const ContactState<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
