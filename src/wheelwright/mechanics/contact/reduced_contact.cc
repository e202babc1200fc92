#include "wheelwright/mechanics/contact/reduced_contact.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// z_0 of what the tread observes without contact; empty: zero.
template <int dim>
std::vector<Vec<dim>> without_tractions(const ContactOperator<dim>& tread, const Matrix& observations) {
  std::vector<Vec<dim>> result;
  if (observations.rows() == 0) return result;
  const ContactPoints<dim>& at = tread.at;
  const ObservationRows<dim> rows = at.observation_rows();
  for (int i = 0; i < at.size(); ++i) {
    const double* observed =
        observations.column(wrap(at.zone.first_column + at.column(i), observations.columns()));
    const double *displacement = observed + rows.displacement(at.point_of_column(i)),
                 *traction = observed + rows.traction(at.point_of_column(i));
    Vec<dim> z;
    for (int d = 0; d < dim; ++d) z[d] = tread.tau * traction[d] - at.points[i].gamma * displacement[d];
    result.push_back(at.points[i].frame.template to_contact<dim>(z));
  }
  return result;
}

}  // namespace

template <int dim>
ReducedContact<dim>::ReducedContact(std::shared_ptr<const ContactOperator<dim>> tread,
                                    std::shared_ptr<const ContactLaw<dim>> law, RimControl rim,
                                    const Preload& preload)
    : tread_(std::move(tread)),
      law_(std::move(law)),
      rim_(std::move(rim)),
      preload_(without_tractions(*tread_, preload.observations)),
      preload_resultant_(preload.resultant),
      growth_(preload.growth) {}

template <int dim>
ReducedContact<dim> ReducedContact<dim>::under(const RimControl& rim) const {
  ReducedContact contact = *this;
  contact.rim_ = rim;
  return contact;
}

template <int dim>
ReducedContact<dim> ReducedContact<dim>::with_law(std::shared_ptr<const ContactLaw<dim>> law) const {
  ReducedContact contact = *this;
  contact.law_ = std::move(law);
  return contact;
}

template <int dim>
ReducedContact<dim> ReducedContact<dim>::with_given_friction(std::vector<double> thresholds) const {
  return with_law(std::make_shared<const GivenFrictionLaw<dim>>(std::move(thresholds)));
}

template <int dim>
ReducedContact<dim> ReducedContact<dim>::sliding_along(const Vec<dim>& direction) const {
  return with_law(std::make_shared<const SlidingLaw<dim>>(friction(), direction));
}

template <int dim>
std::vector<Vec<dim>> ReducedContact<dim>::without_contact(const std::vector<double>& free) const {
  const RimMotion rim = rim_motion(free);
  std::vector<Vec<dim>> result;
  for (int i = 0; i < n_points(); ++i) {
    const ZonePoint<dim>& point = points()[i];
    Vec<dim> z = rim_displacement(point, rim);
    z[0] -= point.gap;
    for (int d = 0; d < dim; ++d) z[d] = (preload_.empty() ? 0.0 : preload_[i][d]) - point.gamma * z[d];
    result.push_back(z);
  }
  return result;
}

