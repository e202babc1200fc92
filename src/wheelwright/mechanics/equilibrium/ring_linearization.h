#pragma once

#include <memory>

#include "wheelwright/linalg/lu_factor.h"
#include "wheelwright/linalg/partial_cholesky.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"
#include "wheelwright/mechanics/equilibrium/contact_observer.h"
#include "wheelwright/mechanics/equilibrium/elimination_order.h"

namespace wheelwright {

/// What the load positions of a shape share.
template <int dim>
struct RingProblem {
  const RingForms<dim>& forms;
  const ContactObserver<dim>& observer;
  const EliminationOrders<dim>& orders;
};

/// The equations of a load position linearized at a displacement v: the tangent of ring and ghost penalty,
/// condensed onto the nodes of the tread in the contact zone, the trailing unknowns; and the contact there,
/// in the form of the linear wheel's contact.
template <int dim>
class RingLinearization {
 public:
  /// Fails with not_positive_definite if the ring is unstable even where all nodes of the tread in the zone
  /// are held, with overload where material is turned inside out, and with not_finite.
  static Expected<std::shared_ptr<const RingLinearization>> at(const RingProblem<dim>& problem,
                                                               const std::vector<double>& v,
                                                               ContactPoints<dim> zone, int components,
                                                               double tau);

  /// At v: the forces, and the stored energy.
  const typename RingForms<dim>::Forces& forces() const { return forces_; }
  const ContactZone& zone() const { return operator_->at.zone; }
  int n_trailing() const { return factor_.n_trailing(); }
  /// The condensed tangent of the trailing unknowns, without contact.
  const Matrix& schur() const { return factor_.schur(); }
  const std::shared_ptr<const ContactOperator<dim>>& contact_operator() const { return operator_; }

  /// Loads on the ring, one set per row and one column per dof of RingSpace, in elimination order and
  /// eliminated; and displacements from such loads back in the order of RingSpace.
  Matrix eliminated(const Matrix& loads) const;
  /// `loads`: eliminated; those of the contact are added to the trailing ones.
  Matrix displacements(Matrix loads) const;

  /// Displacements of the ring, without loads off the zone, for trailing ones; one row per set.
  Matrix extended(const Matrix& trailing) const;

  /// The trailing displacements for eliminated loads, one row per set.
  Matrix trailing_displacements(const Matrix& loads) const;

  /// The changes of what the contact points observe for trailing displacements (one row, `row`), one column
  /// per column of the zone.
  Matrix observed(const Matrix& trailing, int row) const;

  /// Adds loads on the observations of the zone to the trailing loads in a row of eliminated loads.
  void add_contact_loads(const Matrix& on_observations, int row, Matrix& loads) const;

  /// The displacements of the contact points in the frames of the contact, one row per (point, component), as
  /// functions of the trailing unknowns.
  const Matrix& contact_displacements() const { return tests_; }

 private:
  explicit RingLinearization(PartialCholesky factor) : factor_(std::move(factor)) {}
  /// Eliminated loads and trailing displacements as displacements in the order of RingSpace.
  Matrix substituted(Matrix eliminated, const Matrix& trailing) const;

  PartialCholesky factor_;
  std::vector<int> places_;  ///< in elimination order, of every dof of RingSpace
  LuFactor schur_factor_;
  typename RingForms<dim>::Forces forces_;
  std::vector<Matrix> observations_;        ///< of every column of the zone (ContactObserver::tangent())
  std::vector<std::vector<int>> trailing_;  ///< trailing unknowns of those matrices' columns
  Matrix tests_;
  std::shared_ptr<const ContactOperator<dim>> operator_;
};

}  // namespace wheelwright
