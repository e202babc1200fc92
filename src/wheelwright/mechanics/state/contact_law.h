#pragma once

#include <optional>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// The contact traction on the body and its tangent, in the ground frame: component 0 along n_y (into the
/// ground), the others tangential.
template <int dim>
struct ContactResponse {
  Vec<dim> traction;  ///< Phi(z)
  Mat<dim>
      tangent;  ///< d Phi_i / d z_j, including the dependence of the friction threshold on z_0: (56), (57)
};

/// The status of a point by its augmented traction: whether it touches, and whether its tangential traction
/// has reached the threshold.
struct ContactStatus {
  bool touches, slides;
  bool operator==(const ContactStatus&) const = default;
};

/// The law of contact: which traction acts on the tread at a point, by the augmented traction z = tau
/// sigma(u)n
/// - gamma (u - g n_y) of ContactForm. It is called by several threads at once. A program that uses the
/// library derives its own law and puts it into RollingModel::contact_law.
template <int dim>
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;

  /// Phi(z) and its whole derivative, in the ground frame. `point`: its number in the contact zone. Newton's
  /// matrix and the adjoint are made of the derivative: where it is not exact, gradients are wrong.
  virtual ContactResponse<dim> response(int point, const Vec<dim>& z) const = 0;

  /// Whether a point may carry traction; where it may not, response() is zero.
  virtual bool is_active(int /*point*/, const Vec<dim>& z) const { return z[0] < 0; }

  /// Which smooth piece of the law z is on: Newton's method limits the number of points that change it in a
  /// step.
  virtual ContactStatus status(int /*point*/, const Vec<dim>& z) const {
    return {.touches = z[0] < 0, .slides = false};
  }

  /// Whether there are tractions along the ground.
  virtual bool is_tangential() const = 0;

  /// Whether Phi(z) is a linear function of z everywhere: then the whole tread is in contact, and one linear
  /// system solves the problem.
  virtual bool is_linear() const { return false; }

  /// The coefficient F of Coulomb's friction, 0 without friction; empty for other laws. Where Newton's method
  /// fails, there are other methods for Coulomb's law.
  virtual std::optional<double> coulomb_friction() const { return {}; }
};

}  // namespace wheelwright
