#pragma once

#include "wheelwright/mechanics/contact/contact_operator.h"
#include "wheelwright/mechanics/equilibrium/ring_forms.h"

namespace wheelwright {

/// What the contact points of a deformed ring observe: the displacement v, without the rim's motion, and the
/// Piola traction P n on the undeformed tread. Everything is in the frames of the columns.
template <int dim>
class ContactObserver {
 public:
  /// With so many Gauss points on every face of a tread that is not refined. Refers to `forms`.
  ContactObserver(const RingForms<dim>& forms, int points_per_face);

  int n_points() const { return static_cast<int>(points_.size()); }  ///< of a column
  ObservationRows<dim> rows() const { return {n_points(), 0}; }
  int n_cell_dofs() const { return element().n_dofs(); }

  /// The dofs of the ring on which the observations of a column depend, -1 for fixed ones.
  std::vector<int> dofs(int ring_column) const;

  /// The values, in the order of ObservationRows.
  std::vector<double> values(const std::vector<double>& v, int ring_column) const;

  /// Their derivatives with respect to those dofs, one row per observation.
  Matrix tangent(const std::vector<double>& v, int ring_column) const;

  /// The deformed by the undeformed area of the tread at the contact points: J |F^-T n|.
  std::vector<double> stretches(const std::vector<double>& v, int ring_column) const;

 private:
  struct FacePoint {
    typename HyperelasticElement<dim>::Point point;
    Vec<dim> normal;
  };
  const HyperelasticElement<dim>& element() const { return forms_.table().element(row_); }
  std::vector<double> gathered(const std::vector<double>& v, int ring_column) const;
  int cell(int ring_column) const;

  const RingForms<dim>& forms_;
  int row_;
  std::vector<FacePoint> points_;
};

/// The nodes of the tread's cells in a zone of columns, in the order of their azimuths.
template <int dim>
std::vector<int> tread_nodes(const RingSpace<dim>& space, const ContactZone& zone);

}  // namespace wheelwright
