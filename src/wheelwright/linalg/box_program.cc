#include "wheelwright/linalg/box_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace wheelwright {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double singular = 1e-11;  // pivots of a matrix with ones on its diagonal count as zero below this
constexpr double rounding = 1e-11;  // of a gradient, relative to its terms
constexpr int sweeps = 50;          // more than any program of a few unknowns needs

/// The same program in unknowns for which the diagonal of Q is one, or zero.
struct Scaled {
  BoxProgram program;
  std::vector<double> unit;  ///< x = unit * (scaled x)
};

Scaled scaled(const BoxProgram& given) {
  const int n = static_cast<int>(given.linear.size());
  Scaled result{given, std::vector<double>(n, 1.0)};
  for (int i = 0; i < n; ++i)
    if (given.quadratic(i, i) > 0) result.unit[i] = 1 / std::sqrt(given.quadratic(i, i));
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) result.program.quadratic(i, j) *= result.unit[i] * result.unit[j];
    result.program.linear[i] *= result.unit[i];
    result.program.lower[i] /= result.unit[i];
    result.program.upper[i] /= result.unit[i];
  }
  return result;
}

std::vector<double> gradient(const BoxProgram& p, const std::vector<double>& x) {
  std::vector<double> g = p.linear;
  for (size_t i = 0; i < g.size(); ++i)
    for (size_t j = 0; j < g.size(); ++j)
      g[i] += p.quadratic(static_cast<int>(i), static_cast<int>(j)) * x[j];
  return g;
}

/// The rounding error of the gradient.
std::vector<double> uncertainty(const BoxProgram& p, const std::vector<double>& x) {
  std::vector<double> u(x.size());
  double largest = 0;
  for (size_t i = 0; i < u.size(); ++i) {
    u[i] = std::abs(p.linear[i]);
    for (size_t j = 0; j < u.size(); ++j)
      u[i] += std::abs(p.quadratic(static_cast<int>(i), static_cast<int>(j)) * x[j]);
    largest = std::max(largest, u[i]);
  }
  for (double& value : u) value = rounding * std::max(value, 1e-3 * largest);
  return u;
}

/// The pivoted Cholesky factor of the free block of Q: as many unknowns as it has rank.
class FreeBlock {
 public:
  FreeBlock(const Matrix& q, const std::vector<int>& free) : q_(q), others_(free) {
    std::vector<double> diagonal;
    for (const int i : free) diagonal.push_back(q(i, i));
    while (!others_.empty()) {
      const auto largest = std::ranges::max_element(diagonal) - diagonal.begin();
      if (!(diagonal[largest] > singular)) return;
      add_pivot(others_[largest]);
      others_.erase(others_.begin() + largest);
      diagonal.erase(diagonal.begin() + largest);
      for (size_t k = 0; k < others_.size(); ++k) {
        const double entry = row_of(others_[k]).back();
        diagonal[k] -= entry * entry;
      }
    }
  }

  /// Solves the equations of the pivots for their unknowns.
  std::vector<double> solve(std::vector<double> b) const {
    for (size_t i = 0; i < pivots_.size(); ++i) {
      for (size_t j = 0; j < i; ++j) b[i] -= factor_[i][j] * b[j];
      b[i] /= factor_[i][i];
    }
    for (size_t i = pivots_.size(); i-- > 0;) {
      for (size_t j = i + 1; j < pivots_.size(); ++j) b[i] -= factor_[j][i] * b[j];
      b[i] /= factor_[i][i];
    }
    return b;
  }

  const std::vector<int>& pivots() const { return pivots_; }
  const std::vector<int>& others() const { return others_; }  ///< linearly dependent on the pivots

 private:
  /// The row of the factor that belongs to unknown i.
  std::vector<double> row_of(int i) const {
    std::vector<double> row;
    for (size_t k = 0; k < pivots_.size(); ++k) {
      double entry = q_(i, pivots_[k]);
      for (size_t j = 0; j < k; ++j) entry -= row[j] * factor_[k][j];
      row.push_back(entry / factor_[k][k]);
    }
    return row;
  }

  void add_pivot(int i) {
    auto row = row_of(i);
    double square = q_(i, i);
    for (const double entry : row) square -= entry * entry;
    row.push_back(std::sqrt(square));
    pivots_.push_back(i);
    factor_.push_back(std::move(row));
  }

  const Matrix& q_;
  std::vector<int> pivots_, others_;
  std::vector<std::vector<double>> factor_;
};

struct Direction {
  std::vector<double> p;
  double length;  ///< the minimum along it is at x + length p: 1, or infinite
};

