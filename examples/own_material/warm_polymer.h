#pragma once

#include <wheelwright/mechanics/elasticity/material_law.h>

#include <cmath>

/// An isotropic polymer in plane strain that softens as it warms up: Young's modulus E = E_20 exp(-(T - 20 C)
/// / 45 K).
class WarmPolymer : public wheelwright::MaterialLaw<2> {
 public:
  using Strains = wheelwright::StrainRows<2>;
  using Stresses = wheelwright::StressRows<2>;

  /// `modulus_at_20`: E_20 [Pa]; `poissons_ratio`: nu < 0.48; `temperature`: T [C].
  WarmPolymer(double modulus_at_20, double poissons_ratio, double temperature)
      : e_(modulus_at_20 * std::exp(-(temperature - 20) / 45)), nu_(poissons_ratio) {}

  double youngs_modulus() const { return e_; }

  bool is_linear() const override { return true; }

  void stress(const Strains& strains, const Stresses& stresses) const override {
    for (std::size_t i = 0; i < strains[0].size(); ++i) {
      const double mean = lambda() * (strains[0][i] + strains[1][i]);
      stresses[0][i] = mean + 2 * shear() * strains[0][i];
      stresses[1][i] = mean + 2 * shear() * strains[1][i];
      stresses[2][i] = shear() * strains[2][i];
    }
  }

  void tangent(const Strains& strains, const wheelwright::TangentRows<2>& tangents) const override {
    const double d[3][3] = {{stretched(), lambda(), 0}, {lambda(), stretched(), 0}, {0, 0, shear()}};
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        for (std::size_t i = 0; i < strains[0].size(); ++i) tangents[k][l][i] = d[k][l];
  }

  void energy_density(const Strains& e, std::span<double> densities) const override {
    for (std::size_t i = 0; i < e[0].size(); ++i)
      densities[i] = 0.5 * stretched() * (e[0][i] * e[0][i] + e[1][i] * e[1][i]) +
                     lambda() * e[0][i] * e[1][i] + 0.5 * shear() * e[2][i] * e[2][i];
  }

  /// 4 G^2 (e_11^2 - e_11 e_22 + e_22^2 + 3/4 gamma_12^2): in plane strain e_33 = 0.
  void squared_von_mises(const Strains& e, std::span<double> squares) const override {
    for (std::size_t i = 0; i < e[0].size(); ++i)
      squares[i] = 4 * shear() * shear() *
                   (e[0][i] * e[0][i] - e[0][i] * e[1][i] + e[1][i] * e[1][i] + 0.75 * e[2][i] * e[2][i]);
  }

  void squared_von_mises_slope(const Strains& e, const Stresses& slopes) const override {
    const double factor = 4 * shear() * shear();
    for (std::size_t i = 0; i < e[0].size(); ++i) {
      slopes[0][i] = factor * (2 * e[0][i] - e[1][i]);
      slopes[1][i] = factor * (2 * e[1][i] - e[0][i]);
      slopes[2][i] = factor * 1.5 * e[2][i];
    }
  }

  void along_axle(const Strains& e, std::span<double> stresses, std::span<double> strains) const override {
    for (std::size_t i = 0; i < e[0].size(); ++i) {
      stresses[i] = lambda() * (e[0][i] + e[1][i]);
      strains[i] = 0;
    }
  }

  double scaling_modulus() const override { return e_; }
  double contact_modulus() const override { return e_ / (1 - nu_ * nu_); }

 private:
  double shear() const { return e_ / (2 * (1 + nu_)); }
  double lambda() const { return e_ * nu_ / ((1 + nu_) * (1 - 2 * nu_)); }
  double stretched() const { return lambda() + 2 * shear(); }

  double e_, nu_;
};
