#pragma once

#include <memory>
#include <optional>

#include "wheelwright/contact/contact_law.h"
#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/ring/surface_compliance.h"
#include "wheelwright/state/contact_patch.h"
#include "wheelwright/state/load_positions.h"
#include "wheelwright/state/rim.h"

namespace wheelwright {

/// Contact quadrature points near the ground position, in the order (column, point of the column).
struct ContactZone {
  int first_column;  ///< may be negative: columns are periodic
  int n_columns;
};

/// The contact-free response to distributed loads at one load position.
struct Preload {
  Matrix observations;  ///< of v on the tread, one column per ring column; empty: zero
  RimForce resultant;
  double growth = 0;       ///< of this position (ContactPatch) [m]
  double mean_growth = 0;  ///< of all positions [m]
};

/// The unknowns of one load position's contact problem; also used for their changes and the residual.
template <int dim>
struct ContactUnknowns {
  std::vector<Vec<dim>> augmented;  ///< z = tau sigma(u)n - gamma (u - g n_y), ground frame [Pa]
  std::vector<double> rim;          ///< coefficient of each free motion of the rim
};

/// The solution of one load position's contact problem, reduced to the zone.
template <int dim>
struct ContactState {
  ContactZone zone;
  std::vector<Vec<dim>> augmented;  ///< z
  std::vector<Vec<dim>> traction;   ///< Phi(z) on the body, ground frame: component 0 along n_y [Pa]
  RimMotion rim;
  RimForce rim_force;     ///< on the rim: its load, and the reaction in motions that are not free
  int newton_iterations;  ///< of all attempts
  double ground = 0;      ///< the ground position, in columns from the zone's first azimuth
};

/// The contribution of a function's adjoint problem (79) to the contact of one load position.
template <int dim>
struct ContactAdjointLoads {
  Matrix observations;                   ///< of p without the contact part, in the zone
  RimForce rim = {};                     ///< the function's derivative with respect to the rim's motion
  std::vector<Vec<dim>> tractions = {};  ///< and to the ground's tractions at points(); empty: zero
};

/// The contact part of the adjoint problem (79) at one load position.
struct ContactAdjoint {
  Matrix loads;          ///< -S^T m on the zone's observations, m the multiplier
  RimMotion rim;         ///< of the adjoint
  double by_travel = 0;  ///< the function's derivative with respect to a prescribed motion towards the ground
};

template <int dim>
class ReducedContact;

/// The derivative of the contact problem's residual at some unknowns, factored.
template <int dim>
class ContactTangent {
 public:
  /// Returns the change of the unknowns that changes the residual by `residual`.
  ContactUnknowns<dim> solve(const ContactUnknowns<dim>& residual) const;

  /// The same for several residuals at once.
  std::vector<ContactUnknowns<dim>> solve(std::vector<ContactUnknowns<dim>> residuals) const;

  /// The derivative of the contact law at every point.
  const std::vector<Mat<dim>>& tangents() const { return tangents_; }

  /// The number of unknowns that were factored.
  int n_unknowns() const { return static_cast<int>(active_.size()) + contact_->n_free(); }

 private:
  friend class ReducedContact<dim>;
  const ReducedContact<dim>* contact_;
  std::vector<Mat<dim>> tangents_;  ///< of the contact law at every point
  std::vector<int> active_;
  LuFactor factor_;
};

/// The contact problem (27) with the rigid rim (4.3) of one load position, condensed onto its contact zone:
///   z = z_0 + F W Phi(z) + gamma (g n_y - m),   sum w Phi(z).m_k + force_k = 0,
/// where W holds the weights, F is the flexibility of the zone, m the rim's motion, m_k its free motions, and
/// z_0 the value of tau sigma(v)n - gamma v due to other loads. Only the components that can carry traction
/// are kept: without friction only the normal one.
template <int dim>
class ReducedContact {
 public:
  /// `surface` must be as wide as the zone: columns up to zone.n_columns - 1 apart, or half of the ring; with
  /// friction or a lean the tread must trace all components.
  ReducedContact(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread, const PolarGrid<dim>& grid,
                 GroundPosition ground, ContactZone zone, RimControl rim, const Preload& preload = {});

  /// The same zone with another rim control.
  ReducedContact under(const RimControl& rim) const;

  /// The same problem with given friction (Tresca's law): one threshold per point [Pa].
  ReducedContact with_given_friction(std::vector<double> thresholds) const;

  /// The same problem with all contact points sliding, regardless of the rim's motion along the ground:
  /// friction acts on the wheel along `direction`, a unit vector along the ground.
  ReducedContact sliding_along(const Vec<dim>& direction) const;

  /// Whether the tread is bonded to a rigid ring: then the problem is linear, and the zone is the whole
  /// tread.
  bool is_bonded() const { return counterpart_ == Counterpart::ring; }

  /// The contact law at a point, and the point's status.
  ContactResponse<dim> response(int point, const Vec<dim>& z) const;
  ContactStatus status(int point, const Vec<dim>& z) const;

  const ContactZone& zone() const { return zone_; }
  const RimControl& rim() const { return rim_; }
  const RimForce& preload_resultant() const { return preload_resultant_; }
  double friction() const { return friction_; }
  /// Whether friction may stick or slide, by Coulomb's law.
  bool has_friction() const { return friction_ > 0 && thresholds_.empty() && !sliding_; }
  int n_points() const { return static_cast<int>(points_.size()); }

