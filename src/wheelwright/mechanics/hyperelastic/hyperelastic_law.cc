#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "wheelwright/mechanics/elasticity/voigt_indices.h"

namespace wheelwright {
namespace {

/// The upper triangular F with F^T F = I + 2 E: as good as any other deformation with these strains. Empty if
/// none has them.
template <int dim>
std::optional<Mat<dim>> deformation_of(const StrainRows<dim>& strains, size_t point) {
  Mat<dim> c{}, f{};
  constexpr auto indices = voigt_indices<dim>();
  for (int k = 0; k < n_strains<dim>; ++k) {
    const auto [i, j] = indices[k];
    c[i][j] = c[j][i] = i == j ? 1 + 2 * strains[k][point] : strains[k][point];
  }
  for (int i = 0; i < dim; ++i)
    for (int j = i; j < dim; ++j) {
      double rest = c[i][j];
      for (int k = 0; k < i; ++k) rest -= f[k][i] * f[k][j];
      if (i == j && !(rest > 0)) return {};
      f[i][j] = i == j ? std::sqrt(rest) : rest / f[i][i];
    }
  return f;
}

/// a b, and a b^T.
template <int dim>
Mat<dim> times(const Mat<dim>& a, const Mat<dim>& b) {
  Mat<dim> result{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k) result[i][j] += a[i][k] * b[k][j];
  return result;
}
template <int dim>
Mat<dim> times_transposed(const Mat<dim>& a, const Mat<dim>& b) {
  Mat<dim> result{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k) result[i][j] += a[i][k] * b[j][k];
  return result;
}

template <int dim>
double product(const Mat<dim>& a, const Mat<dim>& b) {
  double sum = 0;
  for (int i = 0; i < dim; ++i) sum += dot(a[i], b[i]);
  return sum;
}

/// Cauchy's stress and its deviator; `axial`: the components along the axle when dim = 2.
template <int dim>
struct TrueStress {
  Mat<dim> stress, deviator;
  double axial = 0, axial_deviator = 0;

  TrueStress(const EnergyResponse<dim>& r, const Mat<dim>& f) {
    const double j = determinant<dim>(f) * r.axial_stretch;
    stress = times_transposed<dim>(r.piola, f);
    for (auto& row : stress) row = row / j;
    if (dim == 2) axial = r.axial_piola * r.axial_stretch / j;
    double mean = axial / 3;
    for (int i = 0; i < dim; ++i) mean += stress[i][i] / 3;
    deviator = stress;
    for (int i = 0; i < dim; ++i) deviator[i][i] -= mean;
    if (dim == 2) axial_deviator = axial - mean;
  }

  double squared_von_mises() const {
    return 1.5 * (product<dim>(deviator, deviator) + axial_deviator * axial_deviator);
  }
};

/// Calls visit(point, F, response) for every point of a block, without those that no deformation has.
template <int dim, class Visit>
void visit_deformations(const StoredEnergy& energy, const StrainRows<dim>& strains, Visit visit) {
  for (size_t point = 0; point < strains[0].size(); ++point)
    if (const auto f = deformation_of<dim>(strains, point)) visit(point, *f, response<dim>(energy, *f));
}

template <int dim>
void set_to_zero(const StressRows<dim>& rows) {
  for (const auto& row : rows) std::ranges::fill(row, 0.0);
}

}  // namespace

template <int dim>
void HyperelasticLaw<dim>::stress(const StrainRows<dim>& strains, const StressRows<dim>& stresses) const {
  set_to_zero<dim>(stresses);
  constexpr auto indices = voigt_indices<dim>();
  visit_deformations<dim>(energy_, strains, [&](size_t point, const Mat<dim>& f, const auto& r) {
    const Mat<dim> second = times<dim>(inverse<dim>(f), r.piola);
    for (int k = 0; k < n_strains<dim>; ++k) stresses[k][point] = second[indices[k][0]][indices[k][1]];
  });
}

template <int dim>
void HyperelasticLaw<dim>::tangent(const StrainRows<dim>& strains, const TangentRows<dim>& tangents) const {
  for (const auto& rows : tangents) set_to_zero<dim>(rows);
  constexpr auto indices = voigt_indices<dim>();
  visit_deformations<dim>(energy_, strains, [&](size_t point, const Mat<dim>& f, const auto& r) {
    // dP_ij / dF_kl = delta_ik S_jl + F_im F_kn dS_mj / dE_nl
    const Mat<dim> inverse_f = inverse<dim>(f), second = times<dim>(inverse_f, r.piola);
    for (int a = 0; a < n_strains<dim>; ++a)
      for (int b = 0; b < n_strains<dim>; ++b) {
        const auto [m, j] = indices[a];
        const auto [n, l] = indices[b];
        double sum = 0;
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k)
            sum += inverse_f[m][i] * inverse_f[n][k] *
                   (r.tangent[dim * i + j][dim * k + l] - (i == k ? second[j][l] : 0));
        tangents[a][b][point] = sum;
      }
  });
}

