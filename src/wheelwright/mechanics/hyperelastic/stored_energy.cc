#include "wheelwright/mechanics/hyperelastic/stored_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wheelwright {
namespace {

/// Lambda of a form that is quadratic in a strain, so that plane stress has constants of its own.
template <int dim>
double quadratic_lambda(const StoredEnergy& energy) {
  if (dim == 3 || energy.plane == Plane::strain) return energy.lambda;
  return 2 * energy.lambda * energy.mu / (energy.lambda + 2 * energy.mu);
}

/// The factors of W = c1 (I_1 - 3) + c2 (I_2 - 3) - a ln J + b/2 (ln J)^2.
struct Invariants {
  double c1, c2, a, b;

  explicit Invariants(const StoredEnergy& energy) {
    const double share = energy.form == EnergyForm::mooney_rivlin ? energy.second_share : 0;
    c1 = (1 - share) * energy.mu / 2;
    c2 = share * energy.mu / 2;
    a = 2 * c1 + 4 * c2;
    b = energy.lambda - 4 * c2;
  }
};

template <int dim>
double squares(const Mat<dim>& f) {
  double sum = 0;
  for (const auto& row : f)
    for (const double x : row) sum += x * x;
  return sum;
}

/// The stretch across the plane for which P_33 = 0, by Newton's method for its logarithm t: F_33 P_33 = (2 c1
/// + 2 c2 tr C) exp(2 t) + b (ln det F + t) - a, which rises with t.
double free_stretch(const Invariants& w, double trace, double log_area) {
  const double growing = 2 * w.c1 + 2 * w.c2 * trace;
  double t = (w.a - growing - w.b * log_area) / (2 * growing + w.b);
  t = std::min(t, 0.5 * std::log(1 + std::max(0.0, w.a - w.b * log_area) / growing));  // no far overshooting
  for (int k = 0; k < 50; ++k) {
    const double exponential = growing * std::exp(2 * t);
    const double step = (exponential + w.b * (log_area + t) - w.a) / (2 * exponential + w.b);
    t -= step;
    if (std::abs(step) < 1e-15 * (1 + std::abs(t))) break;
  }
  return std::exp(t);
}

/// How P_33 depends on F and on F_33.
struct AxialCoupling {
  std::array<double, 4> tangent;  ///< dP_33 / dF_kl, [2 k + l]
  double stiffness;               ///< dP_33 / dF_33

  AxialCoupling(const Invariants& w, const Mat<2>& f, double stretch) {
    const Mat<2> inverse_f = inverse<2>(f);
    const double volumetric = w.b * std::log(determinant<2>(f) * stretch) - w.a;
    stiffness = 2 * w.c1 + 2 * w.c2 * squares<2>(f) + (w.b - volumetric) / (stretch * stretch);
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        tangent[2 * i + k] = 4 * w.c2 * stretch * f[i][k] + w.b * inverse_f[k][i] / stretch;
  }
};

template <int dim>
EnergyResponse<dim> inverted() {
  return {.energy = std::numeric_limits<double>::infinity(), .piola = {}, .tangent = {}, .admissible = false};
}

template <int dim>
EnergyResponse<dim> small_strain_response(const StoredEnergy& energy, const Mat<dim>& f) {
  const double lambda = quadratic_lambda<dim>(energy), mu = energy.mu;
  EnergyResponse<dim> r{};
  Mat<dim> strain;
  double trace = 0;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) strain[i][j] = 0.5 * (f[i][j] + f[j][i]) - (i == j);
  for (int i = 0; i < dim; ++i) trace += strain[i][i];
  r.energy = 0.5 * lambda * trace * trace + mu * squares<dim>(strain);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      r.piola[i][j] = 2 * mu * strain[i][j] + (i == j ? lambda * trace : 0);
      r.tangent[dim * i + j][dim * i + j] += mu;
      r.tangent[dim * i + j][dim * j + i] += mu;
      r.tangent[dim * i + i][dim * j + j] += lambda;
    }
  if (dim == 2 && energy.plane == Plane::strain) r.axial_piola = energy.lambda * trace;
  if (dim == 2 && energy.plane == Plane::stress)
    r.axial_stretch = 1 - energy.lambda / (energy.lambda + 2 * energy.mu) * trace;
  return r;
}

template <int dim>
EnergyResponse<dim> saint_venant_kirchhoff_response(const StoredEnergy& energy, const Mat<dim>& f) {
  const double lambda = quadratic_lambda<dim>(energy), mu = energy.mu;
  EnergyResponse<dim> r{};
  Mat<dim> strain{}, stress, b{};  // E, S and F F^T
  double trace = 0;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      for (int k = 0; k < dim; ++k) {
        strain[i][j] += 0.5 * f[k][i] * f[k][j];
        b[i][j] += f[i][k] * f[j][k];
      }
      if (i == j) strain[i][j] -= 0.5;
    }
  for (int i = 0; i < dim; ++i) trace += strain[i][i];
  r.energy = 0.5 * lambda * trace * trace + mu * squares<dim>(strain);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) stress[i][j] = 2 * mu * strain[i][j] + (i == j ? lambda * trace : 0);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      for (int k = 0; k < dim; ++k) r.piola[i][j] += f[i][k] * stress[k][j];
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          r.tangent[dim * i + j][dim * k + l] = lambda * f[i][j] * f[k][l] + mu * f[i][l] * f[k][j] +
                                                (j == l ? mu * b[i][k] : 0) + (i == k ? stress[j][l] : 0);
    }
  if (dim == 2 && energy.plane == Plane::strain) r.axial_piola = energy.lambda * trace;
  if (dim == 2 && energy.plane == Plane::stress) {
    const double square = 1 - 2 * energy.lambda / (energy.lambda + 2 * energy.mu) * trace;
    if (!(square > 0)) return inverted<dim>();
    r.axial_stretch = std::sqrt(square);
  }
  return r;
}

