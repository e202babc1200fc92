#pragma once

namespace wheelwright {

/// The form in which the contact conditions (11), (16) enter the weak form.
enum class ContactMethod {
  nitsche,  ///< (28): I_N, with the parameter theta
  penalty,  ///< (22): I_P
};

/// The body that the tread meets.
enum class Counterpart {
  ground,  ///< flat and rigid, in unilateral contact
  ring,    ///< a rigid ring around the tread, to which all of it is bonded: Phi(z) = z and g = 0
};

/// The contact terms, in one form for both methods. With the augmented traction
///   z(u) = tau sigma(u)n - gamma (u - g n_y)
/// and the contact traction Phi(z) of (18), (23), they are
///   I(u, v) = int_Gamma_C -theta/gamma sigma(u)n . sigma(v)n + Phi(z(u)) . (theta/gamma sigma(v)n - v),
/// where the penalty method has tau = theta = 0 and Nitsche's method has tau = 1.
struct ContactForm {
  ContactMethod method = ContactMethod::nitsche;
  double theta_nitsche = -1;  ///< theta; ignored by the penalty method
  double gamma_0 = 1;         ///< gamma = gamma_0 E / h_T [Pa/m], with E = Material::scaling_modulus()
  double friction = 0;        ///< coefficient F of Coulomb's friction
  Counterpart counterpart = Counterpart::ground;

  double tau() const { return method == ContactMethod::nitsche ? 1 : 0; }
  double theta() const { return method == ContactMethod::nitsche ? theta_nitsche : 0; }
};

}  // namespace wheelwright
