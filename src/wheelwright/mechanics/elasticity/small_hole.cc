#include "wheelwright/mechanics/elasticity/small_hole.h"

#include <cmath>

#include "wheelwright/mechanics/elasticity/orthotropic_law.h"
#include "wheelwright/mechanics/elasticity/voigt_indices.h"

namespace wheelwright {
namespace {

/// By what the hole strains more than the body, in dilatation and in shear.
struct Concentration {
  double dilatation, deviator;
};

template <int dim>
Concentration concentration(const Material& material) {
  const double lambda = material.lambda(), mu = material.mu();
  if constexpr (dim == 2) return {(lambda + 2 * mu) / mu, 2 * (lambda + 2 * mu) / (lambda + mu)};
  const double nu = material.poissons_ratio;
  return {1.5 * (1 - nu) / (1 - 2 * nu), 15 * (1 - nu) / (7 - 5 * nu)};
}

/// The strain of a stress in the plane.
Voigt<2> strain_of(const Material& material, const Voigt<2>& stress) {
  const double lambda = material.lambda(), mu = material.mu();
  const double hydrostatic = lambda / (2 * (lambda + mu)) * (stress[0] + stress[1]);
  return {(stress[0] - hydrostatic) / (2 * mu), (stress[1] - hydrostatic) / (2 * mu), stress[2] / mu};
}

}  // namespace

template <int dim>
Voigt<dim> strain_of_hole(const Material& material, const Voigt<dim>& distant) {
  const auto [dilatation, deviator] = concentration<dim>(material);
  double mean = 0;
  for (int d = 0; d < dim; ++d) mean += distant[d] / dim;
  Voigt<dim> strain;
  for (int k = 0; k < n_strains<dim>; ++k)
    strain[k] = k < dim ? dilatation * mean + deviator * (distant[k] - mean) : deviator * distant[k];
  return strain;
}

Voigt<2> strain_of_hole(const OrthotropicMaterial& material, const Voigt<2>& distant) {
  const auto [rr, tt, rt, shear] = material.plane_compliance();
  const double x = 2 * std::sqrt(rr * tt) + 2 * rt + shear, coupled = std::sqrt(rr * tt);
  const Voigt<2> far = stress<2>(OrthotropicLaw<2>(material), distant);
  return {(rr + std::sqrt(rr * x)) * far[0] - coupled * far[1],
          (tt + std::sqrt(tt * x)) * far[1] - coupled * far[0],
          (x + (std::sqrt(rr) + std::sqrt(tt)) * std::sqrt(x)) * far[2]};
}

Voigt<2> strain_around_hole(const Material& material, const Voigt<2>& distant, const Vec<2>& place) {
  const Voigt<2> far = stress<2>(material, distant);
  const double square = dot<2>(place, place), inverse = 1 / square, fourth = inverse * inverse;
  const double cosine = (place[0] * place[0] - place[1] * place[1]) * inverse,
               sine = 2 * place[0] * place[1] * inverse;  // of twice the angle
  const double mean = 0.5 * (far[0] + far[1]), half_difference = 0.5 * (far[0] - far[1]);
  const double along = half_difference * cosine + far[2] * sine,
               across = far[2] * cosine - half_difference * sine;
  const double radial = -mean * inverse + along * (3 * fourth - 4 * inverse),
               azimuthal = mean * inverse - 3 * along * fourth, shear = across * (2 * inverse - 3 * fourth);
  const double centre = 0.5 * (radial + azimuthal), half = 0.5 * (radial - azimuthal);
  return strain_of(material, {centre + half * cosine - shear * sine, centre - half * cosine + shear * sine,
                              half * sine + shear * cosine});
}

/// With the deviator E, s = E x and q = x . s, the displacement is
///   a x / r^3 + b (k q x / r^5 + s / r^3) + c (2 s / r^5 - 5 q x / r^7),
/// which satisfies Navier's equations for every a, b and c; these make the traction at r = 1 vanish.
Voigt<3> strain_around_hole(const Material& material, const Voigt<3>& distant, const Vec<3>& place) {
  const double lambda = material.lambda(), mu = material.mu();
  const double mean = (distant[0] + distant[1] + distant[2]) / 3;
  const double k = 1.5 * (lambda + mu) / mu, a = (3 * lambda + 2 * mu) / (4 * mu) * mean,
               b = 10 / (5 + 6 * k), c = k * b / 5;
  const Vec<3>& x = place;
  Voigt<3> deviator;
  Vec<3> s{};
  for (int v = 0; v < n_strains<3>; ++v) {
    const auto [i, j] = voigt_indices<3>()[v];
    deviator[v] = i == j ? distant[v] - mean : 0.5 * distant[v];
    s[i] += deviator[v] * x[j];
    if (i != j) s[j] += deviator[v] * x[i];
  }
  const double q = dot<3>(x, s), r2 = 1 / dot<3>(x, x), r3 = r2 * std::sqrt(r2), r5 = r3 * r2, r7 = r5 * r2,
               r9 = r7 * r2;
  Voigt<3> strain;
  for (int v = 0; v < n_strains<3>; ++v) {
    const auto [i, j] = voigt_indices<3>()[v];
    const double unit = i == j ? 1 : 0, xx = x[i] * x[j], sx = s[i] * x[j] + s[j] * x[i];
    const double component =
        a * (unit * r3 - 3 * xx * r5) +
        b * (k * (sx * r5 + q * unit * r5 - 5 * q * xx * r7) + deviator[v] * r3 - 1.5 * sx * r5) +
        c * (2 * deviator[v] * r5 - 10 * sx * r7 - 5 * q * unit * r7 + 35 * q * xx * r9);
    strain[v] = i == j ? component : 2 * component;
  }
  return strain;
}

template decltype(strain_of_hole<2>) strain_of_hole<2>;
template decltype(strain_of_hole<3>) strain_of_hole<3>;

}  // namespace wheelwright
