#include "wheelwright/contact/contact_solver.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

constexpr double tolerance = 1e-12, balance_tolerance = 1e-11;
constexpr int max_residual_halvings = 5, max_contact_set_halvings = 30;

/// The criterion that shortens a Newton step.
enum class Damping {
  residual,     ///< it must lower the residual
  contact_set,  ///< at most a quarter of the touching points may change between open, sticking and sliding
};

/// The last iterate of Newton's method.
template <int dim>
struct NewtonEnd {
  ContactUnknowns<dim> x;
  int iterations = 0;
  double residual = 0;  ///< [Pa]
  bool converged = false;
};

template <int dim>
ContactUnknowns<dim> moved(const ContactUnknowns<dim>& x, double length, const ContactUnknowns<dim>& step) {
  ContactUnknowns<dim> result = x;
  for (size_t i = 0; i < x.augmented.size(); ++i)
    for (int d = 0; d < dim; ++d) result.augmented[i][d] -= length * step.augmented[i][d];
  for (size_t k = 0; k < x.rim.size(); ++k) result.rim[k] -= length * step.rim[k];
  return result;
}

template <int dim>
bool touches(const ContactUnknowns<dim>& x) {
  return std::any_of(x.augmented.begin(), x.augmented.end(), [](const Vec<dim>& z) { return z[0] < 0; });
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
    return of_tractions(residual) <= tolerance * std::sqrt(double(x.augmented.size())) * scale &&
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
bool turned(const Vec<dim>& before, const Vec<dim>& after, double friction) {
  return contact_status<dim>(before, friction) == ContactStatus::slides &&
         contact_status<dim>(after, friction) == ContactStatus::slides &&
         tangential_dot<dim>(before, after) < 0;
}

template <int dim>
int changed_points(const ContactUnknowns<dim>& a, const ContactUnknowns<dim>& b, double friction) {
  int changed = 0;
  for (size_t i = 0; i < a.augmented.size(); ++i) {
    const Vec<dim>&before = a.augmented[i], &after = b.augmented[i];
    changed += turned<dim>(before, after, friction) ||
               contact_status<dim>(before, friction) != contact_status<dim>(after, friction);
  }
  return changed;
}

template <int dim>
int changes_allowed(const ContactUnknowns<dim>& x) {
  const auto touching =
      std::count_if(x.augmented.begin(), x.augmented.end(), [](const Vec<dim>& z) { return z[0] < 0; });
  return std::max(1, static_cast<int>(touching) / 4);
}

/// The step, shortened until it changes the contact status of few points.
template <int dim>
ContactUnknowns<dim> contact_set_search(const ContactUnknowns<dim>& x, const ContactUnknowns<dim>& step,
                                        double friction) {
  const int allowed = changes_allowed(x);
  double length = 1;
  ContactUnknowns<dim> trial = moved(x, length, step);
  for (int k = 0; k < max_contact_set_halvings && changed_points(x, trial, friction) > allowed; ++k)
    trial = moved(x, length /= 2, step);
  return trial;
}

/// The step, shortened until it lowers the residual, or the last one tried.
template <int dim>
ContactUnknowns<dim> residual_search(const ReducedContact<dim>& contact, const ResidualNorm<dim>& norm,
                                     double fraction, double residual, const ContactUnknowns<dim>& x,
                                     const ContactUnknowns<dim>& step) {
  double length = 1;
  ContactUnknowns<dim> trial = moved(x, length, step);
  for (int k = 0; k < max_residual_halvings && !(norm(contact.residual(trial, fraction)) < residual); ++k)
    trial = moved(x, length /= 2, step);
  return trial;
}

/// Whether every touching point slides in the same direction although friction must hold the rim.
template <int dim>
bool slides(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x) {
  const auto& free = contact.rim().free;
  if (std::none_of(free.begin(), free.end(), [](const FreeMotion& motion) {
        return motion.direction.along_ground != 0 || motion.direction.rotation != 0;
      }))
    return false;
  const Vec<dim>* first = nullptr;
  for (const Vec<dim>& z : x.augmented) {
    const ContactStatus status = contact_status<dim>(z, contact.friction());
    if (status == ContactStatus::sticks) return false;
    if (status == ContactStatus::open) continue;
    if (!first) first = &z;
    if (tangential_dot<dim>(z, *first) < 0) return false;
  }
  return first;
}

template <int dim>
void stick(Vec<dim>& z) {
  std::fill(z.begin() + 1, z.end(), 0.0);
}

/// Makes every touching point stick, where the tangent is singular because all points slide.
template <int dim>
void stick_all(ContactUnknowns<dim>& x) {
  for (Vec<dim>& z : x.augmented)
    if (z[0] < 0) stick<dim>(z);
}

/// Makes the points stick whose sliding direction a step reversed: between the two directions they come to
/// rest.
template <int dim>
void stick_turned(const ContactUnknowns<dim>& before, double friction, ContactUnknowns<dim>& x) {
  for (size_t i = 0; i < x.augmented.size(); ++i)
    if (turned<dim>(before.augmented[i], x.augmented[i], friction)) stick<dim>(x.augmented[i]);
}

template <int dim>
NewtonEnd<dim> newton(const ReducedContact<dim>& contact, ContactUnknowns<dim> start, double fraction,
                      Damping damping, const Interrupt& interrupt) {
  NewtonEnd<dim> end{std::move(start)};
  if (!touches(end.x)) return end;
  const ResidualNorm<dim> norm(contact, end.x);
  const int max_iterations = damping == Damping::residual ? 60 : 200;
  ContactUnknowns<dim> residual = contact.residual(end.x, fraction);
  end.residual = norm(residual);
  while (end.iterations < max_iterations && std::isfinite(end.residual) && !interrupt.requested()) {
    auto step = contact.newton_step(end.x, residual);
    if (!step) {
      stick_all(end.x);
      residual = contact.residual(end.x, fraction);
      end.residual = norm(residual);
      step = contact.newton_step(end.x, residual);
    }
    if (!step) return end;
    ++end.iterations;
    const ContactUnknowns<dim> before = std::move(end.x);
    end.x = damping == Damping::residual
                ? residual_search(contact, norm, fraction, end.residual, before, *step)
                : contact_set_search(before, *step, contact.friction());
    if (contact.friction() > 0) stick_turned(before, contact.friction(), end.x);
    if (slides(contact, end.x)) stick_all(end.x);
    residual = contact.residual(end.x, fraction);
    end.residual = norm(residual);
    end.converged = norm.vanishes(residual, end.x);
    if (end.converged) return end;
  }
  return end;
}

template <int dim>
NewtonEnd<dim> newton_in_load_steps(const ReducedContact<dim>& contact, const ColdStart<dim>& cold_start,
                                    int n_steps, const Interrupt& interrupt) {
  NewtonEnd<dim> end{cold_start(1.0 / n_steps)};
  int iterations = 0;
  for (int k = 1; k <= n_steps; ++k) {
    end = newton(contact, std::move(end.x), static_cast<double>(k) / n_steps, Damping::residual, interrupt);
    iterations += end.iterations;
    if (!end.converged) break;
  }
  end.iterations = iterations;
  return end;
}

template <int dim>
Failure no_contact(const ReducedContact<dim>& contact, const ContactUnknowns<dim>& x) {
  return {FailureReason::no_contact,
          fmt::format("no point touches the ground: the smallest gap is {:.4g} m", contact.smallest_gap(x))};
}

}  // namespace