  /// A contact quadrature point in the ground frame.
  struct Point {
    Vec<dim> position;  ///< relative to the axle: component 0 towards the ground, 1 along it [m]
    double gap;         ///< g (9) [m]
    double weight;      ///< dS
    double gamma;       ///< [Pa/m]
    GroundFrame frame;  ///< turns column-frame components into the ground frame
  };
  const std::vector<Point>& points() const { return points_; }

  /// Initial guesses for Newton's method: the pressure of the Hertz contact of a solid disc; the undeformed
  /// tread under the rim's prescribed motion; neither tractions nor motions; the solution of another zone,
  /// where both zones are centred on their ground position.
  ContactUnknowns<dim> hertz_start(double load, double radius, double reduced_modulus) const;
  ContactUnknowns<dim> undeformed_start() const;
  ContactUnknowns<dim> zero_start() const;
  ContactUnknowns<dim> start_from(const ContactState<dim>& other) const;

  /// The guess itself if it touches the ground, or if the travel of the rim is prescribed; else the guess in
  /// which the point nearest to the ground carries the load, so that every downward load reaches the ground.
  ContactUnknowns<dim> touching(ContactUnknowns<dim> guess) const;

  ContactUnknowns<dim> residual(const ContactUnknowns<dim>& x) const;

  /// The residual's derivative at x, which refers to this object. Empty if it is singular.
  std::optional<ContactTangent<dim>> tangent(const ContactUnknowns<dim>& x) const;

  /// The derivative of the contact law at every point.
  std::vector<Mat<dim>> tangents(const std::vector<Vec<dim>>& z) const;

  /// The number of components of z that contact meets: the others of every tangent are not used.
  int components() const { return friction_ > 0 || is_bonded() ? dim : 1; }

  /// The change of the residual, beyond that of z itself, when a point's traction changes by `traction`.
  ContactUnknowns<dim> residual_of(int point, const Vec<dim>& traction) const;

  /// Whether the rim moves less than the tread's radius in each of its free motions.
  bool keeps_rim_near(const ContactUnknowns<dim>& step) const;

  /// The contact state for a solution x under the full loads.
  ContactState<dim> state(const ContactUnknowns<dim>& x, int newton_iterations) const;

  /// z without contact, for these coefficients of the rim's free motions.
  std::vector<Vec<dim>> without_contact(const std::vector<double>& free) const;

  /// The minimum distance to the ground, if no point touches [m].
  double smallest_gap(const ContactState<dim>& state) const;

  /// The maximum displacement of a point that moves with the rim.
  double amplitude(const RimMotion& motion) const;

  /// Loads on the zone's observations (rows as in Tread, one column per zone column): -Te^T W Phi.
  Matrix contact_loads(const ContactState<dim>& state) const;

  /// The multipliers of several functions' adjoint problems (79): the transpose of Newton's last linear
  /// system, factored once.
  Expected<std::vector<ContactAdjoint>> adjoints(const ContactState<dim>& state,
                                                 std::span<const ContactAdjointLoads<dim>> functions) const;

  /// Public view of a solution.
  ContactPatch<dim> patch(const ContactState<dim>& state) const;

 private:
  friend class ContactTangent<dim>;
  /// The contact points of a column, and the column and the point in it of one of the zone's points.
  int per_column() const { return n_points() / zone_.n_columns; }
  int zone_column(int point) const { return point / per_column(); }
  int point_of_column(int point) const { return point % per_column(); }
  ObservationRows<dim> observation_rows() const { return {per_column(), 0}; }
  int n_free() const { return static_cast<int>(rim_.free.size()); }
  /// The position of a point in its column.
  struct Place {
    double columns;     ///< of the azimuth, from 0 to 1
    double along_axle;  ///< [m]
  };
  /// A point of a column a number of columns ahead.
  struct Neighbour {
    int columns, point;
  };
  std::vector<Neighbour> neighbours(double shift) const;
  Matrix in_ground_frame(const std::vector<Matrix>& traces, int column) const;
  Matrix column_compliance(const Tread<dim>& tread, int column) const;
  Matrix seams_of_column(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread, int from) const;
  Matrix flexibility(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread) const;
  RimMotion rim_motion(const std::vector<double>& free) const;
  /// Whether a point may carry traction.
  bool is_active(int point, const Vec<dim>& z) const;
  Matrix replies(const Matrix& forces) const;
  std::vector<int> active_rows(const std::vector<Mat<dim>>& tangents) const;
  Matrix active_system(const std::vector<Mat<dim>>& tangents, const std::vector<int>& active) const;

  ContactZone zone_;
  int ring_columns_;
  RimControl rim_;
  Counterpart counterpart_;
  double friction_, tau_, theta_;
  double ground_;                    ///< the ground position, in columns from the zone's first azimuth
  std::vector<Place> places_;        ///< of the points of a column
  std::vector<double> thresholds_;   ///< of given friction; empty: Coulomb's law
  std::optional<Vec<dim>> sliding_;  ///< the direction of friction if all contact points slide
  std::vector<Point> points_;
  std::shared_ptr<const Matrix> flexibility_;
  std::vector<Vec<dim>> preload_;  ///< z_0; empty: zero
  RimForce preload_resultant_;
  double growth_;  ///< (ContactPatch)
};

}  // namespace wheelwright
