#include "wheelwright/mechanics/contact/contact_newton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/mechanics/contact/newton_tangent.h"

namespace wheelwright {
namespace {

constexpr double tolerance = 1e-12, balance_tolerance = 1e-11;
constexpr int max_iterations = 400;

/// Number of full steps accepted although they do not reduce the number of changing points.
constexpr int patience = 8;

template <int dim>
ContactUnknowns<dim> difference(const ContactUnknowns<dim>& x, const ContactUnknowns<dim>& step) {
  ContactUnknowns<dim> result = x;
  for (size_t i = 0; i < x.augmented.size(); ++i)
    for (int d = 0; d < dim; ++d) result.augmented[i][d] -= step.augmented[i][d];
  for (size_t k = 0; k < x.rim.size(); ++k) result.rim[k] -= step.rim[k];
  return result;
}

/// The norm of residuals: balances of force are converted to a pressure on the contact of the initial guess.
template <int dim>
class ResidualNorm {
 public:
  ResidualNorm(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& start) {
    double force = 0, largest_gamma = 0;
    for (int i = 0; i < contact.n_points(); ++i) {
      const double p = negative_part(start.augmented[i][0]);
      pressure_ = std::max(pressure_, p);
      force += contact.points()[i].weight * p;
      largest_gamma = std::max(largest_gamma, contact.points()[i].gamma);
    }
    scale_ = std::max(pressure_, largest_gamma * contact.amplitude(contact.rim().prescribed));
    for (const FreeMotion& motion : contact.rim().free) {
      const double amplitude = contact.amplitude(motion.direction);
      balance_.push_back(pressure_ / (force * amplitude));
      stiffness_.push_back(largest_gamma * amplitude);
    }
  }

  double operator()(const ContactUnknowns<dim>& residual) const {
    return std::hypot(of_tractions(residual), of_balance(residual));
  }

  /// Whether only rounding errors are left.
  bool vanishes(const ContactUnknowns<dim>& residual, const ContactUnknowns<dim>& x) const {
    double scale = scale_;
    for (size_t k = 0; k < balance_.size(); ++k) scale = std::max(scale, stiffness_[k] * std::abs(x.rim[k]));
    double sum = 0;
    for (size_t i = 0; i < x.augmented.size(); ++i) {
      const double size = std::max(scale, norm<dim>(x.augmented[i]));
      sum += dot<dim>(residual.augmented[i], residual.augmented[i]) / (size * size);
    }
    return std::sqrt(sum) <= tolerance * std::sqrt(double(x.augmented.size())) &&
           of_balance(residual) <= balance_tolerance * pressure_;
  }

 private:
  double of_tractions(const ContactUnknowns<dim>& residual) const {
    double sum = 0;
    for (const Vec<dim>& r : residual.augmented) sum += dot<dim>(r, r);
    return std::sqrt(sum);
  }

  double of_balance(const ContactUnknowns<dim>& residual) const {
    double sum = 0;
    for (size_t k = 0; k < balance_.size(); ++k) sum += std::pow(balance_[k] * residual.rim[k], 2);
    return std::sqrt(sum);
  }

