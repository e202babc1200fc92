#include "wheelwright/quantities/functionals/rim_quantities.h"

namespace wheelwright {
namespace {

RimMotion unit_motion(RimWay way) {
  RimMotion motion;
  (way == RimWay::towards_ground ? motion.towards_ground
   : way == RimWay::along_ground ? motion.along_ground
                                 : motion.rotation) = 1;
  return motion;
}

RimForce unit_force(RimWay way) {
  RimForce force;
  (way == RimWay::towards_ground ? force.towards_ground
   : way == RimWay::along_ground ? force.along_ground
                                 : force.torque) = 1;
  return force;
}

}  // namespace

template <int dim>
std::string RimTravel<dim>::name() const {
  return way_ == RimWay::towards_ground ? "travel"
         : way_ == RimWay::along_ground ? "travel_along_ground"
                                        : "wind_up";
}

template <int dim>
FunctionalValue<dim> RimTravel<dim>::evaluate(const StateSolver<dim>&, const LevelSet<dim>&,
                                              const State<dim>& state, const Matrix&) const {
  FunctionalValue<dim> value;
  for (const ContactPatch<dim>& contact : state.contacts()) {
    value.by_position.push_back(work(unit_force(way_), contact.rim));
    value.derivative.rim.push_back(unit_force(way_));
  }
  return value;
}

template <int dim>
FunctionalValue<dim> Travel<dim>::evaluate(const StateSolver<dim>&, const LevelSet<dim>&,
                                           const State<dim>& state, const Matrix&) const {
  FunctionalValue<dim> value;
  for (const ContactPatch<dim>& contact : state.contacts()) {
    value.by_position.push_back(contact.travel());
    value.derivative.rim.push_back(unit_force(RimWay::towards_ground));
    value.derivative.growth.push_back(1);
  }
  return value;
}

template <int dim>
std::string GroundForce<dim>::name() const {
  return way_ == RimWay::towards_ground ? "radial_force"
         : way_ == RimWay::along_ground ? "tangential_force"
                                        : "torque";
}

template <int dim>
FunctionalValue<dim> GroundForce<dim>::evaluate(const StateSolver<dim>&, const LevelSet<dim>&,
                                                const State<dim>& state, const Matrix&) const {
  FunctionalValue<dim> value;
  for (const ContactPatch<dim>& contact : state.contacts()) {
    double force = 0;
    std::vector<Vec<dim>> by_traction;
    for (const auto& point : contact.points) {
      Vec<dim> slope =
          point.frame.template ground_to_contact<dim>(displacement<dim>(unit_motion(way_), point.position));
      for (double& x : slope) x *= -point.weight;
      force += dot<dim>(slope, point.traction);
      by_traction.push_back(slope);
    }
    value.by_position.push_back(force);
    value.derivative.tractions.push_back(std::move(by_traction));
  }
  return value;
}

template class RimTravel<2>;
template class RimTravel<3>;
template class Travel<2>;
template class Travel<3>;
template class GroundForce<2>;
template class GroundForce<3>;

}  // namespace wheelwright
