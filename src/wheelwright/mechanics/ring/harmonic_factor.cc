#include "wheelwright/mechanics/ring/harmonic_factor.h"

#include <algorithm>
#include <type_traits>

namespace wheelwright {
namespace {

/// The real parts of the columns and, if asked for, then the imaginary ones.
Matrix parts_of(const ComplexMatrix& x, bool imaginary_too) {
  auto result = Matrix::unfilled(x.rows(), (imaginary_too ? 2 : 1) * x.columns());
  const size_t n = x.entries().size();
  for (size_t k = 0; k < n; ++k) result.entries()[k] = x.entries()[k].real();
  if (imaginary_too)
    for (size_t k = 0; k < n; ++k) result.entries()[n + k] = x.entries()[k].imag();
  return result;
}

void set_parts(const Matrix& parts, ComplexMatrix& x) {
  const size_t n = x.entries().size();
  const bool imaginary_too = parts.entries().size() > n;
  for (size_t k = 0; k < n; ++k)
    x.entries()[k] = {parts.entries()[k], imaginary_too ? parts.entries()[n + k] : 0};
}

bool is_zero(const ComplexMatrix& x) {
  return std::ranges::all_of(x.entries(), [](const auto& value) { return value == 0.0; });
}

}  // namespace

HarmonicFactor::HarmonicFactor(std::shared_ptr<const BoundarySymmetry> symmetry,
                               SparseTwoBlockCholesky factor, MirrorBasis basis)
    : symmetry_(std::move(symmetry)) {
  parts_.push_back({std::move(factor), std::move(basis)});
}

void HarmonicFactor::apply(const Part& part, Step step, int n_interface, ComplexMatrix& x) {
  const auto solve = [&](const auto& factor, auto& values) {
    if (step == Step::eliminate) factor.eliminate(values);
    if (step == Step::solve_last) factor.solve_last(values);
    if (step == Step::substitute) factor.substitute(values);
  };
  const int n = n_interface + (step == Step::solve_last ? x.rows() : x.rows() - n_interface);
  const int first_before = step == Step::eliminate ? 0 : n_interface,
            first_after = step == Step::substitute ? 0 : n_interface;
  if (part.basis) part.basis->to_coordinates(first_before, n, x);
  const auto solve_for = [&](const auto& factor) {
    if constexpr (std::is_same_v<std::decay_t<decltype(factor)>, TwoBlockCholesky<std::complex<double>>>) {
      solve(factor, x);
    } else {
      Matrix values = parts_of(x, part.basis.has_value());
      solve(factor, values);
      set_parts(values, x);
    }
  };
  std::visit(solve_for, part.factor);
  if (part.basis) part.basis->from_coordinates(first_after, n, x);
}

void HarmonicFactor::apply(Step step, Rows rows, ComplexMatrix& x) const {
  const BoundarySymmetry& symmetry = *symmetry_;
  if (!symmetry.width) return apply(parts_.front(), step, symmetry.n_interface, x);
  const int skipped = rows == Rows::outer ? symmetry.n_interface : 0, n = skipped + x.rows();
  to_even_and_odd(*symmetry.width, step == Step::eliminate ? 0 : symmetry.n_interface, n, x);
  for (size_t p = 0; p < parts_.size(); ++p) {
    const SymmetryClass& of_class = symmetry.classes[p];
    const int first = rows == Rows::outer ? of_class.n_interface() : 0;
    auto values = ComplexMatrix::unfilled(of_class.size() - first, x.columns());
    for (int j = 0; j < x.columns(); ++j)
      for (int k = first; k < of_class.size(); ++k) values(k - first, j) = x(of_class.place(k) - skipped, j);
    if (is_zero(values)) continue;
    apply(parts_[p], step, of_class.n_interface(), values);
    for (int j = 0; j < x.columns(); ++j)
      for (int k = first; k < of_class.size(); ++k) x(of_class.place(k) - skipped, j) = values(k - first, j);
  }
  from_even_and_odd(*symmetry.width, step == Step::substitute ? 0 : symmetry.n_interface, n, x);
}

namespace {

ComplexMatrix complex(const Matrix& a) {
  auto result = ComplexMatrix::unfilled(a.rows(), a.columns());
  std::copy(a.entries().begin(), a.entries().end(), result.entries().begin());
  return result;
}
ComplexMatrix complex(ComplexMatrix a) { return a; }

/// B a B^H for a Hermitian a, where `apply` replaces the columns x of a matrix by B x.
template <class Apply>
ComplexMatrix congruent(ComplexMatrix a, Apply apply) {
  apply(a);
  ComplexMatrix result = adjoint(a);
  apply(result);
  return result;
}

}  // namespace

ComplexMatrix HarmonicFactor::outer_compliance(const Part& part, int n_interface) {
  ComplexMatrix inverse =
      std::visit([](const auto& factor) { return complex(factor.last_inverse()); }, part.factor);
  if (!part.basis) return inverse;
  const int n = n_interface + inverse.rows();
  return congruent(std::move(inverse),
                   [&](ComplexMatrix& x) { part.basis->from_coordinates(n_interface, n, x); });
}

ComplexMatrix HarmonicFactor::outer_compliance() const {
  const BoundarySymmetry& symmetry = *symmetry_;
  if (!symmetry.width) return outer_compliance(parts_.front(), symmetry.n_interface);
  const int n = static_cast<int>(symmetry.width->unknowns.size()), n_outer = n - symmetry.n_interface;
  ComplexMatrix result(n_outer, n_outer);
  for (size_t p = 0; p < parts_.size(); ++p) {
    const SymmetryClass& of_class = symmetry.classes[p];
    const ComplexMatrix own = outer_compliance(parts_[p], of_class.n_interface());
    const auto place = [&](int k) {
      return of_class.place(of_class.n_interface() + k) - symmetry.n_interface;
    };
    for (int j = 0; j < own.columns(); ++j)
      for (int i = 0; i < own.rows(); ++i) result(place(i), place(j)) = own(i, j);
  }
  return congruent(std::move(result),
                   [&](ComplexMatrix& x) { from_even_and_odd(*symmetry.width, symmetry.n_interface, n, x); });
}

void HarmonicFactor::eliminate(ComplexMatrix& loads) const { apply(Step::eliminate, Rows::all, loads); }

void HarmonicFactor::solve_last(ComplexMatrix& loads) const { apply(Step::solve_last, Rows::outer, loads); }

void HarmonicFactor::substitute(ComplexMatrix& x) const { apply(Step::substitute, Rows::all, x); }

}  // namespace wheelwright
