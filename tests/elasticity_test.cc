#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/von_mises.h"
#include "wheelwright/mechanics/elasticity/element.h"

namespace wheelwright {
namespace {

template <int dim>
PolarGrid<dim> coarse_grid(int refinement = 1) {
  PolarGrid<dim> grid{0.20, 0.34, 0.12, 16, {}};
  grid.cells.fill(2 * refinement);
  return grid;
}

const Material material{200e6, 0.48}, rubber{200e6, 0.4999};

/// A displacement, Cartesian in the frame of the first column.
template <int dim>
using Field = std::function<Vec<dim>(const Vec<dim>&)>;

/// Nodal values of a field on a cell, as the cell's dofs.
template <int dim>
std::vector<double> interpolate(const PolarGrid<dim>& grid, int degree, const std::array<int, dim>& cell,
                                const Field<dim>& field) {
  const Lattice<dim> lattice(grid, degree);
  std::vector<double> dofs;
  for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) {
    auto p = local_node_position<dim>(degree, a);
    for (int d = 0; d < dim; ++d) p[d] += degree * cell[d];
    const Vec<dim> polar = lattice.polar_point(p);
    const Vec<dim> u = rotated<dim>(field(cartesian<dim>(polar)), -polar[1]);
    dofs.insert(dofs.end(), u.begin(), u.end());
  }
  return dofs;
}

double energy(const Matrix& k, const std::vector<double>& u) {
  double sum = 0;
  for (int j = 0; j < k.columns(); ++j)
    for (int i = 0; i < k.rows(); ++i) sum += u[i] * k(i, j) * u[j];
  return sum;
}

/// The energy that rounding alone could leave: sum |u_i k_ij u_j|.
double energy_scale(const Matrix& k, const std::vector<double>& u) {
  double sum = 0;
  for (int j = 0; j < k.columns(); ++j)
    for (int i = 0; i < k.rows(); ++i) sum += std::abs(u[i] * k(i, j) * u[j]);
  return sum;
}

/// u = A x with a general matrix.
template <int dim>
Mat<dim> some_gradient() {
  Mat<dim> a;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) a[i][j] = 0.3 + i - 0.7 * j + 0.1 * i * j;
  return a;
}

template <int dim>
Vec<dim> times(const Mat<dim>& a, const Vec<dim>& x) {
  Vec<dim> result{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) result[i] += a[i][j] * x[j];
  return result;
}

/// Voigt strain of u = A x.
template <int dim>
Voigt<dim> strain_of(const Mat<dim>& a) {
  if constexpr (dim == 2)
    return {a[0][0], a[1][1], a[0][1] + a[1][0]};
  else
    return {a[0][0], a[1][1], a[2][2], a[1][2] + a[2][1], a[0][2] + a[2][0], a[0][1] + a[1][0]};
}

template <int dim>
std::vector<Field<dim>> rigid_motions() {
  std::vector<Field<dim>> motions;
  for (int d = 0; d < dim; ++d) {
    motions.push_back([d](const Vec<dim>&) {
      Vec<dim> u{};
      u[d] = 1;
      return u;
    });
    for (int e = 0; e < d; ++e)
      motions.push_back([d, e](const Vec<dim>& x) {
        Vec<dim> u{};
        u[d] = x[e];
        u[e] = -x[d];
        return u;
      });
  }
  return motions;
}

template <class Dimension>
class Element : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Element, Dimensions);

/// Degree and material: the last is of projected dilatation.
const std::pair<int, Material> elements[] = {{1, material}, {2, material}, {2, rubber}};

TYPED_TEST(Element, RigidMotionsHaveNoEnergy) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  for (const auto& [degree, made_of] : elements) {
    std::array<int, dim> cell{};
    cell[1] = 1;
    const ElasticElement<dim> element(grid, degree, cell, IsotropicLaw<dim>(made_of));
    const Matrix k =
        cell_stiffness<dim>(element, IsotropicLaw<dim>(made_of), unit_cell_rule<dim>(degree + 2));
    for (const auto& motion : rigid_motions<dim>()) {
      const auto u = interpolate<dim>(grid, degree, cell, motion);
      EXPECT_LT(std::abs(energy(k, u)), 1e-13 * energy_scale(k, u));
    }
    for (int j = 0; j < k.columns(); ++j)
      for (int i = 0; i < j; ++i) EXPECT_EQ(k(i, j), k(j, i));
  }
}

