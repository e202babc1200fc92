// The estimate of what linear theory neglects, against exact solutions of large deformations.

#include "wheelwright/quantities/analysis/linear_theory_error.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tests/large_deformation.h"
#include "tests/support.h"
#include "wheelwright/mechanics/elasticity/isotropic_law.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/quantities/analysis/position_deformation.h"

namespace wheelwright {
namespace {

using std::numbers::pi;

double observed_order(double error, double error_of_half) { return std::log2(error / error_of_half); }

// --- The density ---------------------------------------------------------------------------------------

template <int dim>
Mat<dim> product(const Mat<dim>& a, const Mat<dim>& b) {
  Mat<dim> result{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k) result[i][j] += a[i][k] * b[k][j];
  return result;
}

template <int dim>
Mat<dim> transposed(const Mat<dim>& m) {
  Mat<dim> result;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) result[i][j] = m[j][i];
  return result;
}

/// a + factor b.
template <int dim>
Mat<dim> sum(Mat<dim> a, double factor, const Mat<dim>& b) {
  for (int i = 0; i < dim; ++i) a[i] += factor * b[i];
  return a;
}

template <int dim>
Voigt<dim> voigt(const Mat<dim>& m) {
  if constexpr (dim == 2)
    return {m[0][0], m[1][1], m[0][1] + m[1][0]};
  else
    return {m[0][0], m[1][1], m[2][2], m[1][2] + m[2][1], m[0][2] + m[2][0], m[0][1] + m[1][0]};
}

template <int dim>
Vec<dim*(dim - 1) / 2> rotation(const Mat<dim>& gradient) {
  if constexpr (dim == 2)
    return {0.5 * (gradient[1][0] - gradient[0][1])};
  else
    return {0.5 * (gradient[2][1] - gradient[1][2]), 0.5 * (gradient[0][2] - gradient[2][0]),
            0.5 * (gradient[1][0] - gradient[0][1])};
}

template <int dim>
ExpandedEnergy expansion(const MaterialLaw<dim>& law, const Mat<dim>& gradient) {
  const Voigt<dim> strain = voigt<dim>(gradient);
  return expanded_energy<dim>(stress<dim>(law, strain), strain, rotation<dim>(gradient));
}

/// Green's strain of a displacement gradient.
template <int dim>
Mat<dim> green(const Mat<dim>& gradient) {
  const Mat<dim> transpose = transposed<dim>(gradient);
  Mat<dim> strain = sum<dim>(sum<dim>(gradient, 1, transpose), 1, product<dim>(transpose, gradient));
  for (auto& row : strain) row = 0.5 * row;
  return strain;
}

/// Hencky's strain, 1/2 log(F^T F), of a small displacement gradient.
template <int dim>
Mat<dim> hencky(const Mat<dim>& gradient) {
  const Mat<dim> twice_green = sum<dim>(green<dim>(gradient), 1, green<dim>(gradient));
  Mat<dim> power = twice_green, result{};
  for (int n = 1; n < 30; ++n) {
    result = sum<dim>(result, (n % 2 == 1 ? 0.5 : -0.5) / n, power);
    power = product<dim>(power, twice_green);
  }
  return result;
}

template <int dim>
double energy(const MaterialLaw<dim>& law, const Mat<dim>& strain) {
  double density;
  law.energy_density(one_strain<dim>(voigt<dim>(strain)), {&density, 1});
  return density;
}

template <int dim>
Mat<dim> scaled(double factor, Mat<dim> m) {
  for (auto& row : m) row = factor * row;
  return m;
}

template <int dim>
Mat<dim> random_gradient(std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  Mat<dim> m;
  for (auto& row : m)
    for (double& x : row) x = entry(random);
  return m;
}

template <int dim>
std::vector<IsotropicLaw<dim>> laws() {
  std::vector<IsotropicLaw<dim>> all{IsotropicLaw<dim>({3, 0.3}), IsotropicLaw<dim>({2, 0.48})};
  if (dim == 2) all.push_back(IsotropicLaw<dim>({3, 0.4, Plane::stress}));
  return all;
}

// Half of the difference of the energies under a displacement and its opposite has no terms of even order.
template <int dim>
void expect_the_third_order() {
  std::mt19937 random(1);
  for (const IsotropicLaw<dim>& law : laws<dim>())
    for (int k = 0; k < 20; ++k) {
      const Mat<dim> g = random_gradient<dim>(random);
      const auto odd_part = [&](double t, Mat<dim> (*strain)(const Mat<dim>&)) {
        return 0.5 *
               (energy<dim>(law, strain(scaled<dim>(t, g))) - energy<dim>(law, strain(scaled<dim>(-t, g))));
      };
      const ExpandedEnergy e = expansion<dim>(law, g);
      EXPECT_NEAR(odd_part(1, green<dim>), e.of_rotation + e.of_strain, 1e-12 * e.linear);  // no fifth order
      const double t = 1e-3;
      EXPECT_NEAR(odd_part(t, hencky<dim>) / (t * t * t), e.of_rotation - e.of_strain, 1e-4 * e.linear);
      EXPECT_NEAR(e.linear, energy<dim>(law, scaled<dim>(0.5, sum<dim>(g, 1, transposed<dim>(g)))), 1e-12);
    }
}

TEST(LinearTheoryError, DensitiesAreTheTermsOfGreensAndHenckysLaws) {
  expect_the_third_order<2>();
  expect_the_third_order<3>();
}

TEST(LinearTheoryError, DensitiesDoNotDependOnTheFrame) {
  std::mt19937 random(2);
  const IsotropicLaw<3> law({3, 0.3});
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Mat<3> about_z{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}, about_x{{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
  const Mat<3> q = product<3>(about_x, about_z);
  for (int k = 0; k < 10; ++k) {
    const Mat<3> g = random_gradient<3>(random);
    const auto a = expansion<3>(law, g),
               b = expansion<3>(law, product<3>(q, product<3>(g, transposed<3>(q))));
    EXPECT_NEAR(a.linear, b.linear, 1e-13 * a.linear);
    EXPECT_NEAR(a.of_rotation, b.of_rotation, 1e-13 * a.linear);
    EXPECT_NEAR(a.of_strain, b.of_strain, 1e-13 * a.linear);
    EXPECT_NEAR(a.of_bending, b.of_bending, 1e-13 * a.linear);
  }
}

// In isotropic materials the rotation works on the stress in the plane in which it turns.
TEST(LinearTheoryError, RotationWorksOnTheStressInItsPlane) {
  std::mt19937 random(3);
  for (const IsotropicLaw<3>& law : laws<3>()) {
    const Mat<3> g = random_gradient<3>(random);
    const Vec<3> w = rotation<3>(g);
    const Voigt<3> t = stress<3>(law, voigt<3>(g));
    const double along = t[0] * w[0] * w[0] + t[1] * w[1] * w[1] + t[2] * w[2] * w[2] +
                         2 * (t[3] * w[1] * w[2] + t[4] * w[0] * w[2] + t[5] * w[0] * w[1]);
    EXPECT_NEAR(expansion<3>(law, g).of_rotation, 0.5 * (dot(w, w) * (t[0] + t[1] + t[2]) - along), 1e-12);
  }
}

// A bar of a material whose stress is linear in Green's strain needs E e (1 + e)(1 + e/2) per area, and by
// Hencky's law E log(1 + e) / (1 + e), with e its elongation.
TEST(LinearTheoryError, OfABarHasSecondOrder) {
  const double young = 5, nu = 0.35;
  const IsotropicLaw<3> law({young, nu});
  const auto errors = [&](double e) {
    const auto estimate =
        linear_theory_error(expansion<3>(law, {{{e, 0, 0}, {0, -nu * e, 0}, {0, 0, -nu * e}}}));
    EXPECT_EQ(estimate.of_rotation, 0);
    return Vec<2>{(1 + e) * (1 + e / 2) - 1 - estimate.of_strain,
                  std::log1p(e) / (1 + e) / e - 1 + estimate.of_strain};
  };
  for (const double e : {0.01, -0.01}) {
    const Vec<2> whole = errors(e), half = errors(e / 2);
    for (int law_of = 0; law_of < 2; ++law_of) EXPECT_GT(observed_order(whole[law_of], half[law_of]), 1.9);
  }
}

TEST(LinearTheoryError, FallsToTheLimitAtTheShareWithin) {
  for (const LinearTheoryError& e :
       {LinearTheoryError{-0.3, 0.1, 0.2}, LinearTheoryError{0, 0, 0.5}, LinearTheoryError{0.2, -0.2, 0}}) {
    const double s = share_within(e, 0.1);
    EXPECT_NEAR((LinearTheoryError{s * e.of_rotation, s * e.of_strain, s * s * e.of_bending}).size(), 0.1,
                1e-14);
  }
  EXPECT_EQ(share_within({0.05, 0, 0.05}, 0.1), 1);
}

// --- A ring whose deformation is axially symmetric -----------------------------------------------------

/// A ring in plane strain whose stress is linear in Green's strain; every point is pulled away from the axle
/// by pull R per volume.
struct Ring {
  double inner, outer;
  Material material;
  double pull;
};

/// The place r of a circle of radius R, the radial stress on its undeformed area, and the work of the pull up
/// to there.
using Circle = std::array<double, 3>;

/// By Newton's method.
double radial_stretch(const Ring& ring, double radial_stress, double hoop_strain) {
  const double lambda = ring.material.lambda(), mu = ring.material.mu();
  double stretch = 1;
  for (int k = 0; k < 50; ++k) {
    const double second = (lambda + 2 * mu) * 0.5 * (stretch * stretch - 1) + lambda * hoop_strain;
    stretch -= (stretch * second - radial_stress) / (second + (lambda + 2 * mu) * stretch * stretch);
  }
  return stretch;
}

Circle slope(const Ring& ring, double radius, const Circle& at) {
  const double lambda = ring.material.lambda(), mu = ring.material.mu();
  const double hoop = at[0] / radius, hoop_strain = 0.5 * (hoop * hoop - 1);
  const double stretch = radial_stretch(ring, at[1], hoop_strain);
  const double hoop_stress =
      hoop * ((lambda + 2 * mu) * hoop_strain + lambda * 0.5 * (stretch * stretch - 1));
  return {stretch, -(at[1] - hoop_stress) / radius - ring.pull * radius,
          2 * pi * ring.pull * radius * (at[0] - radius) * radius};
}

/// One step of Runge and Kutta.
template <std::size_t n, class Slope>
std::array<double, n> stepped(double x, const std::array<double, n>& y, double h, const Slope& slope) {
  const auto a = slope(x, y), b = slope(x + h / 2, y + h / 2 * a), c = slope(x + h / 2, y + h / 2 * b),
             d = slope(x + h, y + h * c);
  return y + h / 6 * (a + 2.0 * b + 2.0 * c + d);
}

/// A root by secants from two guesses.
double root(const std::function<double(double)>& f, double a, double b) {
  double of_a = f(a), of_b = f(b);
  for (int k = 0; k < 50 && of_a != of_b; ++k) {
    const double next = b - of_b * (b - a) / (of_b - of_a);
    a = b;
    of_a = of_b;
    b = next;
    of_b = f(b);
  }
  return b;
}

struct RingResponse {
  double stress;  ///< at the inner edge
  double work;    ///< of the pull
};

/// The outer edge is free, the inner one displaced.
RingResponse response(const Ring& ring, double inner_displacement) {
  constexpr int steps = 400;
  const auto outer_circle = [&](double stress) {
    const double h = (ring.outer - ring.inner) / steps;
    Circle at{ring.inner + inner_displacement, stress, 0};
    for (int k = 0; k < steps; ++k)
      at = stepped(ring.inner + k * h, at, h, [&](double r, const Circle& c) { return slope(ring, r, c); });
    return at;
  };
  const double stress =
      root([&](double guess) { return outer_circle(guess)[1]; }, 0, 1e-3 * ring.material.youngs_modulus);
  return {stress, outer_circle(stress)[2]};
}

/// Of the linear solution u = A r + B / r without pull.
LinearTheoryError estimate(const Ring& ring, double inner_displacement) {
  const double a = ring.inner, b = ring.outer, lambda = ring.material.lambda(), mu = ring.material.mu();
  const double ratio = mu / ((lambda + mu) * b * b);  // A by B, from the free edge
  const double of_inverse = inner_displacement / (ratio * a + 1 / a), of_r = ratio * of_inverse;
  const IsotropicLaw<2> law(ring.material);
  ExpandedEnergy sum;
  constexpr int steps = 2000;
  for (int k = 0; k < steps; ++k) {
    const double h = (b - a) / steps, r = a + (k + 0.5) * h;
    sum += 2 * pi * r * h *
           expansion<2>(law, {{{of_r - of_inverse / (r * r), 0}, {0, of_r + of_inverse / (r * r)}}});
  }
  return linear_theory_error(sum);
}

TEST(LinearTheoryError, OfARingThatIsWidenedHasSecondOrder) {
  const Ring ring{0.2, 0.34, {2e6, 0.3}, 0};
  constexpr double tiny = 1e-7;
  const double linear = response(ring, tiny).stress / tiny;
  for (const double sign : {1.0, -1.0}) {
    double error[2];
    for (const int k : {0, 1}) {
      const double d = sign * 0.004 / (1 << k);
      const double stiffer = response(ring, d).stress / (linear * d) - 1;
      const LinearTheoryError estimated = estimate(ring, d);
      error[k] = std::abs(stiffer - estimated.of_rotation - estimated.of_strain);
      EXPECT_GT(std::abs(stiffer), 5 * error[k]);
    }
    EXPECT_GT(observed_order(error[0], error[1]), 1.9);
  }
}

/// The wheel of the ring, bonded to the rim, which rotates and hardly touches the ground.
PositionDeformation rotating_wheel(const Ring& ring) {
  auto model = testing::paper_model(14, 192);
  model.n_positions = 1;
  model.materials = ring.material;
  model.distributed.angular_speed = std::sqrt(ring.pull / *ring.material.density);
  model.load = 1e-6;
  const auto problem = RollingProblem<2>::create(model);
  const auto state = testing::all_states<2>(*problem, testing::holes(model.grid, 2, {}));
  EXPECT_TRUE(state) << state.failure().detail;
  return position_deformations<2>(*problem, **state)[0];
}

// The whole way from the solver's displacements to the estimate. The pull is a dead load, whose work is less
// by what the ring is stiffer.
TEST(LinearTheoryError, OfARotatingWheelHasSecondOrder) {
  const Material material{2e6, 0.3, Plane::strain, 1100};
  const auto exact_work = [&](double pull) { return response({0.2, 0.34, material, pull}, 0).work; };
  constexpr double tiny = 1;
  const double linear = exact_work(tiny);
  double error[2];
  for (const int k : {0, 1}) {
    const double pull = 1e6 / (1 << k);
    const double stiffer = 1 - exact_work(pull) / (linear * (pull / tiny) * (pull / tiny));
    const PositionDeformation found = rotating_wheel({0.2, 0.34, material, pull});
    error[k] = std::abs(stiffer - found.neglected.of_rotation - found.neglected.of_strain);
    EXPECT_GT(std::abs(stiffer), 5 * error[k]);
    EXPECT_LT(found.largest_rotation, 1e-4 * found.root_mean_strain);
  }
  EXPECT_GT(observed_order(error[0], error[1]), 1.9);
}

// --- Rods: Euler's elastica -----------------------------------------------------------------------------

enum class End { free, guided };  ///< guided: it moves but does not turn

/// A thin rod of length 1 and bending stiffness 1, clamped at its begin in the direction of azimuth 0, with a
/// load at its end.
struct Rod {
  const char* name;
  double curvature;  ///< without load
  double load_azimuth;
  End end;

  /// The azimuth of the load, against the rod's direction at a place without load.
  double load_angle(double s) const { return load_azimuth - curvature * s; }
};

/// The rotation of a cross section and its slope.
using Turned = std::array<double, 2>;
constexpr int rod_steps = 200;

/// Along the rod, by the exact equilibrium or by that of linear theory.
std::vector<Turned> turned(const Rod& rod, double load, bool is_linear) {
  const auto from = [&](double slope_at_begin) {
    std::vector<Turned> all{{0, slope_at_begin}};
    constexpr double h = 1.0 / rod_steps;
    for (int k = 0; k < rod_steps; ++k)
      all.push_back(stepped(k * h, all.back(), h, [&](double s, const Turned& y) {
        return Turned{y[1], -load * std::sin(rod.load_angle(s) - (is_linear ? 0 : y[0]))};
      }));
    return all;
  };
  const auto miss = [&](double slope) { return from(slope).back()[rod.end == End::guided ? 0 : 1]; };
  return from(root(miss, 0, 0.1 * load));
}

double integral(const std::function<double(int)>& f) {  // Simpson's rule
  double sum = 0;
  for (int k = 0; k <= rod_steps; ++k) sum += (k == 0 || k == rod_steps ? 1 : k % 2 ? 4 : 2) * f(k);
  return sum / (3 * rod_steps);
}

/// By how much the exact travel of the end along the load is smaller than by linear theory.
double stiffer(const Rod& rod, double load) {
  const auto linear = turned(rod, load, true), exact = turned(rod, load, false);
  const auto angle = [&](int k) { return rod.load_angle(static_cast<double>(k) / rod_steps); };
  const double by_linear = integral([&](int k) { return linear[k][0] * std::sin(angle(k)); });
  return 1 -
         integral([&](int k) { return std::cos(angle(k) - exact[k][0]) - std::cos(angle(k)); }) / by_linear;
}

/// From the linear solution as a plane body of small thickness.
LinearTheoryError estimate(const Rod& rod, double load) {
  constexpr double thickness = 1e-3;
  const double young = 12 / (thickness * thickness * thickness);
  const auto linear = turned(rod, load, true);
  const IsotropicLaw<2> law({young, 0, Plane::stress});
  ExpandedEnergy sum;
  for (int k = 0; k <= rod_steps; ++k) {
    const double simpson = (k == 0 || k == rod_steps ? 1 : k % 2 ? 4 : 2) / (3.0 * rod_steps);
    const double stretch =
        load * std::cos(rod.load_angle(static_cast<double>(k) / rod_steps)) / (young * thickness);
    for (const auto& q : unit_cell_rule<1>(3)) {
      const auto [turn, bend] = linear[k];
      const double strain = stretch - thickness * (q.xi[0] - 0.5) * bend;
      sum += simpson * thickness * q.weight * expansion<2>(law, {{{strain, -turn}, {turn, 0}}});
    }
  }
  return linear_theory_error(sum);
}

/// Spokes in several directions to their loads, straight and curved.
const Rod rods[]{{"straight, across", 0, pi / 2, End::free},
                 {"straight, guided, across", 0, pi / 2, End::guided},
                 {"straight, pulled at 45 deg", 0, pi / 4, End::free},
                 {"straight, pushed at 45 deg", 0, 3 * pi / 4, End::free},
                 {"straight, guided, pushed at 10 deg", 0, 17 * pi / 18, End::guided},
                 {"quarter arch, pushed along its chord", pi / 2, 5 * pi / 4, End::free},
                 {"quarter arch, guided, pushed along its chord", pi / 2, 5 * pi / 4, End::guided},
                 {"quarter arch, guided, pulled along its chord", pi / 2, pi / 4, End::guided},
                 {"half arch, guided, pushed along its chord", pi, 3 * pi / 2, End::guided}};

TEST(LinearTheoryError, OfRodsHasSecondOrderBesidesBending) {
  for (const Rod& rod : rods) {
    SCOPED_TRACE(rod.name);
    double error[2];
    for (const int k : {0, 1}) {
      const double load = 0.1 / (1 << k);
      error[k] = std::abs(stiffer(rod, load) - estimate(rod, load).of_rotation);
    }
    EXPECT_GT(observed_order(error[0], error[1]), 1.9);
  }
}

// Where the load is across the rod, the first order is zero, and that of bending is exact up to the fourth.
TEST(LinearTheoryError, OfBendingIsThatOfTheElastica) {
  for (const Rod& rod : {rods[0], rods[1]}) {
    SCOPED_TRACE(rod.name);
    double error[2];
    for (const int k : {0, 1}) {
      const double load = (rod.end == End::free ? 0.5 : 2.0) / (1 << k);
      const LinearTheoryError estimated = estimate(rod, load);
      EXPECT_NEAR(estimated.of_rotation, 0, 1e-9);
      EXPECT_GT(estimated.of_bending, 0.005);
      error[k] = std::abs(stiffer(rod, load) - estimated.of_bending);
    }
    EXPECT_GT(observed_order(error[0], error[1]), 3.9);
  }
}

// The calibration in docs/method.md: for an estimate of e the true error of travel is between 0.65 e and
// e / (1 - e), up to e = 0.3.
TEST(LinearTheoryError, IsCalibratedByRods) {
  for (const Rod& rod : rods)
    for (const double size : {0.03, 0.1, 0.2, 0.3}) {
      SCOPED_TRACE(rod.name);
      constexpr double large = 100;
      const double load = large * share_within(estimate(rod, large), size);
      ASSERT_NEAR(estimate(rod, load).size(), size, 1e-6);
      const double error = std::abs(stiffer(rod, load));
      EXPECT_LT(error, 1.01 * size / (1 - size));
      EXPECT_GT(error, 0.65 * size);
      RecordProperty(std::string(rod.name) + " " + std::to_string(size), std::to_string(error / size));
    }
}

// --- Wheels ---------------------------------------------------------------------------------------------

RollingModel<2> bushing(double load) {
  auto model = testing::paper_model(10, 120);
  model.grid.n_sectors = 3;  // with most numbers, loads to both sides deform it alike
  model.grid.cells[1] = 40;
  model.contact.counterpart = Counterpart::ring;
  model.contact_points = 3;
  model.n_positions = 3;
  model.load = load;
  return model;
}

std::vector<PositionDeformation> deformations(const RollingModel<2>& model) {
  const auto problem = RollingProblem<2>::create(model);
  const auto state = testing::all_states<2>(*problem, testing::generic_hole(model.grid));
  EXPECT_TRUE(state) << state.failure().detail;
  return position_deformations<2>(*problem, **state);
}

// A bushing is linear in its load.
TEST(LinearTheoryError, TermsGrowWithTheirPowersOfTheLoad) {
  const auto once = deformations(bushing(1e4)), twice = deformations(bushing(2e4)),
             opposite = deformations(bushing(-1e4));
  for (std::size_t i = 0; i < once.size(); ++i) {
    const LinearTheoryError &a = once[i].neglected, &b = twice[i].neglected, &c = opposite[i].neglected;
    const double rounding = 1e-9 * a.size();
    EXPECT_GT(std::abs(a.of_rotation), 0.01 * a.size());
    EXPECT_GT(std::abs(a.of_strain), 0.01 * a.size());
    EXPECT_NEAR(b.of_rotation, 2 * a.of_rotation, rounding);
    EXPECT_NEAR(b.of_strain, 2 * a.of_strain, rounding);
    EXPECT_NEAR(b.of_bending, 4 * a.of_bending, rounding);
    EXPECT_NEAR(c.of_rotation, -a.of_rotation, rounding);
    EXPECT_NEAR(c.of_strain, -a.of_strain, rounding);
    EXPECT_NEAR(c.of_bending, a.of_bending, rounding);
    EXPECT_NEAR(twice[i].largest_rotation, 2 * once[i].largest_rotation, 1e-9 * once[i].largest_rotation);
    EXPECT_NEAR(twice[i].root_mean_strain, 2 * once[i].root_mean_strain, 1e-9 * once[i].root_mean_strain);
    EXPECT_NEAR(twice[i].root_mean_rotation, 2 * once[i].root_mean_rotation,
                1e-9 * once[i].root_mean_rotation);
  }
}

/// The squares of strain and rotation, by the finer quadrature of integrals over the material.
class SquaredStrain : public DensityOfStrain<2> {
 public:
  Value at(const Voigt<2>& e, const MaterialLaw<2>& law) const override {
    const double linear = 0.5 * dot(stress<2>(law, e), e);
    return {linear * (e[0] * e[0] + e[1] * e[1] + 0.5 * e[2] * e[2]), {}};
  }
};

TEST(LinearTheoryError, RootMeanStrainIsThatOfTheEnergy) {
  auto model = testing::paper_model(14, 192);
  model.n_positions = 2;
  const auto problem = RollingProblem<2>::create(model);
  const auto state = testing::all_states<2>(*problem, testing::paper_holes(model.grid));
  ASSERT_TRUE(state);
  const auto found = position_deformations<2>(*problem, **state);
  const auto squares = material_integral<2>(*problem, **state, SquaredStrain());
  for (int i = 0; i < 2; ++i) {
    const double expected = std::sqrt(squares[i] / (*state)->strain_energy()[i]);
    EXPECT_NEAR(found[i].root_mean_strain / expected, 1,
                0.02);  // the tread's refinement has some of the energy
  }
}

/// Spokes between two bands, bent sideways in the middle.
LevelSet<2> spokes(const PolarGrid<2>& grid, double thickness, double bend) {
  LevelSet<2> psi{Lattice<2>(grid, 2), {}};
  const double begin = grid.inner_radius + 0.02, end = grid.outer_radius - 0.025;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const auto [r, azimuth] = psi.lattice.polar_point(i);
    const double middle = bend / r * std::sin(pi * std::clamp((r - begin) / (end - begin), 0.0, 1.0));
    const double off = r * std::remainder(azimuth - 0.5 * grid.sector_angle() - middle, grid.sector_angle());
    psi.values.push_back(std::min({std::abs(off) - 0.5 * thickness, r - begin, end - r}));
  }
  return psi;
}

struct Wheel {
  const char* name;
  std::function<LevelSet<2>(const PolarGrid<2>&)> shape;
  double travel;
};

/// From stocky to slender.
const Wheel wheels[]{
    {"round holes", testing::paper_holes, 2e-3},
    {"straight spokes", [](const PolarGrid<2>& grid) { return spokes(grid, 0.02, 0); }, 1e-3},
    {"curved spokes", [](const PolarGrid<2>& grid) { return spokes(grid, 0.02, 0.03); }, 4e-3},
};

/// The estimate from the program's own solution against a solution with large deformations, for the force at
/// a given travel.
void expect_good_estimate(const Wheel& wheel, double travel) {
  SCOPED_TRACE(::testing::Message() << wheel.name << ", travel " << travel);
  auto model = testing::paper_model(14, 192);
  model.materials = Material{2e6, 0.3};
  model.n_positions = 1;
  model.travel = travel;
  const LevelSet<2> psi = wheel.shape(model.grid);
  const auto problem = RollingProblem<2>::create(model);
  const auto state = testing::all_states<2>(*problem, psi);
  ASSERT_TRUE(state) << state.failure().detail;
  const testing::PlaneWheel reference(model, psi);
  const double linear = reference.force(testing::Theory::linear, travel);
  EXPECT_NEAR((*state)->contacts()[0].rim_force.towards_ground / linear, 1, 0.02);
  const double stiffer = reference.force(testing::Theory::large_deformation, travel) / linear - 1;
  const LinearTheoryError e = position_deformations<2>(*problem, **state)[0].neglected;
  const double sum = e.of_rotation + e.of_strain + e.of_bending;
  EXPECT_GT(e.size(), 0.95 * std::abs(stiffer));
  EXPECT_LT(e.size(), (e.size() < 0.2 ? 1.15 : 1.5) * std::abs(stiffer));
  EXPECT_NEAR(sum, stiffer, (e.size() < 0.2 ? 0.1 : 0.3) * std::abs(stiffer));
  ::testing::Test::RecordProperty(fmt::format("{}, {} mm", wheel.name, 1e3 * travel),
                                  fmt::format("e {:.4f}, sum {:.4f}, true {:.4f}", e.size(), sum, stiffer));
}

TEST(LinearTheoryError, OfAWheelInContact) { expect_good_estimate(wheels[2], 8e-3); }

TEST(LinearTheoryError, OfWheelsInContactSlow) {
  for (const Wheel& wheel : wheels)
    for (const double travel : {wheel.travel, 2 * wheel.travel, 4 * wheel.travel})
      expect_good_estimate(wheel, travel);
}

}  // namespace
}  // namespace wheelwright
