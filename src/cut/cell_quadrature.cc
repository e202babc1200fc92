#include "cut/cell_quadrature.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/non_matching/quadrature_generator.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wheelwright {
namespace {

/// The polynomial of one cell in the form that deal.II's quadrature generator wants.
template <int dim>
class CellPolynomial : public dealii::Function<dim> {
 public:
  CellPolynomial(int degree, std::span<const double> nodal_values) : degree_(degree), nodal_(nodal_values) {}

  double value(const dealii::Point<dim>& x, unsigned int = 0) const override {
    const auto axes = evaluate(x);
    double sum = 0;
    for_each_node([&](int a, const std::array<int, dim>& p) {
      double term = nodal_[a];
      for (int d = 0; d < dim; ++d) term *= axes[d].value[p[d]];
      sum += term;
    });
    return sum;
  }

  dealii::Tensor<1, dim> gradient(const dealii::Point<dim>& x, unsigned int = 0) const override {
    const auto axes = evaluate(x);
    dealii::Tensor<1, dim> sum;
    for_each_node([&](int a, const std::array<int, dim>& p) {
      for (int g = 0; g < dim; ++g) {
        double term = nodal_[a];
        for (int d = 0; d < dim; ++d) term *= d == g ? axes[d].derivative[p[d]] : axes[d].value[p[d]];
        sum[g] += term;
      }
    });
    return sum;
  }

  dealii::SymmetricTensor<2, dim> hessian(const dealii::Point<dim>& x, unsigned int = 0) const override {
    const auto axes = evaluate(x);
    dealii::SymmetricTensor<2, dim> sum;
    for_each_node([&](int a, const std::array<int, dim>& p) {
      for (int g = 0; g < dim; ++g) {
        for (int h = g; h < dim; ++h) {
          double term = nodal_[a];
          for (int d = 0; d < dim; ++d) {
            const int order = (d == g) + (d == h);
            term *= order == 0   ? axes[d].value[p[d]]
                    : order == 1 ? axes[d].derivative[p[d]]
                                 : axes[d].second[p[d]];
          }
          sum[g][h] += term;
        }
      }
    });
    return sum;
  }

 private:
  std::array<Lagrange1D, dim> evaluate(const dealii::Point<dim>& x) const {
    if constexpr (dim == 2)
      return {Lagrange1D(degree_, x[0]), Lagrange1D(degree_, x[1])};
    else
      return {Lagrange1D(degree_, x[0]), Lagrange1D(degree_, x[1]), Lagrange1D(degree_, x[2])};
  }

  template <class Visit>
  void for_each_node(Visit visit) const {
    for (int a = 0; a < static_cast<int>(nodal_.size()); ++a) visit(a, local_node_position<dim>(degree_, a));
  }

  int degree_;
  std::span<const double> nodal_;
};

template <int dim>
Vec<dim> to_vec(const dealii::Tensor<1, dim>& x) {
  Vec<dim> v;
  for (int d = 0; d < dim; ++d) v[d] = x[d];
  return v;
}

}  // namespace

template <int dim>
struct CellQuadrature<dim>::Implementation {
  int degree;
  dealii::hp::QCollection<1> rules;  // the generator keeps a reference
  dealii::NonMatching::QuadratureGenerator<dim> generator;

  Implementation(int level_set_degree, int points)
      : degree(level_set_degree), rules(dealii::QGauss<1>(points)), generator(rules) {}
};

template <int dim>
CellQuadrature<dim>::CellQuadrature(int degree, int points)
    : implementation_(std::make_unique<Implementation>(degree, points)) {}

template <int dim>
CellQuadrature<dim>::~CellQuadrature() = default;

template <int dim>
CellKind CellQuadrature<dim>::classify(std::span<const double> nodal_values) const {
  std::array<double, power(3, dim)> bernstein;
  std::copy(nodal_values.begin(), nodal_values.end(), bernstein.begin());
  const int degree = implementation_->degree;
  if (degree == 2) {
    // Along each axis the middle Bernstein coefficient is 2 f(1/2) - (f(0) + f(1)) / 2.
    for (int d = 0, stride = 1; d < dim; ++d, stride *= 3)
      for (int block = 0; block < power(3, dim); block += 3 * stride)
        for (int a = block + stride; a < block + 2 * stride; ++a)
          bernstein[a] = 2 * bernstein[a] - 0.5 * (bernstein[a - stride] + bernstein[a + stride]);
  }
  const auto [low, high] = std::minmax_element(bernstein.begin(), bernstein.begin() + nodal_values.size());
  if (*high < 0) return CellKind::inside;
  if (*low > 0) return CellKind::outside;
  return CellKind::cut;
}

template <int dim>
std::optional<CutCell<dim>> CellQuadrature<dim>::split(int cell, std::span<const double> nodal_values) {
  dealii::Point<dim> origin, corner;
  for (int d = 0; d < dim; ++d) corner[d] = 1;
  auto& generator = implementation_->generator;
  generator.generate(CellPolynomial<dim>(implementation_->degree, nodal_values),
                     dealii::BoundingBox<dim>({origin, corner}));

  const auto& inside = generator.get_inside_quadrature();
  const auto& outside = generator.get_outside_quadrature();
  const auto sum = [](const std::vector<double>& w) { return std::accumulate(w.begin(), w.end(), 0.0); };
  if (!(std::abs(sum(inside.get_weights()) + sum(outside.get_weights()) - 1) < 1e-6)) return {};

  CutCell<dim> result{cell, {}, {}};
  for (unsigned q = 0; q < inside.size(); ++q)
    result.material.push_back({to_vec<dim>(inside.point(q)), inside.weight(q)});
  const auto& surface = generator.get_surface_quadrature();
  for (unsigned q = 0; q < surface.size(); ++q)
    result.boundary.push_back(
        {to_vec<dim>(surface.point(q)), to_vec<dim>(surface.normal_vector(q)), surface.weight(q)});
  return result;
}

template class CellQuadrature<2>;
template class CellQuadrature<3>;

}  // namespace wheelwright