template <int dim>
Expected<ContactState<dim>> solve_contact(const ReducedContact<dim>& contact,
                                          const ColdStart<dim>& cold_start,
                                          const std::optional<ContactUnknowns<dim>>& warm_start,
                                          const Interrupt& interrupt) {
  if (const auto start = cold_start(1); !touches(start)) return no_contact(contact, start);
  NewtonEnd<dim> end;
  std::vector<std::string> tried;
  int iterations = 0;
  const auto attempt = [&](std::string name, const auto& solve) {
    if (end.converged || interrupt.requested()) return;
    end = solve();
    tried.push_back(std::move(name));
    iterations += end.iterations;
  };
  if (warm_start)
    attempt("a neighbouring solution",
            [&] { return newton(contact, *warm_start, 1, Damping::residual, interrupt); });
  attempt("a cold start", [&] { return newton(contact, cold_start(1), 1, Damping::residual, interrupt); });
  attempt("a damped contact set",
          [&] { return newton(contact, cold_start(1), 1, Damping::contact_set, interrupt); });
  for (const int n_steps : {2, 4, 8})
    attempt(fmt::format("{} load steps", n_steps),
            [&] { return newton_in_load_steps(contact, cold_start, n_steps, interrupt); });

  if (end.converged && touches(end.x)) return contact.state(end.x, iterations);
  if (interrupt.requested()) return Failure{FailureReason::interrupted, "while the contact was solved"};
  if (!touches(end.x)) return no_contact(contact, end.x);
  return Failure{
      FailureReason::newton_stalled,
      fmt::format("contact: residual {:.3g} Pa after {} iterations, {} points{}; tried {}", end.residual,
                  iterations, contact.n_points(),
                  slides(contact, end.x) ? ", and every touching one slides" : "", fmt::join(tried, ", "))};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                    \
  template Expected<ContactState<dim>> solve_contact(const ReducedContact<dim>&, const ColdStart<dim>&, \
                                                     const std::optional<ContactUnknowns<dim>>&,        \
                                                     const Interrupt&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
