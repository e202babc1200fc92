#pragma once

#include <functional>
#include <optional>

#include "wheelwright/mechanics/state/load_case.h"
#include "wheelwright/mechanics/state/ring_field.h"
#include "wheelwright/output/report/layer_circles.h"
#include "wheelwright/output/report/pressure_csv.h"
#include "wheelwright/quantities/analysis/all_positions.h"

namespace wheelwright {

/// The largest value of a scalar, such as the von Mises stress, at the quadrature points, and where it is
/// (Cartesian, body frame).
template <int dim>
struct DrawnPeak {
  Vec<dim> place;  ///< [m]
  double value;    ///< in its SI unit
};

/// Components of a stress as it is written: xx, yy, zz, xy, and in 3D yz and xz, with z along the axle; body
/// frame. They are those of ParaView's symmetric tensors.
template <int dim>
inline constexpr int stress_components = dim == 2 ? 4 : 6;

/// The fields of one load position.
template <int dim>
struct PositionFields {
  Lattice<dim> lattice;  ///< of the fields
  RingField displacement;
  RingField stress;       ///< stress_components
  double ground_azimuth;  ///< of n_y, body frame [rad]
  bool is_bonded;         ///< the tread to a rigid ring, instead of touching the ground
  bool is_large;          ///< large deformation, which pictures do not magnify
  Ground ground;          ///< its own mirror image if positions stand for their images
  double camber;          ///< of the wheel on it; 0 when dim = 2 [rad]
  RimMotion rim;          ///< ground frame
  double travel;          ///< of the rim from where the rotating wheel without load touches the ground [m]
  RimForce rim_force;     ///< on the rim, per metre of width when dim = 2
  std::vector<ContactPoint> contact;
  DrawnPeak<dim> von_mises;
  LayerCircles layers = {};
  std::optional<NamedField> fatigue = {};     ///< fatigue_field(), if it was asked for
  std::optional<RingField> temperature = {};  ///< temperature_picture(), if it was asked for
};

template <int dim>
PositionFields<dim> position_fields(const StateSolver<dim>& solver, const State<dim>& state, int position);

/// The fields of the most_stressed_position(), with fatigue and temperature of the turn, for pictures and
/// files of one position; with load cases, of which the state is the first one's, the fatigue_field() of all.
template <int dim>
PositionFields<dim> most_stressed_fields(const StateSolver<dim>& solver, const State<dim>& state,
                                         const LoadCases<dim>& cases = {});

/// Calls visit(position, fields) for every load position of a sector, one after the other; images are
/// reflected.
template <int dim>
void for_each_position(const StateSolver<dim>& solver, const State<dim>& state,
                       const std::function<void(int, PositionFields<dim>)>& visit);

/// Displacement, stress and von Mises stress, by the names that they have in files.
template <int dim>
std::vector<NamedField> named_fields(const PositionFields<dim>& fields);

/// The von Mises stress of one stress as in PositionFields.
double von_mises_of(std::span<const double> stress);

/// The von Mises stress of stresses as in PositionFields. The stress is interpolated, so that it is never
/// negative.
NamedField von_mises_field(const RingField& stress);

/// The lattice that carries these fields.
template <int dim>
Lattice<dim> displacement_lattice(const RollingModel<dim>& model);

/// Of every row of cells, whether it belongs to a layer of odd number, counted from 0 at the rim: stresses
/// jump between layers (RingField). Empty if there is only one layer.
template <int dim>
std::vector<bool> rows_of_odd_layers(const RollingModel<dim>& model);

/// The layer of materials of every row of cells, counted from 0 at the rim. Empty if there is only one layer.
template <int dim>
std::vector<int> layers_of_rows(const RollingModel<dim>& model);

/// Component of a displacement towards the ground of one load position [m].
template <int dim>
RingField vertical_field(const RingField& displacement, double ground_azimuth);

/// The stress [Pa] of a displacement at the nodes, components as in PositionFields: the mean over the cells
/// with material around a node, of one layer.
template <int dim>
RingField stress_field(const RollingModel<dim>& model, const CutDomain<dim>& domain,
                       const RingField& displacement);

/// One value per node of a sector's level set lattice, as a field on the displacement's lattice, equal in all
/// sectors.
template <int dim>
RingField repeated_field(const RollingModel<dim>& model, const LevelSet<dim>& sector_values);

/// The contact zones of all load positions of a sector, those of images reflected; in each position the
/// points follow each other along the ground by columns.
template <int dim>
std::vector<ContactPoint> contact_points(const StateSolver<dim>& solver, const State<dim>& solution);

/// The points for a curve along the ground: the cells at the tread (cell_means()), in 3D those of the line
/// nearest to the middle of the width.
template <int dim>
std::vector<ContactPoint> curve_points(std::vector<ContactPoint> points);

}  // namespace wheelwright
