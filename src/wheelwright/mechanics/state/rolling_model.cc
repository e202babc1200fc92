#include "wheelwright/mechanics/state/rolling_model.h"

namespace wheelwright {

template <int dim>
RimControl rim_control(const RollingModel<dim>& model) {
  RimControl rim;
  if (model.travel)
    rim.prescribed.towards_ground = *model.travel;
  else
    rim.free.push_back({{.towards_ground = 1}, model.load});
  if (model.horizontal_force != 0) rim.free.push_back({{.along_ground = 1}, model.horizontal_force});
  if (model.lateral_force != 0) rim.free.push_back({{.along_axle = 1}, model.lateral_force});
  if (model.torque != 0) rim.free.push_back({{.rotation = 1}, model.torque});
  return rim;
}

template <int dim>
bool is_mirror_symmetric(const RollingModel<dim>& model) {
  return model.horizontal_force == 0 && model.torque == 0 && model.distributed.body_force[1] == 0 &&
         model.ground.is_symmetric();
}

template <int dim>
bool is_axially_symmetric(const RollingModel<dim>& model) {
  return dim == 2 ||
         (model.lateral_force == 0 && model.camber == 0 && model.distributed.body_force[dim - 1] == 0);
}

template decltype(is_axially_symmetric<2>) is_axially_symmetric<2>;
template decltype(is_axially_symmetric<3>) is_axially_symmetric<3>;
template RimControl rim_control(const RollingModel<2>&);
template RimControl rim_control(const RollingModel<3>&);
template bool is_mirror_symmetric(const RollingModel<2>&);
template bool is_mirror_symmetric(const RollingModel<3>&);

}  // namespace wheelwright
