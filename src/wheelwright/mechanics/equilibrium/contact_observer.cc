#include "wheelwright/mechanics/equilibrium/contact_observer.h"

#include "wheelwright/base/periodic.h"

namespace wheelwright {

template <int dim>
ContactObserver<dim>::ContactObserver(const RingForms<dim>& forms, int points_per_face)
    : forms_(forms), row_(forms.domain().grid.cells[0] - 1) {
  static_assert(dim == 2, "one cell across the tread");
  const CellMap<dim> map(forms.domain().grid, forms.table().degree(), {row_});
  for (const auto& q : unit_cell_rule<dim - 1>(points_per_face)) {
    Vec<dim> xi{}, outward{};
    xi[0] = outward[0] = 1;
    for (int d = 1; d < dim; ++d) xi[d] = q.xi[d - 1];
    const auto surface =
        map_surface<dim>(map.jacobian(ShapeFunctions<dim>(forms.table().degree(), xi)), outward);
    points_.push_back({element().at(xi), surface.normal});
  }
}

template <int dim>
int ContactObserver<dim>::cell(int ring_column) const {
  const PolarGrid<dim>& grid = forms_.domain().grid;
  std::array<int, dim> place{};
  place[0] = row_;
  place[1] = ring_column % grid.columns();
  return grid.cell_index(place);
}

template <int dim>
std::vector<int> ContactObserver<dim>::dofs(int ring_column) const {
  const int column = wrap(ring_column, forms_.domain().grid.ring_columns());
  std::vector<int> result;
  for (const int node : forms_.space().cell_nodes(cell(column), column / forms_.domain().grid.columns()))
    for (int c = 0; c < dim; ++c) result.push_back(node < 0 ? -1 : RingSpace<dim>::dof(node, c));
  return result;
}

template <int dim>
std::vector<double> ContactObserver<dim>::gathered(const std::vector<double>& v, int ring_column) const {
  std::vector<double> result;
  for (const int dof : dofs(ring_column)) result.push_back(dof < 0 ? 0 : v[dof]);
  return result;
}

template <int dim>
std::vector<double> ContactObserver<dim>::values(const std::vector<double>& v, int ring_column) const {
  const auto of_cell = gathered(v, ring_column);
  const auto u = element().cartesian(of_cell.data());
  const auto volume = element().projected_volume(forms_.table().full_cell(row_), of_cell.data());
  std::vector<double> result(rows().n_contact(), 0.0);
  for (int q = 0; q < n_points(); ++q) {
    const auto& [point, normal] = points_[q];
    const auto r = element().response_at(point, element().deformation(point, u), volume);
    for (int i = 0; i < dim; ++i) {
      for (int a = 0; a < element().n_nodes(); ++a)
        result[rows().displacement(q) + i] += point.value[a] * u[i][a];
      result[rows().traction(q) + i] = dot(r.piola[i], normal);
    }
  }
  return result;
}

template <int dim>
Matrix ContactObserver<dim>::tangent(const std::vector<double>& v, int ring_column) const {
  const auto of_cell = gathered(v, ring_column);
  const auto u = element().cartesian(of_cell.data());
  const auto volume = element().projected_volume(forms_.table().full_cell(row_), of_cell.data());
  Matrix result(rows().n_contact(), n_cell_dofs());
  for (int q = 0; q < n_points(); ++q) {
    const auto& [point, normal] = points_[q];
    const Mat<dim> f = element().deformation(point, u);
    const auto traction =
        element().traction_tangent(point, element().response_at(point, f, volume), f, volume, normal);
    for (int i = 0; i < dim; ++i) {
      typename HyperelasticElement<dim>::Nodal unit{};
      for (int a = 0; a < element().n_nodes(); ++a) unit[i][a] = point.value[a];
      typename HyperelasticElement<dim>::Dofs displacement{};
      element().add_to_dofs(unit, displacement.data());
      for (int k = 0; k < n_cell_dofs(); ++k) {
        result(rows().displacement(q) + i, k) = displacement[k];
        result(rows().traction(q) + i, k) = traction[i][k];
      }
    }
  }
  return result;
}

template <int dim>
std::vector<double> ContactObserver<dim>::stretches(const std::vector<double>& v, int ring_column) const {
  const auto u = element().cartesian(gathered(v, ring_column).data());
  std::vector<double> result;
  for (const auto& [point, normal] : points_) {
    const Mat<dim> f = element().deformation(point, u);
    result.push_back(determinant<dim>(f) * norm(transpose_times<dim>(inverse<dim>(f), normal)));
  }
  return result;
}

template <int dim>
std::vector<int> tread_nodes(const RingSpace<dim>& space, const ContactZone& zone) {
  const int degree = space.degree(), rows = space.grid().cells[0];
  const int first = degree * zone.first_column, last = degree * (zone.first_column + zone.n_columns);
  std::vector<int> nodes;
  for (int line = first; line <= last; ++line)
    for (int radial = degree * (rows - 1); radial <= degree * rows; ++radial)
      nodes.push_back(space.number({radial, line}));
  return nodes;
}

template class ContactObserver<2>;
template decltype(tread_nodes<2>) tread_nodes<2>;

}  // namespace wheelwright