template <int dim>
RimMotion ReducedContact<dim>::rim_motion(const std::vector<double>& free) const {
  RimMotion motion = rim_.prescribed;
  for (int k = 0; k < n_free(); ++k) motion = combined(motion, free[k], rim_.free[k].direction);
  return motion;
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::residual(const ContactUnknowns<dim>& x) const {
  const int nc = components();
  Matrix forces(n_points() * nc, 1);
  ContactUnknowns<dim> result{std::vector<Vec<dim>>(points().size(), Vec<dim>{}), {}};
  for (const FreeMotion& motion : rim_.free)
    result.rim.push_back(-motion.force - work(preload_resultant_, motion.direction));
  for (int i = 0; i < n_points(); ++i) {
    const Vec<dim> traction = response(i, x.augmented[i]).traction;
    if (!law_->is_active(i, x.augmented[i])) continue;
    for (int d = 0; d < nc; ++d) forces(nc * i + d, 0) = points()[i].weight * traction[d];
    for (int k = 0; k < n_free(); ++k)
      result.rim[k] -=
          points()[i].weight * dot<dim>(traction, rim_displacement(points()[i], rim_.free[k].direction));
  }
  const Matrix reply = tread_->replies(forces);
  const RimMotion rim = rim_motion(x.rim);
  for (int i = 0; i < n_points(); ++i) {
    Vec<dim> approach = rim_displacement(points()[i], rim);
    approach[0] -= points()[i].gap;
    for (int d = 0; d < nc; ++d)
      result.augmented[i][d] = x.augmented[i][d] - reply(nc * i + d, 0) + points()[i].gamma * approach[d] -
                               (preload_.empty() ? 0.0 : preload_[i][d]);
  }
  return result;
}

template <int dim>
std::vector<Mat<dim>> ReducedContact<dim>::tangents(const std::vector<Vec<dim>>& z) const {
  std::vector<Mat<dim>> result(z.size(), Mat<dim>{});
  for (int i = 0; i < n_points(); ++i)
    if (law_->is_active(i, z[i])) result[i] = response(i, z[i]).tangent;
  return result;
}

template <int dim>
ContactUnknowns<dim> ReducedContact<dim>::residual_of(int point, const Vec<dim>& traction) const {
  const int nc = components();
  ContactUnknowns<dim> result{std::vector<Vec<dim>>(points().size(), Vec<dim>{}), {}};
  for (int d = 0; d < nc; ++d) {
    const double* f = tread_->flexibility.column(nc * point + d);
    for (int i = 0; i < n_points(); ++i)
      for (int k = 0; k < nc; ++k)
        result.augmented[i][k] -= points()[point].weight * traction[d] * f[nc * i + k];
  }
  for (const FreeMotion& motion : rim_.free)
    result.rim.push_back(-points()[point].weight *
                         dot<dim>(traction, rim_displacement(points()[point], motion.direction)));
  return result;
}

template <int dim>
bool ReducedContact<dim>::keeps_rim_near(const ContactUnknowns<dim>& step) const {
  const double longest = norm<dim>(points().front().position);
  for (int k = 0; k < n_free(); ++k)
    if (!(std::abs(step.rim[k]) * amplitude(rim_.free[k].direction) < longest)) return false;
  return true;
}

template <int dim>
ContactState<dim> ReducedContact<dim>::state(const ContactUnknowns<dim>& x, int newton_iterations) const {
  ContactState<dim> state{zone(), x.augmented, {}, rim_motion(x.rim), {}, newton_iterations};
  state.ground = tread_->at.ground;
  state.rim_force = scaled(-1, preload_resultant_);
  for (int i = 0; i < n_points(); ++i) {
    state.traction.push_back(response(i, x.augmented[i]).traction);
    const Vec<dim> traction = points()[i].frame.template contact_to_ground<dim>(state.traction.back());
    const RimForce force = resultant<dim>(traction, points()[i].position);
    state.rim_force = sum(state.rim_force, scaled(-points()[i].weight, force));
  }
  return state;
}

template <int dim>
double ReducedContact<dim>::amplitude(const RimMotion& motion) const {
  double largest = 0;
  for (const ZonePoint<dim>& point : points())
    largest = std::max(largest, norm<dim>(displacement<dim>(motion, point.position)));
  return largest;
}

template <int dim>
ReducedContact<dim> reduced_contact(const SurfaceCompliance<dim>& surface, const Tread<dim>& tread,
                                    const PolarGrid<dim>& grid, GroundPosition ground, ContactZone zone,
                                    std::shared_ptr<const ContactLaw<dim>> law, RimControl rim,
                                    const Preload& preload, const Ground& shape) {
  auto points = contact_points(tread, grid, ground, zone, shape);
  auto op = contact_operator(surface, tread, std::move(points), law->is_tangential() ? dim : 1);
  return {std::move(op), std::move(law), std::move(rim), preload};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                        \
  template class ReducedContact<dim>;                                                                       \
  template ReducedContact<dim> reduced_contact(                                                             \
      const SurfaceCompliance<dim>&, const Tread<dim>&, const PolarGrid<dim>&, GroundPosition, ContactZone, \
      std::shared_ptr<const ContactLaw<dim>>, RimControl, const Preload&, const Ground&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