  double pressure_ = 0, scale_ = 0;
  std::vector<double> balance_, stiffness_;
};

/// Whether a step reversed the sliding direction of a point.
template <int dim>
bool turned(const ReducedContact<dim>& contact, int point, const Vec<dim>& before, const Vec<dim>& after) {
  return contact.status(point, before).slides && contact.status(point, after).slides &&
         tangential_dot<dim>(before, after) < 0;
}

/// The points whose contact status differs between two iterates.
template <int dim>
std::vector<int> changed_points(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& a,
                                const ContactUnknowns<dim>& b) {
  std::vector<int> changed;
  for (int i = 0; i < contact.n_points(); ++i) {
    const Vec<dim>&before = a.augmented[i], &after = b.augmented[i];
    if (turned<dim>(contact, i, before, after) || contact.status(i, before) != contact.status(i, after))
      changed.push_back(i);
  }
  return changed;
}

/// The resistance to a slow motion of the rim along the ground if all contact points slide: the sum of the
/// normal forces times 1 - s s^T, with s the direction of a point's friction, by their sum.
template <int dim>
Mat<dim> resistance_of_sliding(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x) {
  Mat<dim> sum{};
  double total = 0;
  for (int i = 0; i < contact.n_points(); ++i) {
    const Vec<dim>& z = x.augmented[i];
    if (z[0] >= 0) continue;
    const double force = -z[0] * contact.points()[i].weight, length = tangential_norm<dim>(z);
    total += force;
    for (int a = 1; a < dim; ++a)
      for (int b = 1; b < dim; ++b) sum[a][b] += force * ((a == b) - z[a] * z[b] / (length * length));
  }
  for (auto& row : sum)
    for (double& entry : row) entry /= total;
  return sum;
}

/// Whether friction must hold the rim, but no contact point sticks, and all slide along the same line: then
/// nothing resists a motion along it.
template <int dim>
bool slides(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x) {
  bool along = false, across = false;
  for (const FreeMotion& motion : contact.rim().free) {
    along = along || motion.direction.along_ground != 0 || motion.direction.rotation != 0;
    across = across || motion.direction.along_axle != 0;
  }
  if (!along && !across) return false;
  for (int i = 0; i < contact.n_points(); ++i)
    if (const auto status = contact.status(i, x.augmented[i]); status.touches && !status.slides) return false;
  if constexpr (dim == 3) {
    constexpr double negligible = 1e-4;
    const Mat<3> r = resistance_of_sliding(contact, x);
    const double smaller = 0.5 * (r[1][1] + r[2][2]) - std::hypot(0.5 * (r[1][1] - r[2][2]), r[1][2]);
    return (along && across ? smaller : along ? r[1][1] : r[2][2]) < negligible;
  }
  return true;
}

template <int dim>
void stick(Vec<dim>& z) {
  std::fill(z.begin() + 1, z.end(), 0.0);
}

/// The tangential traction that a sliding point lacks to stick.
template <int dim>
double lack_of_friction(const ReducedContact<dim>& contact, int point, const Vec<dim>& z) {
  return tangential_norm<dim>(z) - tangential_norm<dim>(contact.response(point, z).traction);
}

/// If every contact point of x slides, the tangent is singular: makes the point closest to sticking stick. A
/// point that stuck in the previous iterate and was torn off keeps sliding if another one that slides against
/// it can replace it.
template <int dim>
void stick_one(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& before,
               ContactUnknowns<dim>& x) {
  const auto stuck = [&](int i) {
    const auto status = contact.status(i, before.augmented[i]);
    return status.touches && !status.slides;
  };
  Vec<dim> torn_off{};
  for (int i = 0; i < contact.n_points(); ++i)
    if (stuck(i) && contact.status(i, x.augmented[i]).slides)
      for (int d = 0; d < dim; ++d) torn_off[d] += x.augmented[i][d];
  int chosen = -1;
  std::pair<bool, double> best{true, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < contact.n_points(); ++i) {
    const Vec<dim>& z = x.augmented[i];
    const auto status = contact.status(i, z);
    if (!status.touches || !status.slides) continue;
    const std::pair<bool, double> rank{stuck(i) || tangential_dot<dim>(z, torn_off) > 0,
                                       lack_of_friction<dim>(contact, i, z)};
    if (rank >= best) continue;
    best = rank;
    chosen = i;
  }
  if (chosen >= 0) stick<dim>(x.augmented[chosen]);
}

/// Makes points stick if a step reversed their sliding direction: in between they come to rest.
template <int dim>
void stick_turned(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& before,
                  ContactUnknowns<dim>& x) {
  for (int i = 0; i < contact.n_points(); ++i)
    if (turned<dim>(contact, i, before.augmented[i], x.augmented[i])) stick<dim>(x.augmented[i]);
}

/// Takes back all changes but the last n.
template <int dim>
void keep_all_but(const std::vector<int>& changed, size_t n, const ContactUnknowns<dim>& before,
                  ContactUnknowns<dim>& x) {
  for (size_t k = 0; k + n < changed.size(); ++k) x.augmented[changed[k]] = before.augmented[changed[k]];
}

}  // namespace

template <int dim>
bool touches(const ContactUnknowns<dim>& x) {
  return std::any_of(x.augmented.begin(), x.augmented.end(), [](const Vec<dim>& z) { return z[0] < 0; });
}

template <int dim>
ContactUnknowns<dim> sticking_somewhere(const ReducedContact<dim>& contact, ContactUnknowns<dim> x) {
  if (slides(contact, x)) stick_one(contact, ContactUnknowns<dim>(x), x);
  return x;
}

template <int dim>
NewtonEnd<dim> newton(const ReducedContact<dim>& contact, ContactUnknowns<dim> start, Cycling when_cycling,
                      const Interrupt& interrupt, int steps_before) {
  NewtonEnd<dim> end{std::move(start)};
  if (!touches(end.x)) {
    end.x.augmented = contact.without_contact(end.x.rim);
    end.converged = !touches(end.x) && contact.rim().free.empty();
    if (!touches(end.x)) return end;
  }
  end.x = sticking_somewhere(contact, std::move(end.x));
  const ResidualNorm<dim> norm(contact, end.x);
  size_t fewest_changes = end.x.augmented.size() + 1;
  int without_progress = 0;
  NewtonTangent<dim> tangent(contact);
  while (end.iterations < max_iterations && !interrupt.requested()) {
    interrupt.report({0, 1, steps_before + end.iterations});
    const auto step = tangent.step(end.x, contact.residual(end.x));
    if (!step) return end;
    ++end.iterations;
    ContactUnknowns<dim> next = difference(end.x, *step);
    const ContactUnknowns<dim> residual = contact.residual(next);
    end.residual = norm(residual);
    end.converged = norm.vanishes(residual, next);
    if (end.converged) end.x = std::move(next);
    if (end.converged || !std::isfinite(end.residual)) return end;
    stick_turned<dim>(contact, end.x, next);
    if (slides(contact, next)) stick_one(contact, end.x, next);

    const auto changed = changed_points(contact, end.x, next);
    if (changed.size() < fewest_changes) {
      fewest_changes = changed.size();
      without_progress = 0;
    } else if (++without_progress > patience) {
      if (when_cycling == Cycling::give_up) return end;
      keep_all_but(changed, std::max<size_t>(1, changed.size() >> (without_progress / patience)), end.x,
                   next);
    }
    end.x = std::move(next);
  }
  return end;
}

template <int dim>
NewtonEnd<dim> without_rounding_errors(const ReducedContact<dim>& contact, ContactUnknowns<dim> x) {
  constexpr int most_steps = 2;
  NewtonEnd<dim> end{std::move(x)};
  const ResidualNorm<dim> norm(contact, end.x);
  NewtonTangent<dim> tangent(contact);
  while (end.iterations < most_steps && !end.converged) {
    const auto step = tangent.step(end.x, contact.residual(end.x));
    if (!step) return end;
    end.x = difference(end.x, *step);
    ++end.iterations;
    const auto residual = contact.residual(end.x);
    end.residual = norm(residual);
    end.converged = norm.vanishes(residual, end.x);
  }
  return end;
}

template <int dim>
Expected<ContactState<dim>> solve_linear(const ReducedContact<dim>& contact) {
  constexpr int solves = 2;
  ContactUnknowns<dim> x = zero_start(contact);
  NewtonTangent<dim> tangent(contact);
  for (int k = 0; k < solves; ++k) {
    const auto step = tangent.step(x, contact.residual(x));
    if (!step) return Failure{FailureReason::rim_under_ground, "the rim would leave the rigid ring"};
    x = difference(x, *step);
  }
  const ResidualNorm<dim> norm(contact, x);
  const auto residual = contact.residual(x);
  if (norm.vanishes(residual, x)) return contact.state(x, solves);
  return Failure{FailureReason::inaccurate_solution,
                 fmt::format("linear contact: residual {:.3g} Pa", norm(residual))};
}

template decltype(touches<2>) touches<2>;
template decltype(sticking_somewhere<2>) sticking_somewhere<2>;
template decltype(without_rounding_errors<2>) without_rounding_errors<2>;
template decltype(newton<2>) newton<2>;
template decltype(solve_linear<2>) solve_linear<2>;
template decltype(touches<3>) touches<3>;
template decltype(sticking_somewhere<3>) sticking_somewhere<3>;
template decltype(without_rounding_errors<3>) without_rounding_errors<3>;
template decltype(newton<3>) newton<3>;
template decltype(solve_linear<3>) solve_linear<3>;

}  // namespace wheelwright