TYPED_TEST(Element, StrainOfALinearFieldIsExact) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  const Mat<dim> a = some_gradient<dim>();
  for (const auto& [degree, made_of] : elements) {
    const std::array<int, dim> cell{1};  // of the first column: its frame is that of the field
    const ElasticElement<dim> element(grid, degree, cell, IsotropicLaw<dim>(made_of));
    const auto u = interpolate<dim>(grid, degree, cell, [&](const Vec<dim>& x) { return times<dim>(a, x); });
    for (const auto& q : unit_cell_rule<dim>(3)) {
      const auto at = element.at(q.xi);
      const Vec<dim> expected = times<dim>(a, at.position);
      for (int d = 0; d < dim; ++d) {
        double value = 0;
        for (int i = 0; i < element.n_dofs(); ++i) value += at.displacement[d][i] * u[i];
        EXPECT_NEAR(value, expected[d], 1e-13);
      }
      const Voigt<dim> expected_strain = strain_of<dim>(a);
      for (int s = 0; s < n_strains<dim>; ++s) {
        double value = 0;
        for (int i = 0; i < element.n_dofs(); ++i) value += at.strain[s][i] * u[i];
        EXPECT_NEAR(value, expected_strain[s], 1e-12);
      }
    }
  }
}

TYPED_TEST(Element, EnergyOfALinearFieldIsExact) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  const Mat<dim> a = some_gradient<dim>();
  const Voigt<dim> e = strain_of<dim>(a);
  for (const auto& [degree, made_of] : elements) {
    const std::array<int, dim> cell{1};
    const ElasticElement<dim> element(grid, degree, cell, IsotropicLaw<dim>(made_of));
    const auto rule = unit_cell_rule<dim>(degree + 2);
    const Voigt<dim> sigma = stress<dim>(made_of, e);
    double density = 0, measure = 0;
    for (int s = 0; s < n_strains<dim>; ++s) density += sigma[s] * e[s];
    for (const auto& q : rule) measure += q.weight * element.at(q.xi).determinant;
    const auto u = interpolate<dim>(grid, degree, cell, [&](const Vec<dim>& x) { return times<dim>(a, x); });
    EXPECT_NEAR(energy(cell_stiffness<dim>(element, IsotropicLaw<dim>(made_of), rule), u), density * measure,
                1e-11 * density * measure);
  }
}

/// In a nearly incompressible material: what is left of div u is orthogonal to the linear functions of x, in
/// the whole cell and in a part of it; the rest of the strain is that of u.
TYPED_TEST(Element, TheDilatationIsProjectedOnLinearFunctions) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  const std::array<int, dim> cell{1};
  const ElasticElement<dim> element(grid, 2, cell, IsotropicLaw<dim>(rubber)),
      plain(grid, 2, cell, IsotropicLaw<dim>(material), DilatationKind::pointwise);
  EXPECT_TRUE(element.projects_dilatation());
  EXPECT_FALSE(plain.projects_dilatation());
  const auto whole = unit_cell_rule<dim>(4);
  for (int dof = 0; dof < element.n_dofs(); ++dof) {
    std::array<double, dim + 1> moments{}, scale{};
    for (const auto& q : whole) {
      const auto at = element.at(q.xi), of_u = plain.at(q.xi);
      double trace = 0, dilatation = 0;
      for (int d = 0; d < dim; ++d) {
        trace += at.strain[d][dof];
        dilatation += of_u.strain[d][dof];
      }
      EXPECT_NEAR(at.dilatation[dof], dilatation, 1e-12 * (1 + std::abs(dilatation)));
      for (int s = 0; s < n_strains<dim>; ++s) {
        const double share = s < dim ? 1.0 / dim : 0;
        EXPECT_NEAR(at.strain[s][dof] - share * trace, of_u.strain[s][dof] - share * dilatation, 1e-11);
      }
      for (int a = 0; a <= dim; ++a) {
        const double weight = q.weight * at.determinant * (a == 0 ? 1 : at.position[a - 1]);
        moments[a] += weight * (trace - dilatation);
        scale[a] += std::abs(weight * dilatation);
      }
    }
    for (int a = 0; a <= dim; ++a) EXPECT_LT(std::abs(moments[a]), 1e-10 * scale[a]);
  }
}

