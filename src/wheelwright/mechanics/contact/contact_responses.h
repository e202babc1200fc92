#pragma once

#include <cmath>

#include "wheelwright/mechanics/state/contact_law.h"

namespace wheelwright {

/// [x]_- = max(-x, 0).
inline double negative_part(double x) { return x < 0 ? -x : 0; }

/// The scalar product of the tangential parts of two vectors, and the length of a tangential part.
template <int dim>
double tangential_dot(const Vec<dim>& a, const Vec<dim>& b) {
  double sum = 0;
  for (int d = 1; d < dim; ++d) sum += a[d] * b[d];
  return sum;
}

template <int dim>
double tangential_norm(const Vec<dim>& z) {
  return std::sqrt(tangential_dot<dim>(z, z));
}

/// Phi(z) of (18), (23): Phi_n = -[z_n]_-, Phi_t = z_t projected onto the ball of radius F [z_n]_- (19).
template <int dim>
ContactResponse<dim> contact_response(const Vec<dim>& z, double friction) {
  ContactResponse<dim> r{};
  const double pressure = negative_part(z[0]);
  if (pressure <= 0) return r;
  r.traction[0] = -pressure;
  r.tangent[0][0] = 1;
  if (friction <= 0) return r;

  const double threshold = friction * pressure, tangential = tangential_norm<dim>(z);
  const bool sticks = tangential <= threshold;
  for (int i = 1; i < dim; ++i) {
    if (sticks) {
      r.traction[i] = z[i];
      r.tangent[i][i] = 1;
      continue;
    }
    const double direction = z[i] / tangential;
    r.traction[i] = threshold * direction;
    r.tangent[i][0] = -friction * direction;
    for (int j = 1; j < dim; ++j)
      r.tangent[i][j] = threshold / tangential * ((i == j) - direction * z[j] / tangential);
  }
  return r;
}

/// Contact with given friction (Tresca's law): the tangential traction is z_t projected onto the ball of
/// radius `threshold`, in contact or not. The problem is then monotone, with a unique solution.
template <int dim>
ContactResponse<dim> given_friction_response(const Vec<dim>& z, double threshold) {
  ContactResponse<dim> r{};
  const double pressure = negative_part(z[0]), tangential = tangential_norm<dim>(z);
  r.traction[0] = -pressure;
  r.tangent[0][0] = pressure > 0;
  if (threshold <= 0) return r;
  const bool sticks = tangential <= threshold;
  for (int i = 1; i < dim; ++i) {
    r.traction[i] = sticks ? z[i] : threshold * z[i] / tangential;
    for (int j = 1; j < dim; ++j)
      r.tangent[i][j] =
          sticks ? (i == j) : threshold / tangential * ((i == j) - z[i] * z[j] / (tangential * tangential));
  }
  return r;
}

/// Contact that slides everywhere, whatever z_t: the ground's friction on the body is friction [z_n]_- times
/// `along`, a vector along the ground of length 1 at most.
template <int dim>
ContactResponse<dim> sliding_response(const Vec<dim>& z, double friction, const Vec<dim>& along) {
  ContactResponse<dim> r{};
  if (z[0] >= 0) return r;
  r.traction[0] = z[0];
  r.tangent[0][0] = 1;
  for (int i = 1; i < dim; ++i) {
    r.traction[i] = -friction * z[0] * along[i];
    r.tangent[i][0] = -friction * along[i];
  }
  return r;
}

/// A bonded tread: Phi(z) = z.
template <int dim>
ContactResponse<dim> bonded_response(const Vec<dim>& z) {
  ContactResponse<dim> r{z, {}};
  for (int d = 0; d < dim; ++d) r.tangent[d][d] = 1;
  return r;
}

/// The status of a point under Coulomb's law; a point that does not touch does not slide either.
template <int dim>
ContactStatus contact_status(const Vec<dim>& z, double friction) {
  const bool touches = z[0] < 0;
  return {touches, touches && friction > 0 && tangential_norm<dim>(z) > friction * negative_part(z[0])};
}

}  // namespace wheelwright