/// From x downhill in the free unknowns.
Direction direction(const BoxProgram& program, const std::vector<int>& free, const std::vector<double>& g,
                    const std::vector<double>& uncertain) {
  const Matrix& q = program.quadratic;
  const FreeBlock block(q, free);
  const auto spread = [&](const std::vector<double>& of_pivots) {
    std::vector<double> p(g.size(), 0.0);
    for (size_t k = 0; k < of_pivots.size(); ++k) p[block.pivots()[k]] = of_pivots[k];
    return p;
  };
  std::vector<double> right;
  for (const int i : block.pivots()) right.push_back(-g[i]);
  auto p = spread(block.solve(right));
  std::optional<int> steepest;
  double slope = 0;
  for (const int i : block.others()) {
    double left = g[i];
    for (const int j : block.pivots()) left += q(i, j) * p[j];
    if (std::abs(left) > uncertain[i] + singular * std::abs(g[i]) && std::abs(left) > std::abs(slope)) {
      steepest = i;
      slope = left;
    }
  }
  if (!steepest) return {std::move(p), 1};
  right.clear();
  for (const int j : block.pivots()) right.push_back(std::copysign(1.0, slope) * q(j, *steepest));
  p = spread(block.solve(right));
  p[*steepest] = -std::copysign(1.0, slope);
  return {std::move(p), infinite};
}

/// The unknown with the largest multiplier of the wrong sign.
std::optional<int> to_be_freed(const BoxProgram& program, const std::vector<bool>& is_free,
                               const std::vector<double>& x, const std::vector<double>& g,
                               const std::vector<double>& uncertain) {
  std::optional<int> best;
  double largest = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    if (is_free[i] || program.lower[i] == program.upper[i]) continue;
    const double downhill = x[i] == program.lower[i] ? -g[i] : g[i];
    if (downhill > std::max(largest, uncertain[i])) {
      largest = downhill;
      best = static_cast<int>(i);
    }
  }
  return best;
}

}  // namespace

BoxSolution solve(const BoxProgram& given) {
  const auto of_units = scaled(given);  // a lambda cannot capture a structured binding in all compilers
  const auto& program = of_units.program;
  const auto& unit = of_units.unit;
  const size_t n = program.linear.size();
  std::vector<double> x(n);
  std::vector<bool> is_free(n);
  for (size_t i = 0; i < n; ++i) {
    x[i] = std::clamp(0.0, program.lower[i], program.upper[i]);
    is_free[i] = x[i] != program.lower[i] && x[i] != program.upper[i];
  }
  const auto answer = [&](bool is_bounded) {
    for (size_t i = 0; i < n; ++i)
      x[i] = x[i] == program.lower[i]   ? given.lower[i]
             : x[i] == program.upper[i] ? given.upper[i]
                                        : std::clamp(x[i] * unit[i], given.lower[i], given.upper[i]);
    return BoxSolution{x, is_bounded};
  };
  for (size_t k = 0; k < sweeps * (n + 1); ++k) {
    const auto g = gradient(program, x);
    const auto uncertain = uncertainty(program, x);
    std::vector<int> free;
    for (size_t i = 0; i < n; ++i)
      if (is_free[i]) free.push_back(static_cast<int>(i));
    const auto [p, length] = direction(program, free, g, uncertain);
    double step = length;
    std::optional<int> blocking;
    for (const int i : free) {
      const double room = p[i] > 0 ? program.upper[i] - x[i] : p[i] < 0 ? x[i] - program.lower[i] : infinite;
      if (room < step * std::abs(p[i])) {
        step = room / std::abs(p[i]);
        blocking = i;
      }
    }
    if (std::isinf(step)) return answer(false);
    for (const int i : free) x[i] = std::clamp(x[i] + step * p[i], program.lower[i], program.upper[i]);
    if (blocking) {
      x[*blocking] = p[*blocking] > 0 ? program.upper[*blocking] : program.lower[*blocking];
      is_free[*blocking] = false;
      continue;
    }
    const auto freed = to_be_freed(program, is_free, x, gradient(program, x), uncertainty(program, x));
    if (!freed) return answer(true);
    is_free[*freed] = true;
  }
  return answer(true);
}

double residual(const BoxProgram& given, const std::vector<double>& x) {
  const auto of_units = scaled(given);  // a lambda cannot capture a structured binding in all compilers
  const auto& program = of_units.program;
  const auto& unit = of_units.unit;
  std::vector<double> y(x.size());
  for (size_t i = 0; i < x.size(); ++i) y[i] = x[i] / unit[i];
  const auto g = gradient(program, y);
  double largest = 0;
  for (size_t i = 0; i < x.size(); ++i)
    largest = std::max(largest, std::abs(y[i] - std::clamp(y[i] - g[i], program.lower[i], program.upper[i])));
  return largest;
}

}  // namespace wheelwright
