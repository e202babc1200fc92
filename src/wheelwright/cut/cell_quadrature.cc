#include "wheelwright/cut/cell_quadrature.h"

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

/// Steeper graphs bend too much for the rule: with 4, derivatives on coarse grids were wrong by up to 1e-3.
/// On fine grids, where a boundary is next to straight in a cell, hardly a cell is divided for it.
constexpr double max_slope = 2;

/// deal.II halves an edge, or a part of it, at most this often to tell two zeros on it apart, and loses both
/// if that does not: the boundary leaves the box there and comes back. Its default is 2.
constexpr unsigned max_root_finder_splits = 8;

dealii::NonMatching::AdditionalQGeneratorData generator_options() {
  dealii::NonMatching::AdditionalQGeneratorData options;
  options.max_root_finder_splits = max_root_finder_splits;
  return options;
}

/// A polynomial in Bernstein form on a box: its coefficients bound it, their differences its derivatives.
template <int dim>
class BernsteinForm {
 public:
  BernsteinForm(int degree, std::span<const double> nodal_values) : degree_(degree) {
    std::copy(nodal_values.begin(), nodal_values.end(), coefficients_.begin());
    if (degree != 2) return;
    // Along each axis the middle coefficient is 2 f(1/2) - (f(0) + f(1)) / 2.
    for (int d = 0, stride = 1; d < dim; ++d, stride *= 3)
      for (int block = 0; block < power(3, dim); block += 3 * stride)
        for (int a = block + stride; a < block + 2 * stride; ++a)
          coefficients_[a] =
              2 * coefficients_[a] - 0.5 * (coefficients_[a - stride] + coefficients_[a + stride]);
  }

  CellKind sign() const {
    const auto [low, high] =
        std::minmax_element(coefficients_.begin(), coefficients_.begin() + nodes_per_cell<dim>(degree_));
    if (*high < 0) return CellKind::inside;
    if (*low > 0) return CellKind::outside;
    return CellKind::cut;
  }

  /// Whether the zero set is certain to be a graph over the other axes along one axis of the box, with a
  /// slope of at most max_slope in the box's coordinates.
  bool is_graph() const {
    std::array<double, dim> smallest, largest;  // of the derivatives' absolute values
    for (int d = 0, stride = 1; d < dim; ++d, stride *= degree_ + 1) {
      double low = INFINITY, high = -INFINITY;
      for (int a = 0; a < nodes_per_cell<dim>(degree_); ++a) {
        if (local_node_position<dim>(degree_, a)[d] == degree_) continue;
        const double difference = coefficients_[a + stride] - coefficients_[a];
        low = std::min(low, difference);
        high = std::max(high, difference);
      }
      smallest[d] = std::max({low, -high, 0.0});
      largest[d] = std::max(-low, high);
    }
    const double steepest = *std::max_element(largest.begin(), largest.end());
    const double best = *std::max_element(smallest.begin(), smallest.end());
    return best > 0 && steepest <= max_slope * best;
  }

 private:
  int degree_;
  std::array<double, power(3, dim)> coefficients_;
};

/// Where a box is divided: off centre, for a symmetric saddle would vanish on the parts' faces.
constexpr double dividing_point = 0.48;

/// How often a box is divided in which the boundary is not certain to be a graph.
constexpr int max_divisions = 3;

}  // namespace

template <int dim>
struct CellQuadrature<dim>::Implementation {
  int degree;
  dealii::hp::QCollection<1> rules;  // the generator keeps a reference
  dealii::NonMatching::QuadratureGenerator<dim> generator;
  std::vector<ReferencePoint<dim>> full_rule;

  Implementation(int level_set_degree, int points)
      : degree(level_set_degree),
        rules(dealii::QGauss<1>(points)),
        generator(rules, generator_options()),
        full_rule(unit_cell_rule<dim>(points)) {}