/// Neo-Hookean, and Mooney and Rivlin's form. `j`: det F in the model's dimension.
template <int dim>
EnergyResponse<dim> invariant_response(const StoredEnergy& energy, const Mat<dim>& f, double j,
                                       double pressure) {
  const Invariants w(energy);
  const Mat<dim> inverse_f = inverse<dim>(f);
  const double trace = squares<dim>(f);
  const bool is_free = dim == 2 && energy.plane == Plane::stress;
  EnergyResponse<dim> r{};
  r.axial_stretch = is_free ? free_stretch(w, trace, std::log(j)) : 1;
  const double across = dim == 2 ? r.axial_stretch * r.axial_stretch : 0,
               log_j = std::log(j * r.axial_stretch);
  const double first = trace + across, volumetric = w.b * log_j - w.a + pressure;
  r.energy = w.c1 * (first - 3) - w.a * log_j + 0.5 * w.b * log_j * log_j;
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) r.piola[i][k] = 2 * w.c1 * f[i][k] + volumetric * inverse_f[k][i];
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
        for (int m = 0; m < dim; ++m)
          r.tangent[dim * i + k][dim * l + m] = w.b * inverse_f[k][i] * inverse_f[m][l] -
                                                volumetric * inverse_f[k][l] * inverse_f[m][i] +
                                                (i == l && k == m ? 2 * w.c1 : 0);
  if (w.c2 != 0) {
    Mat<dim> c{}, b{};
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l) {
          c[i][k] += f[l][i] * f[l][k];
          b[i][k] += f[i][l] * f[k][l];
        }
    const double second = dim == 2 ? j * j + across * trace : 0.5 * (trace * trace - squares<dim>(c));
    r.energy += w.c2 * (second - 3);
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) {
        double fc = 0;
        for (int l = 0; l < dim; ++l) fc += f[i][l] * c[l][k];
        r.piola[i][k] += 2 * w.c2 * (first * f[i][k] - fc);
        for (int l = 0; l < dim; ++l)
          for (int m = 0; m < dim; ++m)
            r.tangent[dim * i + k][dim * l + m] +=
                2 * w.c2 *
                (2 * f[i][k] * f[l][m] - f[i][m] * f[l][k] + (i == l && k == m ? first : 0) -
                 (i == l ? c[m][k] : 0) - (k == m ? b[i][l] : 0));
      }
  }
  if constexpr (dim == 2) {
    const double stretch = r.axial_stretch;
    r.axial_piola = (2 * w.c1 + 2 * w.c2 * trace) * stretch + volumetric / stretch;
    if (is_free) {  // condensed: dP_33 = 0
      r.axial_piola = 0;
      const AxialCoupling coupling(w, f, stretch);
      for (int p = 0; p < 4; ++p)
        for (int q = 0; q < 4; ++q)
          r.tangent[p][q] -= coupling.tangent[p] * coupling.tangent[q] / coupling.stiffness;
    }
  }
  return r;
}

}  // namespace

StoredEnergy StoredEnergy::of(const Material& material, EnergyForm form, double second_share) {
  const double e = material.youngs_modulus, nu = material.poissons_ratio;
  return {form, material.mu(), e * nu / ((1 + nu) * (1 - 2 * nu)), material.plane, second_share};
}

template <int dim>
EnergyResponse<dim> response(const StoredEnergy& energy, const Mat<dim>& f, double pressure) {
  if (energy.form == EnergyForm::small_strain) return small_strain_response<dim>(energy, f);
  const double j = determinant<dim>(f);
  if (!(j > 0)) return inverted<dim>();
  if (energy.form == EnergyForm::saint_venant_kirchhoff)
    return saint_venant_kirchhoff_response<dim>(energy, f);
  return invariant_response<dim>(energy, f, j, pressure);
}

AxialSlopes axial_slopes(const StoredEnergy& energy, const Mat<2>& f) {
  AxialSlopes slopes;
  const bool is_free = energy.plane == Plane::stress;
  const double ratio = energy.lambda / (energy.lambda + 2 * energy.mu);
  const auto r = response<2>(energy, f);
  if (!r.admissible) return slopes;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      if (energy.form == EnergyForm::small_strain) {
        (is_free ? slopes.stretch : slopes.piola)[i][k] = (i == k) * (is_free ? -ratio : energy.lambda);
      } else if (energy.form == EnergyForm::saint_venant_kirchhoff) {
        (is_free ? slopes.stretch : slopes.piola)[i][k] =
            f[i][k] * (is_free ? -ratio / r.axial_stretch : energy.lambda);
      } else {
        const AxialCoupling coupling(Invariants(energy), f, r.axial_stretch);
        (is_free ? slopes.stretch : slopes.piola)[i][k] =
            is_free ? -coupling.tangent[2 * i + k] / coupling.stiffness : coupling.tangent[2 * i + k];
      }
    }
  return slopes;
}

template decltype(response<2>) response<2>;
template decltype(response<3>) response<3>;

}  // namespace wheelwright