/// A layer of this thickness, in parts of the cell: quadrature points and weights.
template <int dim>
std::vector<ReferencePoint<dim>> layer(double thickness) {
  auto rule = unit_cell_rule<dim>(4);
  for (auto& q : rule) {
    q.xi[0] *= thickness;
    q.weight *= thickness;
  }
  return rule;
}

TYPED_TEST(Element, TheDilatationOfAPartOfTheCellIsProjectedOnIt) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  const std::array<int, dim> cell{1};
  const ElasticElement<dim> element(grid, 2, cell, IsotropicLaw<dim>(rubber));
  const auto linear =
      interpolate<dim>(grid, 2, cell, [&](const Vec<dim>& x) { return times<dim>(some_gradient<dim>(), x); });
  double dilatation = 0;
  for (int d = 0; d < dim; ++d) dilatation += some_gradient<dim>()[d][d];
  for (const double thickness : {1.0, 0.3, 1e-3, 1e-6, 1e-9, 1e-12}) {
    const auto part = layer<dim>(thickness);
    const auto projection = element.project_dilatation(part);
    const auto value = [&](const std::vector<double>& u, const auto& at) {
      const auto functions = element.linear_functions(at.position);
      double sum = 0;
      for (int i = 0; i < element.n_dofs(); ++i)
        for (int a = 0; a <= dim; ++a) sum += functions[a] * projection(a, i) * u[i];
      return sum;
    };
    for (const auto& q : part)
      EXPECT_NEAR(value(linear, element.at(q.xi)), dilatation, 1e-9 * std::abs(dilatation)) << thickness;
    std::vector<double> u(element.n_dofs());
    u[0] = 1;
    std::array<double, dim + 1> moments{}, scale{};
    for (const auto& q : part) {
      const auto at = element.at(q.xi);
      const auto functions = element.linear_functions(at.position);
      for (int a = 0; a <= dim; ++a) {
        const double weight = q.weight * at.determinant * functions[a];
        moments[a] += weight * (value(u, at) - at.dilatation[0]);
        scale[a] += std::abs(weight * at.dilatation[0]);
      }
    }
    for (int a = 0; a <= dim; ++a) EXPECT_LT(std::abs(moments[a]), 1e-7 * scale[a]) << thickness;
  }
}

TYPED_TEST(Element, StressIsThatOfTheLameParameters) {
  constexpr int dim = TypeParam::value;
  // A dilation: sigma = (dim lambda + 2 mu) I; a shear: sigma_01 = 2 mu e_01.
  Voigt<dim> dilation{}, shear{};
  for (int d = 0; d < dim; ++d) dilation[d] = 1;
  shear[n_strains<dim> - 1] = 1;
  const auto of_dilation = stress<dim>(material, dilation), of_shear = stress<dim>(material, shear);
  for (int d = 0; d < dim; ++d) {
    EXPECT_NEAR(of_dilation[d], dim * 1621.62162e6 + 2 * 67.567568e6, 10);
    EXPECT_EQ(of_shear[d], 0);
  }
  EXPECT_NEAR(of_shear[n_strains<dim> - 1], 67.567568e6, 1);
  EXPECT_NEAR(testing::von_mises<dim>(material, of_shear), std::sqrt(3.0) * 67.567568e6, 2);
  Vec<dim> normal{};
  normal[1] = 1;
  EXPECT_NEAR((traction<dim>(of_shear, normal)[0]), 67.567568e6, 1);
}

/// The law in the plane against that in three dimensions, with what is zero along the axle put in.
class InThePlane : public ::testing::TestWithParam<Plane> {};
INSTANTIATE_TEST_SUITE_P(StrainAndStress, InThePlane, ::testing::Values(Plane::strain, Plane::stress));

