#include "wheelwright/mechanics/contact/contact_tangent.h"

namespace wheelwright {
namespace {

/// The components of z on which tractions depend: the columns of all others are unit vectors in the Newton
/// matrix.
template <int dim>
std::vector<int> active_rows(const std::vector<Mat<dim>>& tangents, int nc) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(tangents.size()); ++i)
    for (int d = 0; d < nc; ++d) {
      bool matters = false;
      for (int k = 0; k < nc; ++k) matters = matters || tangents[i][k][d] != 0;
      if (matters) rows.push_back(nc * i + d);
    }
  return rows;
}

/// The Newton system on the active rows and the rim's free motions.
template <int dim>
Matrix matrix_on(const ReducedContact<dim>& contact, const std::vector<Mat<dim>>& tangents,
                 const std::vector<int>& active) {
  const int nc = contact.components(), n = static_cast<int>(active.size()), n_free = contact.n_free();
  Matrix a(n + n_free, n + n_free);
  for (int j = 0; j < n; ++j) {
    const int index = active[j] / nc, component = active[j] % nc;
    const ZonePoint<dim>& point = contact.points()[index];
    for (int k = 0; k < nc; ++k) {
      const double weight = point.weight * tangents[index][k][component];
      if (weight == 0) continue;
      const double* f = contact.tread().flexibility.column(nc * index + k);
      double* column = a.column(j);
      for (int i = 0; i < n; ++i) column[i] -= weight * f[active[i]];
    }
    a(j, j) += 1;
    for (int k = 0; k < n_free; ++k) {
      const Vec<dim> motion = rim_displacement(point, contact.rim().free[k].direction);
      for (int d = 0; d < nc; ++d) a(n + k, j) -= point.weight * tangents[index][d][component] * motion[d];
      a(j, n + k) = point.gamma * motion[component];
    }
  }
  return a;
}

}  // namespace

template <int dim>
ActiveSystem<dim> active_system(const ReducedContact<dim>& contact, const std::vector<Vec<dim>>& z) {
  auto tangents = contact.tangents(z);
  auto active = active_rows<dim>(tangents, contact.components());
  Matrix matrix = matrix_on<dim>(contact, tangents, active);
  return {std::move(tangents), std::move(active), std::move(matrix)};
}

template <int dim>
std::optional<ContactTangent<dim>> ContactTangent<dim>::at(const ReducedContact<dim>& contact,
                                                           const ContactUnknowns<dim>& x) {
  ActiveSystem<dim> system = active_system<dim>(contact, x.augmented);
  auto factor = LuFactor::factor(std::move(system.matrix));
  if (!factor) return {};
  return ContactTangent(contact, std::move(system), *std::move(factor));
}

template <int dim>
ContactUnknowns<dim> ContactTangent<dim>::solve(const ContactUnknowns<dim>& residual) const {
  return std::move(solve(std::vector{residual}).front());
}

template <int dim>
std::vector<ContactUnknowns<dim>> ContactTangent<dim>::solve(
    std::vector<ContactUnknowns<dim>> residuals) const {
  const ReducedContact<dim>& contact = *contact_;
  const int nc = contact.components(), n_active = static_cast<int>(active_.size()), n_free = contact.n_free();
  auto solutions = Matrix::unfilled(n_active + n_free, static_cast<int>(residuals.size()));
  for (int j = 0; j < solutions.columns(); ++j) {
    for (int i = 0; i < n_active; ++i)
      solutions(i, j) = residuals[j].augmented[active_[i] / nc][active_[i] % nc];
    for (int k = 0; k < n_free; ++k) solutions(n_active + k, j) = residuals[j].rim[k];
  }
  solutions = factor_.solve(std::move(solutions));

  // The other rows follow from the active ones: their columns are unit vectors.
  Matrix forces(contact.n_points() * nc, solutions.columns());
  for (int j = 0; j < solutions.columns(); ++j)
    for (int i = 0; i < n_active; ++i) {
      const int point = active_[i] / nc;
      for (int k = 0; k < nc; ++k)
        forces(nc * point + k, j) +=
            contact.points()[point].weight * tangents_[point][k][active_[i] % nc] * solutions(i, j);
    }
  const Matrix replies = contact.tread().replies(forces);
  for (int j = 0; j < solutions.columns(); ++j) {
    ContactUnknowns<dim>& step = residuals[j];
    for (int k = 0; k < n_free; ++k) step.rim[k] = solutions(n_active + k, j);
    for (int i = 0; i < contact.n_points(); ++i) {
      const auto& point = contact.points()[i];
      for (int k = 0; k < n_free; ++k) {
        const Vec<dim> motion = rim_displacement(point, contact.rim().free[k].direction);
        for (int d = 0; d < nc; ++d) step.augmented[i][d] -= point.gamma * motion[d] * step.rim[k];
      }
      for (int d = 0; d < nc; ++d) step.augmented[i][d] += replies(nc * i + d, j);
    }
    for (int i = 0; i < n_active; ++i) step.augmented[active_[i] / nc][active_[i] % nc] = solutions(i, j);
  }
  return residuals;
}

template ActiveSystem<2> active_system<2>(const ReducedContact<2>&, const std::vector<Vec<2>>&);
template ActiveSystem<3> active_system<3>(const ReducedContact<3>&, const std::vector<Vec<3>>&);
template class ContactTangent<2>;
template class ContactTangent<3>;

}  // namespace wheelwright
