#pragma once

#include <optional>

#include "contact/tread.h"
#include "cyclic/cyclic_stiffness.h"

namespace wheelwright {

/// The ground at one load position, in the body frame: flat, rigid, touching the undeformed tread's circle at
/// ring column `column` (a fraction `offset` of it past its first azimuth); n_y points there from the axle.
struct GroundPosition {
  int column;
  double offset = 0;  ///< 0 <= offset < 1
};

/// Contact quadrature points near the ground position, in the order (column, point of the column).
struct ContactZone {
  int first_column;  ///< may be negative: columns are periodic
  int n_columns;
};

/// The solution of one load position's contact problem, reduced to the zone.
template <int dim>
struct ContactState {
  ContactZone zone;
  std::vector<Vec<dim>> augmented;  ///< z = tau sigma(u)n - gamma (u - g n_y), ground frame [Pa]
  std::vector<Vec<dim>> traction;   ///< Phi(z) on the body, ground frame: component 0 along n_y [Pa]
  double rim_displacement;          ///< alpha_D, towards the ground [m]
  int newton_iterations;
};

/// The contact problem (27) with the rigid rim (4.3) of one load position, condensed onto its contact zone:
///   z = F W Phi(z) + gamma (g - alpha_D) n_y,   sum w Phi_n(z) + P = 0,
/// W the weights, F the flexibility of the zone. Only the components that can carry traction are kept: the
/// normal one without friction.
template <int dim>
class ReducedContact {
 public:
  ReducedContact(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, const PolarGrid<dim>& grid,
                 GroundPosition ground, ContactZone zone);

  const ContactZone& zone() const { return zone_; }
  int n_points() const { return static_cast<int>(points_.size()); }

  /// A contact quadrature point in the ground frame.
  struct Point {
    double along;   ///< distance from the ground position along the ground [m], towards larger azimuth
    double gap;     ///< g (9) [m]
    double weight;  ///< dS
    double gamma;   ///< [Pa/m]
    double angle;   ///< turns column-frame components into ground-frame ones
  };
  const std::vector<Point>& points() const { return points_; }

  /// Semi-smooth Newton from an initial z (normal components in component 0), with a line search on the
  /// residual. `load` P > 0 [N/m when dim = 2]. Fails with newton_stalled, no_contact or not_finite.
  Expected<ContactState<dim>> solve(double load, std::vector<Vec<dim>> initial) const;

  /// A start for solve(): the pressure of the Hertz contact of a solid disc.
  std::vector<Vec<dim>> hertz_start(double load, double radius, double reduced_modulus) const;

  /// Loads on the zone's observations (rows as in Tread, one column a zone column): -Te^T W Phi.
  Matrix contact_loads(const ContactState<dim>& state) const;

  /// The multiplier of the adjoint problem (79): the transpose of solve()'s last linear system.
  /// `observations` of p without the contact part, in the zone. Returns loads on the zone's observations,
  /// -S^T m.
  Expected<Matrix> adjoint_loads(const ContactState<dim>& state, const Matrix& observations) const;

 private:
  int components() const { return friction_ > 0 ? dim : 1; }
  std::vector<int> active_rows(const std::vector<Vec<dim>>& z) const;
  Matrix response_tangent(const std::vector<Vec<dim>>& z, const std::vector<int>& active) const;
  Matrix active_system(const std::vector<Vec<dim>>& z, const std::vector<int>& active,
                       const Matrix& tangent) const;
  std::optional<std::vector<double>> newton_step(const std::vector<Vec<dim>>& z,
                                                 const std::vector<double>& residual) const;
  std::vector<double> residual(const std::vector<Vec<dim>>& z, double rim_displacement, double load) const;

  ContactZone zone_;
  double friction_, tau_, theta_;
  std::vector<Point> points_;
  Matrix flexibility_;
};

}  // namespace wheelwright
