#include "contact/tread_column.h"

#include <fmt/format.h>

namespace wheelwright {
namespace {

/// Column nodes in the order base, first line, last line, inner.
template <int dim>
class ColumnNumbering {
 public:
  ColumnNumbering(const PolarGrid<dim>& grid, int degree, int rows)
      : degree_(degree), height_(degree * rows) {
    if constexpr (dim == 3) axial_ = degree * grid.cells[2] + 1;
    n_base = dim * (degree + 1) * axial_;
    n_line = dim * height_ * axial_;
    n_inner = (degree - 1) * n_line;
  }

  int n_retained() const { return n_base + 2 * n_line; }

  /// First dof of the node at (height above the base, azimuth line, axial).
  int dof(const std::array<int, dim>& p) const {
    int axial = 0;
    if constexpr (dim == 3) axial = p[2];
    if (p[0] == 0) return dim * (p[1] * axial_ + axial);
    const int in_line = dim * (axial * height_ + p[0] - 1);
    if (p[1] == 0) return n_base + in_line;
    if (p[1] == degree_) return n_base + n_line + in_line;
    return n_retained() + (p[1] - 1) * n_line + in_line;
  }

  int n_base, n_line, n_inner;

 private:
  int degree_, height_, axial_ = 1;
};

Matrix block(const Matrix& a, int first_row, int rows, int first_column, int columns) {
  Matrix b(rows, columns);
  for (int j = 0; j < columns; ++j) std::copy_n(a.column(first_column + j) + first_row, rows, b.column(j));
  return b;
}

}  // namespace

template <int dim>
Expected<TreadColumn<dim>> tread_column(const ElementTable<dim>& table, int rows, const ContactForm& form,
                                        int points_per_direction) {
  const PolarGrid<dim>& grid = table.grid();
  const int degree = table.degree(), first_row = grid.cells[0] - rows;
  const ColumnNumbering<dim> numbering(grid, degree, rows);
  const int n_retained = numbering.n_retained(), n_inner = numbering.n_inner, n = n_retained + n_inner;
  int axial_cells = 1;
  if constexpr (dim == 3) axial_cells = grid.cells[2];

  const auto face_rule = unit_cell_rule<dim - 1>(points_per_direction);
  const int n_points = static_cast<int>(face_rule.size()) * axial_cells;
  TreadColumn<dim> column{{}, numbering.n_base, numbering.n_line, {}, {}, {}, {}, {}};
  Matrix stiffness(n, n), observation(2 * dim * n_points, n);
  const Material& material = table.material();

  for (int axial = 0; axial < axial_cells; ++axial) {
    for (int row = 0; row < rows; ++row) {
      const auto& element = table.element(first_row + row);
      std::vector<int> dofs;
      for (int a = 0; a < element.n_nodes(); ++a) {
        auto p = local_node_position<dim>(degree, a);
        p[0] += degree * row;
        if constexpr (dim == 3) p[2] += degree * axial;
        for (int c = 0; c < dim; ++c) dofs.push_back(numbering.dof(p) + c);
      }
      const Matrix& k = table.full_cell_stiffness(first_row + row);
      for (int j = 0; j < element.n_dofs(); ++j)
        for (int i = 0; i < element.n_dofs(); ++i) stiffness(dofs[i], dofs[j]) += k(i, j);
      if (row + 1 < rows) continue;

      const double gamma = form.gamma_0 * material.youngs_modulus / element.diameter();
      for (const auto& q : face_rule) {
        Vec<dim> xi{}, outward{};
        xi[0] = outward[0] = 1;
        for (int d = 1; d < dim; ++d) xi[d] = q.xi[d - 1];
        const auto at = element.at(xi);
        const auto surface = map_surface<dim>(at.jacobian, outward);
        const auto traction = traction_map<dim>(element, material, at, surface.normal);
        const int first = 2 * dim * static_cast<int>(column.points.size());
        for (int j = 0; j < element.n_dofs(); ++j) {
          for (int d = 0; d < dim; ++d) {
            observation(first + d, dofs[j]) = at.displacement[d][j];
            observation(first + dim + d, dofs[j]) = traction[d][j];
          }
        }
        Vec<dim> position = at.position;
        if constexpr (dim == 3) position[2] += axial * grid.cell_size()[2];
        const double weight = q.weight * surface.scale, nitsche = -form.theta() / gamma * weight;
        for (int j = 0; j < element.n_dofs(); ++j)
          for (int i = 0; i < element.n_dofs(); ++i)
            for (int d = 0; d < dim; ++d)
              stiffness(dofs[i], dofs[j]) += nitsche * traction[d][i] * traction[d][j];
        column.points.push_back({position, weight, gamma});
      }
    }
  }

  column.stiffness = block(stiffness, 0, n_retained, 0, n_retained);
  column.observation = block(observation, 0, observation.rows(), 0, n_retained);
  column.compliance = Matrix(observation.rows(), observation.rows());
  // The column's own nodes: its first line, then the inner ones.
  column.nodal = Matrix(numbering.n_line + n_inner, n_retained);
  column.nodal_compliance = Matrix(numbering.n_line + n_inner, observation.rows());
  for (int i = 0; i < numbering.n_line; ++i) column.nodal(i, numbering.n_base + i) = 1;
  if (n_inner == 0) return column;

  Matrix inner = block(stiffness, n_retained, n_inner, n_retained, n_inner);
  if (!cholesky(inner))
    return Failure{
        FailureReason::not_positive_definite,
        fmt::format("Nitsche's method with theta = {:g} needs a larger gamma_0 than {:g}: its contact "
                    "term makes the tread's stiffness indefinite",
                    form.theta(), form.gamma_0)};
  const Matrix coupling = block(stiffness, 0, n_retained, n_retained, n_inner);
  const Matrix observed = block(observation, 0, observation.rows(), n_retained, n_inner);
  Matrix to_retained(n_inner, n_retained), to_observed(n_inner, observation.rows());
  for (int j = 0; j < n_inner; ++j) {
    for (int i = 0; i < n_retained; ++i) to_retained(j, i) = coupling(i, j);
    for (int i = 0; i < observation.rows(); ++i) to_observed(j, i) = observed(i, j);
  }
  cholesky_solve(inner, to_retained);
  cholesky_solve(inner, to_observed);
  multiply(-1, coupling, Op::none, to_retained, Op::none, 1, column.stiffness);
  multiply(-1, observed, Op::none, to_retained, Op::none, 1, column.observation);
  multiply(1, observed, Op::none, to_observed, Op::none, 0, column.compliance);
  for (int i = 0; i < n_inner; ++i) {
    for (int j = 0; j < n_retained; ++j) column.nodal(numbering.n_line + i, j) = -to_retained(i, j);
    for (int j = 0; j < observation.rows(); ++j)
      column.nodal_compliance(numbering.n_line + i, j) = to_observed(i, j);
  }
  return column;
}

template Expected<TreadColumn<2>> tread_column(const ElementTable<2>&, int, const ContactForm&, int);
template Expected<TreadColumn<3>> tread_column(const ElementTable<3>&, int, const ContactForm&, int);

}  // namespace wheelwright