TEST_P(InThePlane, StressIsThatOfThreeDimensions) {
  const Material in_plane{200e6, 0.48, GetParam()}, in_space{200e6, 0.48};
  const Voigt<2> e{0.3, -0.7, 0.4};
  const double axial = in_plane.axial_strain_ratio() * (e[0] + e[1]);
  const Voigt<2> s2 = stress<2>(in_plane, e);
  const Voigt<3> s3 = stress<3>(in_space, {e[0], e[1], axial, 0, 0, e[2]});
  EXPECT_EQ(GetParam() == Plane::strain, axial == 0);
  if (GetParam() == Plane::stress) {
    EXPECT_NEAR(s3[2], 0, 1e-12 * std::abs(s3[0]));
  }
  EXPECT_NEAR(s2[0], s3[0], 1e-12 * std::abs(s3[0]));
  EXPECT_NEAR(s2[1], s3[1], 1e-12 * std::abs(s3[1]));
  EXPECT_NEAR(s2[2], s3[5], 1e-12 * std::abs(s3[5]));
  EXPECT_NEAR(in_plane.axial_stress_ratio() * (s2[0] + s2[1]), s3[2], 1e-12 * std::abs(s3[0]));
  EXPECT_NEAR(testing::von_mises<2>(in_plane, s2), testing::von_mises<3>(in_space, s3),
              1e-12 * std::abs(s3[0]));
}

TEST(PlaneStress, AUniaxialStressStretchesByYoungsModulus) {
  const Material sheet{200e6, 0.48, Plane::stress};
  const Voigt<2> s = stress<2>(sheet, {1, -0.48, 0});
  EXPECT_NEAR(s[0], 200e6, 1e-12 * 200e6);
  EXPECT_NEAR(s[1], 0, 1e-12 * 200e6);
  EXPECT_NEAR(testing::von_mises<2>(sheet, s), 200e6, 1e-12 * 200e6);
  EXPECT_NEAR(sheet.contact_modulus(), 200e6, 1e-12 * 200e6);
}

TEST(PlaneStress, HasAnEquivalentInPlaneStrain) {
  const Material sheet{200e6, 0.48, Plane::stress}, equivalent = sheet.plane_strain_equivalent();
  EXPECT_EQ(equivalent.plane, Plane::strain);
  EXPECT_NEAR(equivalent.youngs_modulus, 200e6 * 1.96 / (1.48 * 1.48), 1e-12 * 200e6);
  EXPECT_NEAR(equivalent.poissons_ratio, 0.48 / 1.48, 1e-15);
  EXPECT_NEAR(equivalent.mu(), sheet.mu(), 1e-12 * sheet.mu());
  const Material wide{200e6, 0.48};
  EXPECT_EQ(wide.plane_strain_equivalent(), wide);
}

/// Both cells of a face in mid-grid.
template <int dim>
struct Face {
  std::array<int, dim> minus, plus;
  double angle;  ///< between their frames

  Face(const PolarGrid<dim>& grid, int axis) : minus{}, plus{} {
    plus[axis] = 1;
    angle = axis == 1 ? grid.column_angle() : 0.0;
  }

  std::vector<double> interpolate_both(const PolarGrid<dim>& grid, int degree,
                                       const Field<dim>& field) const {
    auto u = interpolate<dim>(grid, degree, minus, field);
    const auto of_plus = interpolate<dim>(grid, degree, plus, field);
    u.insert(u.end(), of_plus.begin(), of_plus.end());
    return u;
  }
};

TYPED_TEST(Element, GhostPenaltyVanishesForLinearFields) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  const Mat<dim> a = some_gradient<dim>();
  for (const auto& [degree, made_of] : elements)
    for (GhostPenaltyKind kind : {GhostPenaltyKind::full, GhostPenaltyKind::paper})
      for (int axis = 0; axis < dim; ++axis) {
        const Face<dim> face(grid, axis);
        const ElasticElement<dim> minus(grid, degree, face.minus, IsotropicLaw<dim>(made_of)),
            plus(grid, degree, face.plus, IsotropicLaw<dim>(made_of));
        const Matrix k =
            ghost_stiffness<dim>(minus, plus, axis, face.angle, IsotropicLaw<dim>(made_of), {kind, 1});
        const auto u =
            face.interpolate_both(grid, degree, [&](const Vec<dim>& x) { return times<dim>(a, x); });
        EXPECT_LT(std::abs(energy(k, u)), 1e-13 * energy_scale(k, u)) << degree << axis;
      }
}

