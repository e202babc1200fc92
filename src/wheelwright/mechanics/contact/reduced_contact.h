#pragma once

#include "wheelwright/mechanics/contact/contact_laws.h"
#include "wheelwright/mechanics/contact/contact_operator.h"

namespace wheelwright {

/// The contact problem (27) with the rigid rim (4.3) of one load position, condensed onto its contact zone:
///   z = z_0 + F W Phi(z) + gamma (g n_y - m),   sum w Phi(z).m_k + force_k = 0,
/// where W holds the weights, F is the flexibility of the zone (ContactOperator), Phi the contact law, m the
/// rim's motion, m_k its free motions, and z_0 the value of tau sigma(v)n - gamma v due to other loads. Only
/// the components that can carry traction are kept: without friction only the normal one.
template <int dim>
class ReducedContact {
 public:
  ReducedContact(std::shared_ptr<const ContactOperator<dim>> tread,
                 std::shared_ptr<const ContactLaw<dim>> law, RimControl rim, const Preload& preload = {});

  /// The same zone with another rim control.
  ReducedContact under(const RimControl& rim) const;

  /// The same problem with another law.
  ReducedContact with_law(std::shared_ptr<const ContactLaw<dim>> law) const;

  /// The same problem with given friction (Tresca's law): one threshold per point [Pa].
  ReducedContact with_given_friction(std::vector<double> thresholds) const;

  /// The same problem with all contact points sliding, regardless of the rim's motion along the ground:
  /// friction acts on the wheel along `direction`, a unit vector along the ground.
  ReducedContact sliding_along(const Vec<dim>& direction) const;

  const ContactLaw<dim>& law() const { return *law_; }
  ContactResponse<dim> response(int point, const Vec<dim>& z) const { return law_->response(point, z); }
  ContactStatus status(int point, const Vec<dim>& z) const { return law_->status(point, z); }
  double friction() const { return law_->coulomb_friction().value_or(0); }
  /// Whether friction may stick or slide, by Coulomb's law.
  bool has_friction() const { return friction() > 0; }

  const ContactOperator<dim>& tread() const { return *tread_; }
  const ContactZone& zone() const { return tread_->at.zone; }
  const std::vector<ZonePoint<dim>>& points() const { return tread_->at.points; }
  int n_points() const { return tread_->at.size(); }
  /// The number of components of z that contact meets: the others of every tangent are not used.
  int components() const { return tread_->components; }

  const RimControl& rim() const { return rim_; }
  int n_free() const { return static_cast<int>(rim_.free.size()); }
  const RimForce& preload_resultant() const { return preload_resultant_; }
  /// z_0 at a point.
  Vec<dim> preload(int point) const { return preload_.empty() ? Vec<dim>{} : preload_[point]; }
  double growth() const { return growth_; }  ///< (ContactPatch)

  ContactUnknowns<dim> residual(const ContactUnknowns<dim>& x) const;

  /// The derivative of the contact law at every point.
  std::vector<Mat<dim>> tangents(const std::vector<Vec<dim>>& z) const;

  /// The change of the residual, beyond that of z itself, when a point's traction changes by `traction`.
  ContactUnknowns<dim> residual_of(int point, const Vec<dim>& traction) const;

  /// Whether the rim moves less than the tread's radius in each of its free motions.
  bool keeps_rim_near(const ContactUnknowns<dim>& step) const;

  /// The contact state for a solution x under the full loads.
  ContactState<dim> state(const ContactUnknowns<dim>& x, int newton_iterations) const;

  /// z without contact, for these coefficients of the rim's free motions.
  std::vector<Vec<dim>> without_contact(const std::vector<double>& free) const;

  /// The maximum displacement of a point that moves with the rim.
  double amplitude(const RimMotion& motion) const;

 private:
  RimMotion rim_motion(const std::vector<double>& free) const;

  std::shared_ptr<const ContactOperator<dim>> tread_;
  std::shared_ptr<const ContactLaw<dim>> law_;
  RimControl rim_;
  std::vector<Vec<dim>> preload_;  ///< z_0; empty: zero
  RimForce preload_resultant_;
  double growth_;  ///< (ContactPatch)
};

/// The problem of a zone of the tread.
template <int dim>
ReducedContact<dim> reduced_contact(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread,
                                    const PolarGrid<dim>& grid, GroundPosition ground, ContactZone zone,
                                    std::shared_ptr<const ContactLaw<dim>> law, RimControl rim,
                                    const Preload& preload = {}, const Ground& shape = {});

}  // namespace wheelwright
