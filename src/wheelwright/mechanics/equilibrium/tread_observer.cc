#include "wheelwright/mechanics/equilibrium/tread_observer.h"

#include "wheelwright/base/periodic.h"

namespace wheelwright {

template <int dim>
struct TreadObserver<dim>::Deformed {
  const Element& element;
  const typename Element::Points& points;
  int cell, sector;
  typename Element::Dofs dofs;
  typename Element::Nodal u;
  typename Element::ProjectedVolume volume;
};

template <int dim>
TreadObserver<dim>::TreadObserver(const RingForms<dim>& forms, const ContactObserver<dim>& contact,
                                  const Materials<dim>& materials, const TreadGrid& tread)
    : forms_(forms), contact_(contact) {
  static_assert(dim == 2, "one cell across the tread");
  const PolarGrid<dim>& grid = forms.domain().grid;
  int n_annulus = 0;
  for (int row = grid.cells[0] - tread.rows; row < grid.cells[0]; ++row) {
    Row of_row{row, {}, {}, materials.in_row(grid, row).density().value_or(0)};
    for (const auto& q : unit_cell_rule<dim>(tread.annulus_points)) {
      of_row.annulus.push_back(forms.table().element(row).at(q.xi));
      const Vec<dim>& x = of_row.annulus.back().position;
      Vec<dim> radial{x[0], x[1]};
      of_row.radial.push_back(radial / norm(radial));
    }
    n_annulus += static_cast<int>(of_row.annulus.size());
    tread_.push_back(std::move(of_row));
  }
  rows_ = {contact.n_points(), n_annulus, tread.observes_spin};
}

template <int dim>
auto TreadObserver<dim>::deformed(const Row& row, const std::vector<double>& v, int ring_column) const
    -> Deformed {
  const PolarGrid<dim>& grid = forms_.domain().grid;
  const int column = wrap(ring_column, grid.ring_columns());
  const Element& element = forms_.table().element(row.row);
  Deformed result{element,
                  forms_.table().full_cell(row.row),
                  grid.cell_index({row.row, column % grid.columns()}),
                  column / grid.columns(),
                  {},
                  {},
                  {}};
  forms_.space().gather(result.cell, result.sector, v.data(), result.dofs.data());
  result.u = element.cartesian(result.dofs.data());
  result.volume = element.projected_volume(result.points, result.dofs.data());
  return result;
}

template <int dim>
std::vector<double> TreadObserver<dim>::values(const std::vector<double>& v, int ring_column) const {
  std::vector<double> result = contact_.values(v, ring_column);
  result.resize(rows_.size(), 0.0);
  int annulus = 0;
  for (const Row& row : tread_) {
    const Deformed cell = deformed(row, v, ring_column);
    for (size_t q = 0; q < row.annulus.size(); ++q, ++annulus) {
      const auto r = cell.element.response_at(row.annulus[q],
                                              cell.element.deformation(row.annulus[q], cell.u), cell.volume);
      for (int i = 0; i < dim; ++i)
        result[rows_.annulus_traction(annulus) + i] = dot(r.piola[i], row.radial[q]);
    }
    for (const auto& point : cell.points.points)
      for (int i = 0; i < dim; ++i) {
        double u = 0;
        for (int a = 0; a < cell.element.n_nodes(); ++a) u += point.value[a] * cell.u[i][a];
        result[rows_.integral() + i] += point.weight * u;
        if (rows_.has_spin && i < 2)
          result[rows_.spin()] += row.density * point.weight * u * point.position[i];
      }
  }
  return result;
}

template <int dim>
void TreadObserver<dim>::add_loads(const std::vector<double>& v, int ring_column,
                                   const double* on_observations, double* loads) const {
  const Matrix tangent = contact_.tangent(v, ring_column);
  const auto dofs = contact_.dofs(ring_column);
  for (int k = 0; k < tangent.columns(); ++k)
    for (int i = 0; dofs[k] >= 0 && i < tangent.rows(); ++i)
      loads[dofs[k]] += tangent(i, k) * on_observations[i];
  int annulus = 0;
  for (const Row& row : tread_) {
    const Deformed cell = deformed(row, v, ring_column);
    typename Element::Dofs of_cell{};
    for (size_t q = 0; q < row.annulus.size(); ++q, ++annulus) {
      const Mat<dim> f = cell.element.deformation(row.annulus[q], cell.u);
      const auto traction = cell.element.traction_tangent(
          row.annulus[q], cell.element.response_at(row.annulus[q], f, cell.volume), f, cell.volume,
          row.radial[q]);
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < cell.element.n_dofs(); ++k)
          of_cell[k] += on_observations[rows_.annulus_traction(annulus) + i] * traction[i][k];
    }
    typename Element::Nodal forces{};
    for (const auto& point : cell.points.points)
      for (int i = 0; i < dim; ++i) {
        double load = on_observations[rows_.integral() + i];
        if (rows_.has_spin && i < 2) load += row.density * on_observations[rows_.spin()] * point.position[i];
        for (int a = 0; a < cell.element.n_nodes(); ++a) forces[i][a] += point.weight * load * point.value[a];
      }
    cell.element.add_to_dofs(forces, of_cell.data());
    forms_.space().scatter(cell.cell, cell.sector, of_cell.data(), loads);
  }
}

template class TreadObserver<2>;

}  // namespace wheelwright