// The penalty of a face between sectors is the minimum of its halves over the derivatives on the face.
TYPED_TEST(Element, HalvesOfAGhostPenaltySumToTheWhole) {
  constexpr int dim = TypeParam::value;
  const auto grid = coarse_grid<dim>();
  for (const auto& [degree, made_of] : elements)
    for (GhostPenaltyKind kind : {GhostPenaltyKind::full, GhostPenaltyKind::paper}) {
      SCOPED_TRACE(degree);
      const Face<dim> face(grid, 1);
      const ElasticElement<dim> element(grid, degree, face.minus, IsotropicLaw<dim>(made_of));
      const GhostPenalty ghost{kind, 1};
      const Matrix whole =
          ghost_stiffness<dim>(element, element, 1, face.angle, IsotropicLaw<dim>(made_of), ghost);
      const auto halves =
          divided_ghost_stiffness<dim>(element, face.angle, IsotropicLaw<dim>(made_of), ghost);
      const int n = element.n_dofs(), n_shared = halves.minus.rows() - n;
      const auto in_sum = [&](int k, int first) { return k < n ? first + k : n + k; };
      Matrix sum(2 * n + n_shared, 2 * n + n_shared);
      for (int j = 0; j < n + n_shared; ++j)
        for (int i = 0; i < n + n_shared; ++i) {
          sum(in_sum(i, 0), in_sum(j, 0)) += halves.minus(i, j);
          sum(in_sum(i, n), in_sum(j, n)) += halves.plus(i, j);
        }
      // The displacement of the face's nodes is one.
      Matrix glue(2 * n, 2 * n);
      for (int i = 0; i < 2 * n; ++i) glue(i, i) = 1;
      for (int a = 0; a < element.n_nodes(); ++a) {
        const auto p = local_node_position<dim>(degree, a);
        if (p[1] != 0) continue;
        const int b = a + degree * (degree + 1);
        ASSERT_EQ((local_node_position<dim>(degree, b)[1]), degree);
        for (int c = 0; c < dim; ++c) {
          glue(n + element.dof(a, c), n + element.dof(a, c)) = 0;
          glue(n + element.dof(a, c), element.dof(b, c)) = 1;
        }
      }
      // Gaussian elimination of the derivatives.
      for (int k = 2 * n + n_shared - 1; k >= 2 * n; --k) {
        ASSERT_GT(sum(k, k), 0);
        for (int j = 0; j < k; ++j)
          for (int i = 0; i < k; ++i) sum(i, j) -= sum(i, k) * sum(k, j) / sum(k, k);
      }
      const Matrix expected =
                       product(glue, Op::transpose, product(whole, Op::none, glue, Op::none), Op::none),
                   found =
                       product(glue, Op::transpose,
                               product(block(sum, 0, 0, 2 * n, 2 * n), Op::none, glue, Op::none), Op::none);
      double largest = 0, difference = 0;
      for (int j = 0; j < 2 * n; ++j)
        for (int i = 0; i < 2 * n; ++i) {
          largest = std::max(largest, std::abs(expected(i, j)));
          difference = std::max(difference, std::abs(expected(i, j) - found(i, j)));
        }
      EXPECT_LT(difference, 1e-12 * largest);
    }
}

