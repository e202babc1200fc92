#include "wheelwright/contact/contact_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheelwright/contact/contact_path.h"
#include "wheelwright/contact/newton_tangent.h"

namespace wheelwright {
namespace {

constexpr double tolerance = 1e-12, balance_tolerance = 1e-11;
constexpr int max_iterations = 400;

/// Full steps that are taken although they do not lower the number of points that change.
constexpr int patience = 8;

/// The last iterate of Newton's method.
template <int dim>
struct NewtonEnd {
  ContactUnknowns<dim> x;
  int iterations = 0;
  double residual = 0;  ///< [Pa]
  bool converged = false;
};

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

template <int dim>
bool touches(const ContactUnknowns<dim>& x) {
  return std::any_of(x.augmented.begin(), x.augmented.end(), [](const Vec<dim>& z) { return z[0] < 0; });
}

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

/// Whether friction must hold the rim although no touching point sticks.
template <int dim>
bool slides(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x) {
  const auto& free = contact.rim().free;
  if (std::none_of(free.begin(), free.end(), [](const FreeMotion& motion) {
        return motion.direction.along_ground != 0 || motion.direction.rotation != 0;
      }))
    return false;
  for (int i = 0; i < contact.n_points(); ++i)
    if (const auto status = contact.status(i, x.augmented[i]); status.touches && !status.slides) return false;
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

/// Where every touching point of x slides, the tangent is singular: makes the one stick that lacks least. A
/// point that stuck in the iterate before and is torn off keeps sliding if another can take over, one that
/// slides against it.
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

/// Makes the points stick whose sliding direction a step reversed: between the two directions they come to
/// rest.
template <int dim>
void stick_turned(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& before,
                  ContactUnknowns<dim>& x) {
  for (int i = 0; i < contact.n_points(); ++i)
    if (turned<dim>(contact, i, before.augmented[i], x.augmented[i])) stick<dim>(x.augmented[i]);
}

/// What Newton's method does when full steps no longer lower the number of points that change.
enum class Cycling { give_up, change_fewer };

/// Takes back all changes but the last n.
template <int dim>
void keep_all_but(const std::vector<int>& changed, size_t n, const ContactUnknowns<dim>& before,
                  ContactUnknowns<dim>& x) {
  for (size_t k = 0; k + n < changed.size(); ++k) x.augmented[changed[k]] = before.augmented[changed[k]];
}

template <int dim>
NewtonEnd<dim> newton(const ReducedContact<dim>& contact, ContactUnknowns<dim> start, Cycling when_cycling,
                      const Interrupt& interrupt, int steps_before = 0) {
  NewtonEnd<dim> end{std::move(start)};
  if (!touches(end.x)) {
    end.x.augmented = contact.without_contact(end.x.rim);
    end.converged = !touches(end.x) && contact.rim().free.empty();
    if (!touches(end.x)) return end;
  }
  if (slides(contact, end.x)) stick_one(contact, ContactUnknowns<dim>(end.x), end.x);
  const ResidualNorm<dim> norm(contact, end.x);
  size_t fewest_changes = end.x.augmented.size() + 1;
  int without_progress = 0;
  NewtonTangent<dim> tangent(contact);
  while (end.iterations < max_iterations && !interrupt.requested()) {
    interrupt.tell({0, 1, steps_before + end.iterations});
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

/// The thresholds of Coulomb's law for the pressures of x.
template <int dim>
std::vector<double> thresholds(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x) {
  std::vector<double> result;
  for (const Vec<dim>& z : x.augmented) result.push_back(contact.friction() * negative_part(z[0]));
  return result;
}

/// Coulomb's friction as a sequence of problems with given friction: each takes its thresholds from the
/// pressures of the one before, until Newton's method for Coulomb's law itself converges from there.
template <int dim>
NewtonEnd<dim> newton_by_given_friction(const ReducedContact<dim>& contact, ContactUnknowns<dim> start,
                                        const Interrupt& interrupt) {
  constexpr int max_problems = 60;
  NewtonEnd<dim> end{std::move(start)};
  std::vector<double> given = thresholds(contact, end.x);
  for (int k = 0; k < max_problems && !end.converged && !interrupt.requested(); ++k) {
    auto solved =
        newton(contact.with_given_friction(given), end.x, Cycling::change_fewer, interrupt, end.iterations);
    solved.iterations += end.iterations;
    if (!solved.converged) return {std::move(solved.x), solved.iterations, solved.residual, false};
    given = thresholds(contact, solved.x);
    end = newton(contact, solved.x, Cycling::give_up, interrupt, solved.iterations);
    end.iterations += solved.iterations;
    if (!end.converged) end.x = std::move(solved.x);
  }
  return end;
}

/// A path from x, and Newton's method from where it ends, which removes its rounding errors.
NewtonEnd<2> newton_by_path(const ReducedContact<2>& contact, const ContactUnknowns<2>& x,
                            const Interrupt& interrupt, int steps_before) {
  const PathEnd<2> path = follow_path(contact, x, interrupt, steps_before);
  NewtonEnd<2> end = newton(contact, path.x, Cycling::give_up, interrupt, steps_before + path.turns);
  end.iterations += path.turns;
  return end;
}

/// Coulomb's friction in the plane: where Newton's method cycles, a path leads on from its last iterate, and
/// if none of these arrives, from one of the starts.
NewtonEnd<2> solve_with_friction(const ReducedContact<2>& contact, std::span<const ContactUnknowns<2>> starts,
                                 const Interrupt& interrupt) {
  NewtonEnd<2> end;
  int iterations = 0;
  const auto goes_on = [&] { return !end.converged && !interrupt.requested(); };
  for (const ContactUnknowns<2>& start : starts) {
    if (goes_on()) {
      end = newton(contact, contact.touching(start), Cycling::give_up, interrupt, iterations);
      iterations += end.iterations;
    }
    if (goes_on()) {
      end = newton_by_path(contact, end.x, interrupt, iterations);
      iterations += end.iterations;
    }
  }
  for (const ContactUnknowns<2>& start : starts)
    if (goes_on()) {
      end = newton_by_path(contact, contact.touching(start), interrupt, iterations);
      iterations += end.iterations;
    }
  end.iterations = iterations;
  return end;
}

/// Newton's method from each start until one leads to a solution.
template <int dim>
NewtonEnd<dim> newton_from_each(const ReducedContact<dim>& contact,
                                std::span<const ContactUnknowns<dim>> starts, Cycling when_cycling,
                                const Interrupt& interrupt) {
  NewtonEnd<dim> end;
  int iterations = 0;
  for (const ContactUnknowns<dim>& start : starts) {
    if (end.converged || interrupt.requested()) break;
    end = newton(contact, contact.touching(start), when_cycling, interrupt, iterations);
    iterations += end.iterations;
  }
  end.iterations = iterations;
  return end;
}

/// Coulomb's friction in space, where its cone is round.
NewtonEnd<3> solve_with_friction(const ReducedContact<3>& contact, std::span<const ContactUnknowns<3>> starts,
                                 const Interrupt& interrupt) {
  NewtonEnd<3> end = newton_from_each(contact, starts, Cycling::give_up, interrupt);
  if (end.converged || interrupt.requested()) return end;
  const int iterations = end.iterations;
  end = newton_by_given_friction(contact, contact.touching(starts.back()), interrupt);
  end.iterations += iterations;
  return end;
}

/// A bonded tread: one linear solve, and another one that lowers its rounding errors.
template <int dim>
Expected<ContactState<dim>> solve_bonded(const ReducedContact<dim>& contact) {
  constexpr int solves = 2;
  ContactUnknowns<dim> x = contact.zero_start();
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
                 fmt::format("bonded tread: residual {:.3g} Pa", norm(residual))};
}

}  // namespace

template <int dim>
Expected<ContactState<dim>> solve_contact(const ReducedContact<dim>& contact,
                                          std::span<const ContactUnknowns<dim>> starts,
                                          const Interrupt& interrupt) {
  if (contact.is_bonded()) return solve_bonded(contact);
  const NewtonEnd<dim> end = contact.friction() > 0
                                 ? solve_with_friction(contact, starts, interrupt)
                                 : newton_from_each(contact, starts, Cycling::change_fewer, interrupt);
  if (end.converged) return contact.state(end.x, end.iterations);
  if (interrupt.requested()) return Failure{FailureReason::interrupted, "while the contact was solved"};
  if (!touches(end.x))
    return Failure{FailureReason::no_contact, "the other loads lift the wheel off the ground"};
  return Failure{FailureReason::newton_stalled,
                 fmt::format("contact: residual {:.3g} Pa after {} iterations from {} starts, {} points{}",
                             end.residual, end.iterations, starts.size(), contact.n_points(),
                             slides(contact, end.x) ? ", and all touching ones slide" : "")};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                  \
  template Expected<ContactState<dim>> solve_contact( \
      const ReducedContact<dim>&, std::span<const ContactUnknowns<dim>>, const Interrupt&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
