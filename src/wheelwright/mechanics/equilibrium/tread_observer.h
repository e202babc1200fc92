#pragma once

#include "wheelwright/mechanics/equilibrium/contact_observer.h"
#include "wheelwright/mechanics/state/tread_surface.h"

namespace wheelwright {

/// All observations of the tread (ObservationRows) of a deformed ring, with Piola tractions P n: those of the
/// contact points, and what the functions of the tread see beside them.
template <int dim>
class TreadObserver {
 public:
  /// For a tread that is not refined. Refers to `forms` and `contact`.
  TreadObserver(const RingForms<dim>& forms, const ContactObserver<dim>& contact,
                const Materials<dim>& materials, const TreadGrid& tread);

  ObservationRows<dim> rows() const { return rows_; }

  /// The observations of a column, in its frame.
  std::vector<double> values(const std::vector<double>& v, int ring_column) const;

  /// Adds loads on the observations of a column to the loads on the dofs of the ring: the transpose of the
  /// derivative of values().
  void add_loads(const std::vector<double>& v, int ring_column, const double* on_observations,
                 double* loads) const;

 private:
  using Element = HyperelasticElement<dim>;
  /// A row of cells of the tread.
  struct Row {
    int row;
    std::vector<typename Element::Point> annulus;
    std::vector<Vec<dim>> radial;  ///< normals there
    double density;
  };
  /// A cell of a column in a state.
  struct Deformed;
  Deformed deformed(const Row& row, const std::vector<double>& v, int ring_column) const;

  const RingForms<dim>& forms_;
  const ContactObserver<dim>& contact_;
  ObservationRows<dim> rows_;
  std::vector<Row> tread_;
};

}  // namespace wheelwright