TEST(Ghost, PenalizesTheJumpOfTheStress) {
  // A radial kink: u_r = max(r - r_face, 0). The stress on the face jumps by (lambda + 2 mu) on the normal,
  // so that the energy is xi h / (2 E) (lambda + 2 mu)^2 |F|, up to the curvature of one cell.
  for (int degree : {1, 2}) {
    const auto grid = coarse_grid<2>(16);
    const Face<2> face(grid, 0);
    const ElasticElement<2> minus(grid, degree, face.minus, IsotropicLaw<2>(material)),
        plus(grid, degree, face.plus, IsotropicLaw<2>(material));
    const double radius = grid.inner_radius + grid.row_height(0), xi = 0.37;
    const Field<2> kink = [&](const Vec<2>& x) {
      const double r = norm<2>(x), u = std::max(r - radius, 0.0) / r;
      return Vec<2>{u * x[0], u * x[1]};
    };
    const Matrix k = ghost_stiffness<2>(minus, plus, 0, face.angle, IsotropicLaw<2>(material),
                                        {GhostPenaltyKind::paper, xi});
    const double h = 0.5 * (minus.size_across(0) + plus.size_across(0));
    const double jump = material.lambda() + 2 * material.mu();
    const double expected =
        xi * h / (2 * material.youngs_modulus) * jump * jump * radius * grid.column_angle();
    EXPECT_NEAR(energy(k, face.interpolate_both(grid, degree, kink)), expected, 5e-3 * expected) << degree;
  }
}

TEST(Ghost, PenalizesTheJumpOfTheSecondDerivative) {
  // u_r = 1/2 max(r - r_face, 0)^2 jumps by one in its second normal derivative, and not in its first.
  const auto grid = coarse_grid<2>(16);
  const Face<2> face(grid, 0);
  const ElasticElement<2> minus(grid, 2, face.minus, IsotropicLaw<2>(material)),
      plus(grid, 2, face.plus, IsotropicLaw<2>(material));
  const double radius = grid.inner_radius + grid.row_height(0), xi = 0.37;
  const Field<2> bend = [&](const Vec<2>& x) {
    const double r = norm<2>(x), s = std::max(r - radius, 0.0), u = 0.5 * s * s / r;
    return Vec<2>{u * x[0], u * x[1]};
  };
  const Matrix k =
      ghost_stiffness<2>(minus, plus, 0, face.angle, IsotropicLaw<2>(material), {GhostPenaltyKind::full, xi});
  const double h = 0.5 * (minus.size_across(0) + plus.size_across(0));
  const double expected = 0.5 * xi * h * h * h * material.youngs_modulus * radius * grid.column_angle();
  EXPECT_NEAR(energy(k, face.interpolate_both(grid, 2, bend)), expected, 5e-3 * expected);
}

// A quadratic field is not in the isoparametric space. Two cells of one column have one map, so that its
// interpolant is smooth across their face; across an azimuthal face its second derivative jumps by O(h), and
// the penalty decays as h^3 h^2 |F|, against h^3 |F| for a field that jumps.
TEST(Ghost, QuadraticFieldsJumpByTheOrderOfTheGeometry) {
  const Field<2> quadratic = [](const Vec<2>& x) {
    return Vec<2>{x[0] * x[0] - 0.4 * x[0] * x[1], 0.7 * x[1] * x[1] + 0.2 * x[0] * x[0]};
  };
  for (int axis : {0, 1}) {
    std::vector<double> penalties;
    for (int refinement : {2, 4, 8, 16}) {
      const auto grid = coarse_grid<2>(refinement);
      const Face<2> face(grid, axis);
      const ElasticElement<2> minus(grid, 2, face.minus, IsotropicLaw<2>(material)),
          plus(grid, 2, face.plus, IsotropicLaw<2>(material));
      const Matrix k = ghost_stiffness<2>(minus, plus, axis, face.angle, IsotropicLaw<2>(material),
                                          {GhostPenaltyKind::full, 1});
      const auto u = face.interpolate_both(grid, 2, quadratic);
      penalties.push_back(energy(k, u));
      if (axis == 0) {
        EXPECT_LT(std::abs(penalties.back()), 1e-13 * energy_scale(k, u));
      }
    }
    for (size_t i = 0; axis == 1 && i + 1 < penalties.size(); ++i)
      EXPECT_GT(std::log2(penalties[i] / penalties[i + 1]), 5.8);
  }
}

}  // namespace
}  // namespace wheelwright
