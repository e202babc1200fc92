#pragma once

#include <memory>
#include <vector>

#include "wheelwright/mechanics/contact/contact_responses.h"
#include "wheelwright/mechanics/elasticity/contact_form.h"

namespace wheelwright {

/// Unilateral contact with Coulomb's friction (11), (16).
template <int dim>
class CoulombLaw : public ContactLaw<dim> {
 public:
  /// `friction`: F >= 0.
  explicit CoulombLaw(double friction) : friction_(friction) {}

  ContactResponse<dim> response(int, const Vec<dim>& z) const override {
    return contact_response<dim>(z, friction_);
  }
  ContactStatus status(int, const Vec<dim>& z) const override { return contact_status<dim>(z, friction_); }
  bool is_tangential() const override { return friction_ > 0; }
  std::optional<double> coulomb_friction() const override { return friction_; }

 private:
  double friction_;
};

/// Contact with given friction (Tresca's law).
template <int dim>
class GivenFrictionLaw : public ContactLaw<dim> {
 public:
  /// One threshold per contact point [Pa].
  explicit GivenFrictionLaw(std::vector<double> thresholds) : thresholds_(std::move(thresholds)) {}

  ContactResponse<dim> response(int point, const Vec<dim>& z) const override {
    return given_friction_response<dim>(z, thresholds_[point]);
  }
  bool is_active(int point, const Vec<dim>& z) const override { return z[0] < 0 || thresholds_[point] > 0; }
  ContactStatus status(int point, const Vec<dim>& z) const override {
    return {z[0]<0, thresholds_[point]> 0 && tangential_norm<dim>(z) > thresholds_[point]};
  }
  bool is_tangential() const override { return true; }

 private:
  std::vector<double> thresholds_;
};

/// Contact that slides everywhere, whatever the rim's motion along the ground.
template <int dim>
class SlidingLaw : public ContactLaw<dim> {
 public:
  /// Friction acts on the wheel along `direction`, a unit vector along the ground, or zero without friction.
  SlidingLaw(double friction, const Vec<dim>& direction) : friction_(friction), direction_(direction) {}

  ContactResponse<dim> response(int, const Vec<dim>& z) const override {
    return sliding_response<dim>(z, friction_, direction_);
  }
  bool is_tangential() const override { return friction_ > 0; }

 private:
  double friction_;
  Vec<dim> direction_;
};

/// A tread that is bonded to a rigid ring: Phi(z) = z.
template <int dim>
class BondedLaw : public ContactLaw<dim> {
 public:
  ContactResponse<dim> response(int, const Vec<dim>& z) const override { return bonded_response<dim>(z); }
  bool is_active(int, const Vec<dim>&) const override { return true; }
  ContactStatus status(int, const Vec<dim>&) const override { return {.touches = true, .slides = false}; }
  bool is_tangential() const override { return true; }
  bool is_linear() const override { return true; }
};

/// The law of a contact form.
template <int dim>
std::shared_ptr<const ContactLaw<dim>> law_of(const ContactForm& form) {
  if (form.counterpart == Counterpart::ring) return std::make_shared<const BondedLaw<dim>>();
  return std::make_shared<const CoulombLaw<dim>>(form.friction);
}

}  // namespace wheelwright
