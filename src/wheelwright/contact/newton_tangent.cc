#include "wheelwright/contact/newton_tangent.h"

#include "wheelwright/linalg/dense.h"

namespace wheelwright {
namespace {

/// A component of a point's z on whose change the traction now depends otherwise.
template <int dim>
struct Correction {
  int point, component;
  Vec<dim> traction;  ///< the difference of its derivatives
};

template <int dim>
std::vector<Correction<dim>> corrections(const std::vector<Mat<dim>>& before,
                                         const std::vector<Mat<dim>>& after, int components) {
  std::vector<Correction<dim>> result;
  for (size_t i = 0; i < after.size(); ++i)
    for (int d = 0; d < components; ++d) {
      Correction<dim> one{static_cast<int>(i), d, {}};
      bool differs = false;
      for (int k = 0; k < components; ++k) {
        one.traction[k] = after[i][k][d] - before[i][k][d];
        differs = differs || one.traction[k] != 0;
      }
      if (differs) result.push_back(one);
    }
  return result;
}

/// y += factor x.
template <int dim>
void add(double factor, const ContactUnknowns<dim>& x, ContactUnknowns<dim>& y) {
  for (size_t i = 0; i < y.augmented.size(); ++i)
    for (int d = 0; d < dim; ++d) y.augmented[i][d] += factor * x.augmented[i][d];
  for (size_t k = 0; k < y.rim.size(); ++k) y.rim[k] += factor * x.rim[k];
}

}  // namespace

/// With the tangent A + R V^T, where V picks the corrected components of z: x = y - Z (1 + V^T Z)^-1 V^T y,
/// A y = residual, A Z = R.
template <int dim>
std::optional<ContactUnknowns<dim>> NewtonTangent<dim>::corrected_step(
    const std::vector<Mat<dim>>& tangents, const ContactUnknowns<dim>& residual) const {
  const auto changed = corrections<dim>(factored_->tangents(), tangents, contact_->components());
  const int n = static_cast<int>(changed.size());
  if (n > factored_->n_unknowns() / 4) return {};
  std::vector<ContactUnknowns<dim>> solved;
  for (const Correction<dim>& one : changed) solved.push_back(contact_->residual_of(one.point, one.traction));
  solved.push_back(residual);
  solved = factored_->solve(std::move(solved));
  ContactUnknowns<dim> step = std::move(solved.back());
  if (n == 0) return step;
  Matrix small(n, n), picked(n, 1);
  for (int i = 0; i < n; ++i) {
    const auto pick = [&](const ContactUnknowns<dim>& x) {
      return x.augmented[changed[i].point][changed[i].component];
    };
    for (int j = 0; j < n; ++j) small(i, j) = (i == j) + pick(solved[j]);
    picked(i, 0) = pick(step);
  }
  if (!lu_solve(small, picked)) return {};
  for (int j = 0; j < n; ++j) add<dim>(-picked(j, 0), solved[j], step);
  return step;
}

template <int dim>
std::optional<ContactUnknowns<dim>> NewtonTangent<dim>::step(const ContactUnknowns<dim>& x,
                                                             const ContactUnknowns<dim>& residual) {
  std::optional<ContactUnknowns<dim>> step;
  if (factored_) step = corrected_step(contact_->tangents(x.augmented), residual);
  if (!step) {
    factored_ = contact_->tangent(x);
    if (!factored_) return {};
    step = factored_->solve(residual);
  }
  if (!contact_->keeps_rim_near(*step)) return {};
  return step;
}

template class NewtonTangent<2>;
template class NewtonTangent<3>;

}  // namespace wheelwright
