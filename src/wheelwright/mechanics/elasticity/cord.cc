#include "wheelwright/mechanics/elasticity/cord.h"

namespace wheelwright {

template <int dim>
Matrix cord_stiffness(const ElasticElement<dim>& element, double stiffness) {
  const int n = element.n_dofs();
  Matrix k(n, n);
  std::vector<double> hoop_strain(n);
  for (const auto& q : unit_cell_rule<dim - 1>(element.degree() + 2)) {
    Vec<dim> xi{}, outward{};
    xi[0] = outward[0] = 1;
    for (int d = 1; d < dim; ++d) xi[d] = q.xi[d - 1];
    const Mat<dim> jacobian = element.with_own_strain(xi).jacobian;
    Vec<dim> tangent;
    for (int i = 0; i < dim; ++i) tangent[i] = jacobian[i][1];
    tangent = tangent / norm<dim>(tangent);
    const auto gradient = element.gradient(xi);
    for (int dof = 0; dof < n; ++dof) {
      hoop_strain[dof] = 0;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          hoop_strain[dof] += tangent[i] * gradient[dim * i + j][dof] * tangent[j];
    }
    const double weight = stiffness * q.weight * map_surface<dim>(jacobian, outward).scale;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) k(i, j) += weight * hoop_strain[i] * hoop_strain[j];
  }
  return k;
}

template decltype(cord_stiffness<2>) cord_stiffness<2>;
template decltype(cord_stiffness<3>) cord_stiffness<3>;

}  // namespace wheelwright
