#pragma once

#include <optional>

#include "wheelwright/mechanics/elasticity/contact_form.h"
#include "wheelwright/mechanics/elasticity/dilatation.h"
#include "wheelwright/mechanics/elasticity/ghost_penalty.h"
#include "wheelwright/mechanics/elasticity/materials.h"
#include "wheelwright/mechanics/elasticity/side_faces.h"
#include "wheelwright/mechanics/state/contact_law.h"
#include "wheelwright/mechanics/state/cooling.h"
#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/mechanics/state/rim.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The outermost rows of cells, which no shape cuts, and their grid: it is halved `levels` times towards the
/// tread. The lower half of the rows is halved once, the next quarter twice and so on; the last part is
/// halved `levels` times. Nodes that hang on coarser cells are constrained to them.
struct TreadGrid {
  int rows = 1;    ///< radial cells of the level set's grid
  int levels = 0;  ///< L
  int annulus_points =
      0;  ///< Gauss points per direction in every cell at which sigma(u)n is observed; 0: none
  bool observes_spin = false;  ///< whether ObservationRows::spin() is observed: for rotating wheels
};

/// The loads of (1) on the structure itself.
template <int dim>
struct DistributedLoads {
  Vec<dim> body_force{};     ///< f in the ground frame: component 0 towards the ground, 1 along it [N/m^3]
  double hole_pressure = 0;  ///< p, g_N = -p n on the moving boundary [Pa]
  /// omega of the wheel about its axle [rad/s]: every material point is pulled away from the axle by density
  /// omega^2 x per volume, x its place in the undeformed wheel, without the component along the axle.
  double angular_speed = 0;

  bool any() const { return norm<dim>(body_force) > 0 || hole_pressure != 0 || angular_speed != 0; }

  /// f at a place relative to the axle, in the ground frame, in a material of that density.
  Vec<dim> force_at(const Vec<dim>& position, double density) const {
    Vec<dim> force = body_force;
    for (int d = 0; d < 2; ++d) force[d] += density * angular_speed * angular_speed * position[d];
    return force;
  }
};

/// What loads a wheel, and the ground that carries it. Forces are per metre of width when dim = 2.
template <int dim>
struct WheelLoads {
  double load = 0;              ///< P [N/m when dim = 2, N when dim = 3]
  double horizontal_force = 0;  ///< H on the rim, towards larger azimuth; if not 0, it moves along the ground
  double lateral_force =
      0;              ///< on the rim along the axle, towards larger z; if not 0, it moves; when dim = 3 [N]
  double torque = 0;  ///< M on the rim about the axle; if not 0, it turns
  /// Of the rim towards the ground from where the undeformed wheel touches it [m], instead of the load.
  std::optional<double> travel = {};
  DistributedLoads<dim> distributed = {};
  Ground ground = {};
};

/// A rolling structure and its loads: all but its shape.
template <int dim>
struct RollingModel : WheelLoads<dim> {
  PolarGrid<dim> grid;
  int degree = 2;  ///< of the displacement, 1 or 2
  DilatationKind dilatation = DilatationKind::automatic;
  std::optional<int> cut_points;  ///< Gauss points per direction in cut cells; absent: degree + 2
  Materials<dim> materials;
  GhostPenalty ghost;
  SideFaces side_faces = SideFaces::free;  ///< when dim = 3
  ContactForm contact;
  /// In place of the law of `contact`, whose friction then does not count; null: that law.
  std::shared_ptr<const ContactLaw<dim>> contact_law = {};
  int contact_points = 5;  ///< Gauss points on each contact face, along the axle at most degree + 1
  TreadGrid tread;         ///< rows that are condensed once per run, and their refinement
  double camber =
      0;  ///< by which the wheel leans, its side at larger z closer to the ground; when dim = 3 [rad]
  int n_positions = 8;  ///< N_d, load positions of one sector
  /// The fixed lines of the grid (PolarGrid::fixed_lines) with respect to whose radii functions are
  /// differentiated, counted from the rim: edges of layers. A line stretches the rows up to the next fixed
  /// lines, none of which may be condensed at the tread.
  std::vector<int> design_lines = {};
  std::optional<Cooling> cooling = {};  ///< absent: nobody asks how warm the wheel gets

  const WheelLoads<dim>& loads() const { return *this; }
  WheelLoads<dim>& loads() { return *this; }

  int points_in_cut_cells() const { return cut_points.value_or(degree + 2); }
};

/// The motion prescribed to a model's rim.
template <int dim>
RimControl rim_control(const RollingModel<dim>& model);

/// Whether a model's loads and ground are their own mirror image in the plane of a load position.
template <int dim>
bool is_mirror_symmetric(const RollingModel<dim>& model);

/// Whether they are in the middle plane of the wheel's width; true when dim = 2.
template <int dim>
bool is_axially_symmetric(const RollingModel<dim>& model);

}  // namespace wheelwright
