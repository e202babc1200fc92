#include "wheelwright/quantities/analysis/ground_pass.h"

namespace wheelwright {

template <int dim>
std::vector<PassPlace> ground_pass(const State<dim>& state, std::span<const double> shifts) {
  const double radius = state.model().grid.outer_radius;
  const Ground& ground = state.model().ground;
  std::vector<PassPlace> pass;
  for (const double shift : shifts) {
    RollingModel<dim> model = state.model();
    model.ground = ground.shifted(shift);
    const double rise = model.ground.standing(radius).rise;
    if (model.travel) *model.travel += rise - ground.standing(radius).rise;
    const auto contacts = state.contacts_under(std::span(&model, 1), {}).front();
    if (!contacts) {
      pass.push_back({shift, rise, contacts.failure()});
      continue;
    }
    std::vector<ContactSummary> positions;
    for (const ContactPatch<dim>& contact : *contacts) positions.push_back(contact_summary(contact));
    pass.push_back({shift, rise, std::move(positions)});
  }
  return pass;
}

template decltype(ground_pass<2>) ground_pass<2>;
template decltype(ground_pass<3>) ground_pass<3>;

}  // namespace wheelwright
