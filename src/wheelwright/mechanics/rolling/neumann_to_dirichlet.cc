#include "wheelwright/mechanics/rolling/neumann_to_dirichlet.h"

namespace wheelwright {

namespace {

/// Poisson's problem depends only on E, and has no dilatation.
template <int dim>
std::shared_ptr<const ElementTable<dim>> elements_of(const RollingModel<dim>& model, DualNorm norm) {
  if (norm == DualNorm::elasticity)
    return std::make_shared<const ElementTable<dim>>(model.grid, model.degree, model.materials, model.ghost,
                                                     cell_stiffness<dim>, model.side_faces, model.dilatation);
  const Materials<dim> material(Material{model.materials.at_tread().scaling_modulus(), 0});
  return std::make_shared<const ElementTable<dim>>(model.grid, model.degree, material, model.ghost,
                                                   gradient_stiffness<dim>, model.side_faces,
                                                   DilatationKind::pointwise);
}

}  // namespace

template <int dim>
Expected<NeumannToDirichlet<dim>> NeumannToDirichlet<dim>::create(const RollingModel<dim>& model,
                                                                  DualNorm norm) {
  auto elements = elements_of(model, norm);
  // The penalty form has no term of its own in the stiffness.
  auto tread = Tread<dim>::condense(*elements, {model.tread.rows, model.tread.levels, 0},
                                    {.method = ContactMethod::penalty}, model.contact_points);
  if (!tread) return tread.failure();
  CutDomain<dim> full{model.grid, std::vector<CellKind>(model.grid.n_cells(), CellKind::inside), {}, {}};
  const int core_rows = model.grid.cells[0] - model.tread.rows;
  const SectorHarmonics harmonics(model.grid.n_sectors);
  auto ring = CyclicStiffness<dim>::factor(
      sector_stiffness<dim>(full, *elements, core_rows),
      [&](int harmonic) { return tread->outer_stiffness(harmonics, harmonic); }, harmonics);
  if (!ring) return ring.failure();
  return NeumannToDirichlet(std::move(elements), *std::move(tread), *std::move(ring));
}

/// int_Gamma_C g.z as loads on the observed displacements.
template <int dim>
Matrix NeumannToDirichlet<dim>::loads(const Matrix& tractions) const {
  Matrix result(tread_.n_observations(), tractions.columns());
  const ObservationRows<dim> rows = tread_.observation_rows();
  for (int j = 0; j < result.columns(); ++j)
    for (int q = 0; q < rows.n_points; ++q)
      for (int d = 0; d < dim; ++d)
        result(rows.displacement(q) + d, j) = tread_.points()[q].weight * tractions(dim * q + d, j);
  return result;
}

template <int dim>
Matrix NeumannToDirichlet<dim>::operator()(const Matrix& tractions) const {
  const TreadLoads on_tread = tread_loads(tread_, loads(tractions));
  const Matrix outer = ring_.outer_displacements(base_loads(tread_, on_tread));
  const Matrix observed = observations(tread_, tread_field(tread_, outer, on_tread), on_tread);
  const ObservationRows<dim> rows = tread_.observation_rows();
  Matrix w(tractions.rows(), tractions.columns());
  for (int j = 0; j < w.columns(); ++j)
    for (int q = 0; q < rows.n_points; ++q)
      for (int d = 0; d < dim; ++d) w(dim * q + d, j) = observed(rows.displacement(q) + d, j);
  return w;
}

template <int dim>
std::vector<double> NeumannToDirichlet<dim>::energies(const Matrix& tractions) const {
  const int n_columns = tread_.n_columns(), n_sectors = ring_.n_sectors();
  const Matrix observation_loads = loads(tractions);
  const TreadLoads on_tread = tread_loads(tread_, observation_loads);
  const Matrix outer = ring_.outer_displacements(base_loads(tread_, on_tread));
  const Matrix boundary = ring_.boundary_displacements(outer, {});
  const SectorFields core = displacement_fields(ring_, ring_.sector_factor().full_sweep(), boundary, {},
                                                std::vector<double>(boundary.columns(), 1.0));
  const TreadField field = tread_field(tread_, outer, on_tread);
  const TreadColumn<dim>& column = tread_.column();

  std::vector<double> result(tractions.columns() / n_columns, 0.0);
  const SparseSymmetric& k = ring_.sector().matrix;
  std::vector<double> x(k.size), product_x(k.size);
  for (int j = 0; j < boundary.columns(); ++j) {
    for (int dof = 0; dof < k.size; ++dof) x[dof] = core.value(j, ring_.row(dof));
    std::fill(product_x.begin(), product_x.end(), 0.0);
    k.add_product(x.data(), product_x.data());
    for (int dof = 0; dof < k.size; ++dof) result[j / n_sectors] += 0.5 * x[dof] * product_x[dof];
  }
  // A column's energy: its retained unknowns', and what the loads put into the condensed ones.
  for (int j = 0; j < tractions.columns(); ++j) {
    const int first = j - j % n_columns;
    Matrix u(column.stiffness.rows(), 1), load(observation_loads.rows(), 1);
    std::copy_n(field.base.column(j), column.n_base, u.data());
    std::copy_n(field.lines.column(j), column.n_line, u.data() + column.n_base);
    std::copy_n(field.lines.column(first + (j + 1 - first) % n_columns), column.n_line,
                u.data() + column.n_base + column.n_line);
    std::copy_n(observation_loads.column(j), load.rows(), load.data());
    const Matrix force = product(column.stiffness, Op::none, u, Op::none);
    const Matrix inner = product(column.compliance, Op::none, load, Op::none);
    for (int i = 0; i < u.rows(); ++i) result[j / n_columns] += 0.5 * u(i, 0) * force(i, 0);
    for (int i = 0; i < load.rows(); ++i) result[j / n_columns] += 0.5 * load(i, 0) * inner(i, 0);
  }
  return result;
}

template <int dim>
Expected<typename StateSolver<dim>::TractionMap> traction_map(const RollingModel<dim>& model, DualNorm norm) {
  auto created = NeumannToDirichlet<dim>::create(model, norm);
  if (!created) return created.failure();
  const auto map = std::make_shared<const NeumannToDirichlet<dim>>(*std::move(created));
  return typename StateSolver<dim>::TractionMap([map](const Matrix& tractions) { return (*map)(tractions); });
}

template class NeumannToDirichlet<2>;
template class NeumannToDirichlet<3>;
template Expected<StateSolver<2>::TractionMap> traction_map(const RollingModel<2>&, DualNorm);
template Expected<StateSolver<3>::TractionMap> traction_map(const RollingModel<3>&, DualNorm);

}  // namespace wheelwright