  /// Appends the quadrature of a box. False when the measures of both sides do not add up to the box's.
  bool append(const CellPolynomial<dim>& psi, const dealii::BoundingBox<dim>& box, int divisions,
              CutCell<dim>& result) {
    std::array<double, power(3, dim)> values;
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
      const auto p = local_node_position<dim>(degree, a);
      Vec<dim> xi;
      for (int d = 0; d < dim; ++d) xi[d] = double(p[d]) / degree;
      values[a] = psi.value(point_in(box, xi));
    }
    const BernsteinForm<dim> bernstein(degree, std::span(values).first(nodes_per_cell<dim>(degree)));
    const CellKind kind = bernstein.sign();
    if (kind == CellKind::outside) return true;
    if (kind == CellKind::inside) {
      for (const auto& q : full_rule)
        result.material.push_back({to_vec<dim>(point_in(box, q.xi)), q.weight * box.volume()});
      return true;
    }
    if (divisions < max_divisions && !bernstein.is_graph()) {
      for (int part = 0; part < power(2, dim); ++part)
        if (!append(psi, part_of(box, part), divisions + 1, result)) return false;
      return true;
    }
    return append_smooth(psi, box, result);
  }

 private:
  bool append_smooth(const CellPolynomial<dim>& psi, const dealii::BoundingBox<dim>& box,
                     CutCell<dim>& result) {
    generator.generate(psi, box);
    const auto& inside = generator.get_inside_quadrature();
    const auto& outside = generator.get_outside_quadrature();
    const auto sum = [](const std::vector<double>& w) { return std::accumulate(w.begin(), w.end(), 0.0); };
    const double measure = sum(inside.get_weights()) + sum(outside.get_weights());
    if (!(std::abs(measure - box.volume()) < 1e-6 * box.volume())) return false;
    for (unsigned q = 0; q < inside.size(); ++q)
      result.material.push_back({to_vec<dim>(inside.point(q)), inside.weight(q)});
    const auto& surface = generator.get_surface_quadrature();
    for (unsigned q = 0; q < surface.size(); ++q)
      result.boundary.push_back(
          {to_vec<dim>(surface.point(q)), to_vec<dim>(surface.normal_vector(q)), surface.weight(q)});
    return true;
  }

  static dealii::Point<dim> point_in(const dealii::BoundingBox<dim>& box, const Vec<dim>& xi) {
    dealii::Point<dim> x;
    for (int d = 0; d < dim; ++d) x[d] = box.lower_bound(d) + xi[d] * box.side_length(d);
    return x;
  }

  static dealii::BoundingBox<dim> part_of(const dealii::BoundingBox<dim>& box, int part) {
    const auto upper = local_node_position<dim>(1, part);
    Vec<dim> first, last;
    for (int d = 0; d < dim; ++d) {
      first[d] = upper[d] ? dividing_point : 0;
      last[d] = upper[d] ? 1 : dividing_point;
    }
    return dealii::BoundingBox<dim>({point_in(box, first), point_in(box, last)});
  }
};

template <int dim>
CellQuadrature<dim>::CellQuadrature(int degree, int points)
    : implementation_(std::make_unique<Implementation>(degree, points)) {}

template <int dim>
CellQuadrature<dim>::~CellQuadrature() = default;

template <int dim>
CellKind CellQuadrature<dim>::classify(std::span<const double> nodal_values) const {
  return BernsteinForm<dim>(implementation_->degree, nodal_values).sign();
}

template <int dim>
std::optional<CutCell<dim>> CellQuadrature<dim>::split(int cell, std::span<const double> nodal_values) {
  dealii::Point<dim> origin, corner;
  for (int d = 0; d < dim; ++d) corner[d] = 1;
  CutCell<dim> result{cell, {}, {}};
  const CellPolynomial<dim> psi(implementation_->degree, nodal_values);
  if (!implementation_->append(psi, dealii::BoundingBox<dim>({origin, corner}), 0, result)) return {};
  return result;
}

template class CellQuadrature<2>;
template class CellQuadrature<3>;

}  // namespace wheelwright