template <int dim>
void HyperelasticLaw<dim>::energy_density(const StrainRows<dim>& strains, std::span<double> densities) const {
  std::ranges::fill(densities, std::numeric_limits<double>::infinity());
  visit_deformations<dim>(energy_, strains,
                          [&](size_t point, const Mat<dim>&, const auto& r) { densities[point] = r.energy; });
}

template <int dim>
void HyperelasticLaw<dim>::squared_von_mises(const StrainRows<dim>& strains,
                                             std::span<double> squares) const {
  std::ranges::fill(squares, 0.0);
  visit_deformations<dim>(energy_, strains, [&](size_t point, const Mat<dim>& f, const auto& r) {
    squares[point] = TrueStress<dim>(r, f).squared_von_mises();
  });
}

template <int dim>
void HyperelasticLaw<dim>::squared_von_mises_slope(const StrainRows<dim>& strains,
                                                   const StressRows<dim>& slopes) const {
  set_to_zero<dim>(slopes);
  constexpr auto indices = voigt_indices<dim>();
  visit_deformations<dim>(energy_, strains, [&](size_t point, const Mat<dim>& f, const auto& r) {
    // The square is 3/2 s:s with d(sigma) = (dP F^T + P dF^T) / J - sigma d(ln J).
    const TrueStress<dim> now(r, f);
    const Mat<dim> inverse_f = inverse<dim>(f);
    const double j = determinant<dim>(f) * r.axial_stretch;
    const double along_volume =
        product<dim>(now.deviator, now.stress) + now.axial_deviator * now.axial;  // s:sigma
    const Mat<dim> on_piola = times<dim>(now.deviator, f);                        // s F
    const Mat<dim> on_deformation = times<dim>(now.deviator, r.piola);            // s P
    AxialSlopes axial;
    if constexpr (dim == 2) axial = axial_slopes(energy_, f);
    Mat<dim> by_f;
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l) {
        double sum = on_deformation[k][l] / j - along_volume * inverse_f[l][k];
        for (int i = 0; i < dim; ++i)
          for (int m = 0; m < dim; ++m) sum += on_piola[i][m] * r.tangent[dim * i + m][dim * k + l] / j;
        if constexpr (dim == 2)
          sum += now.axial_deviator * axial.piola[k][l] * r.axial_stretch / j -
                 along_volume * axial.stretch[k][l] / r.axial_stretch;
        by_f[k][l] = 3 * sum;
      }
    const Mat<dim> by_strain = times<dim>(inverse_f, by_f);  // symmetric
    for (int k = 0; k < n_strains<dim>; ++k) slopes[k][point] = by_strain[indices[k][0]][indices[k][1]];
  });
}

template <int dim>
void HyperelasticLaw<dim>::along_axle(const StrainRows<dim>& strains, std::span<double> axial_stresses,
                                      std::span<double> axial_strains) const {
  std::ranges::fill(axial_stresses, 0.0);
  std::ranges::fill(axial_strains, 0.0);
  visit_deformations<dim>(energy_, strains, [&](size_t point, const Mat<dim>& f, const auto& r) {
    if (!r.admissible) return;
    axial_stresses[point] = TrueStress<dim>(r, f).axial;
    axial_strains[point] = 0.5 * (r.axial_stretch * r.axial_stretch - 1);
  });
}

template class HyperelasticLaw<2>;
template class HyperelasticLaw<3>;

}  // namespace wheelwright
