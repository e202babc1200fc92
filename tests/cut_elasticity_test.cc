#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "wheelwright/linalg/sparse_spd.h"
#include "wheelwright/mechanics/elasticity/sector_stiffness.h"
#include "wheelwright/shape/geometry/moved_lines.h"

extern "C" void dsyev_(const char*, const char*, const int*, double*, const int*, double*, double*,
                       const int*, int*);

namespace wheelwright {
namespace {

/// A smooth displacement with what the equations make of it, Cartesian.
struct ExactSolution {
  std::function<Vec<2>(const Vec<2>&)> displacement;
  std::function<Mat<2>(const Vec<2>&)> gradient;
  std::function<Vec<2>(const Vec<2>&)> body_force;
};

Voigt<2> strain_of(const Mat<2>& gradient) {
  return {gradient[0][0], gradient[1][1], gradient[0][1] + gradient[1][0]};
}

/// The same in every layer of a ring; those of neighbours agree where they meet.
using LayeredSolution = std::vector<ExactSolution>;

/// One sector, elastic, of one or several layers, loaded by the exact solution's body force and by its
/// traction on the cut boundary. Nodes on the outer circle and on both sector faces are held at the exact
/// solution; those on the rim at zero.
class LoadedSector {
 public:
  LoadedSector(const LevelSet<2>& psi, int degree, const Materials<2>& materials, const GhostPenalty& ghost)
      : grid_(psi.lattice.grid()),
        lattice_(grid_, degree),
        domain_(*cut_domain(psi, degree + 2)),
        table_(grid_, degree, materials, ghost),
        sector_(sector_stiffness(domain_, table_, grid_.cells[0])) {}

  const CutDomain<2>& domain() const { return domain_; }

  /// Calls visit(cell, point, azimuth of the cell's frame, weight) at the quadrature points of the material.
  template <class Visit>
  void visit_material(Visit visit) const {
    const auto full_rule = unit_cell_rule<2>(lattice_.degree() + 2);
    const auto visit_cell = [&](int cell, const std::vector<ReferencePoint<2>>& points) {
      for (const auto& q : points) {
        const auto at = element(cell).at(q.xi);
        visit(cell, at, azimuth(cell), q.weight * at.determinant);
      }
    };
    for (int cell = 0; cell < grid_.n_cells(); ++cell)
      if (domain_.kinds[cell] == CellKind::inside) visit_cell(cell, full_rule);
    for (const auto& cut : domain_.cut) visit_cell(cut.cell, cut.material);
  }

  std::vector<double> solve(const ExactSolution& exact) const { return solve(LayeredSolution{exact}); }

  std::vector<double> solve(const LayeredSolution& exact) const {
    std::vector<double> x = held_displacements(exact), rhs = loads(exact);
    const auto& k = sector_.matrix;
    std::vector<double> held_forces(k.size);
    k.add_product(x.data(), held_forces.data());
    const std::vector<int> free = free_numbers();
    std::vector<double> free_rhs(n_free());
    for (int i = 0; i < k.size; ++i)
      if (free[i] >= 0) free_rhs[free[i]] = rhs[i] - held_forces[i];
    const auto solution = SparseSpd::factor(n_free(), free_entries())->solve(free_rhs);
    for (int i = 0; i < k.size; ++i)
      if (free[i] >= 0) x[i] = solution[free[i]];
    return x;
  }

  /// Displacement and strain of a solution at a point, in the cell's frame.
  std::pair<Vec<2>, Voigt<2>> evaluate(const std::vector<double>& x, int cell,
                                       const ElasticElement<2>::Point& at) const {
    const auto nodes = sector_.space.cell_nodes(cell);
    std::pair<Vec<2>, Voigt<2>> result{};
    for (size_t a = 0; a < nodes.size(); ++a)
      for (int c = 0; nodes[a] >= 0 && c < 2; ++c) {
        const double value = x[2 * nodes[a] + c];
        for (int d = 0; d < 2; ++d) result.first[d] += at.displacement[d][2 * a + c] * value;
        for (int s = 0; s < 3; ++s) result.second[s] += at.strain[s][2 * a + c] * value;
      }
    return result;
  }

  /// The layer in which a cell lies.
  int layer_of(int cell) const { return layer_of_row(grid_.cell_position(cell)[0]); }

  /// The stiffness on the free unknowns, lower triangle.
  Matrix free_stiffness() const {
    Matrix k(n_free(), n_free());
    for (const auto& e : free_entries()) k(e.row, e.column) = e.value;
    return k;
  }

 private:
  const ElasticElement<2>& element(int cell) const { return table_.element(grid_.cell_position(cell)[0]); }
  int layer_of_row(int row) const { return table_.materials().layer_at(grid_.middle_of_row(row)); }
  double azimuth(int cell) const { return grid_.cell_position(cell)[1] * grid_.column_angle(); }

  bool is_held(int node) const {
    const auto& p = sector_.space.position(node);
    return p[0] == lattice_.nodes()[0] - 1 || p[1] <= 0 || p[1] >= sector_.space.last_line();
  }

  /// The exact solution, or its derivative across a sector's face in the coordinate of the unit cell, in
  /// polar components: what the interpolants of the cells on both sides have on average.
  Vec<2> held_displacement(const ExactSolution& exact, std::array<int, 2> p) const {
    const int last = sector_.space.last_line(), derivative = std::max(p[1] - last, -p[1]);
    if (derivative > 0) p[1] = p[1] < 0 ? 0 : last;
    const Vec<2> polar = lattice_.polar_point(p);
    const auto at = [&](double columns) {
      const Vec<2> there{polar[0], polar[1] + columns * grid_.column_angle()};
      return rotated<2>(exact.displacement(cartesian<2>(there)), -polar[1]);
    };
    Vec<2> u;
    for (int c = 0; c < 2; ++c) {
      const double wide = (at(1)[c] - at(-1)[c]) / 2, narrow = at(0.5)[c] - at(-0.5)[c];
      if (derivative <= 0) u[c] = at(0)[c];
      if (derivative == 1) u[c] = lattice_.degree() == 1 ? wide : 2 * narrow - wide;
      if (derivative == 2) u[c] = 2 * (at(1)[c] + at(-1)[c] - 2 * (at(0.5)[c] + at(-0.5)[c]) + 2 * at(0)[c]);
    }
    return u;
  }

  /// Number among the free unknowns, -1 for held ones.
  std::vector<int> free_numbers() const {
    std::vector<int> numbers;
    int next = 0;
    for (int i = 0; i < sector_.matrix.size; ++i) numbers.push_back(is_held(i / 2) ? -1 : next++);
    return numbers;
  }

  int n_free() const {
    const auto numbers = free_numbers();
    return *std::max_element(numbers.begin(), numbers.end()) + 1;
  }

  std::vector<SparseSpd::Entry> free_entries() const {
    const auto free = free_numbers();
    const auto& k = sector_.matrix;
    std::vector<SparseSpd::Entry> entries;
    for (int j = 0; j < k.size; ++j)
      for (int e = k.column_start[j]; free[j] >= 0 && e < k.column_start[j + 1]; ++e)
        if (free[k.rows[e]] >= 0) entries.push_back({free[k.rows[e]], free[j], k.values[e]});
    return entries;
  }

  std::vector<double> held_displacements(const LayeredSolution& exact) const {
    std::vector<double> x(sector_.matrix.size);
    for (int node = 0; node < sector_.space.n_nodes(); ++node) {
      if (!is_held(node)) continue;
      const auto p = sector_.space.position(node);
      const Vec<2> u = held_displacement(exact[layer_of_row(lattice_.row_of(p[0]))], p);
      for (int c = 0; c < 2; ++c) x[2 * node + c] = u[c];
    }
    return x;
  }

  std::vector<double> loads(const LayeredSolution& exact) const {
    std::vector<double> result(sector_.matrix.size);
    const auto add = [&](int cell, const ElasticElement<2>::Point& at, const Vec<2>& force) {
      const auto nodes = sector_.space.cell_nodes(cell);
      for (size_t a = 0; a < nodes.size(); ++a)
        for (int c = 0; nodes[a] >= 0 && c < 2; ++c)
          for (int d = 0; d < 2; ++d) result[2 * nodes[a] + c] += at.displacement[d][2 * a + c] * force[d];
    };
    const auto scaled = [](Vec<2> v, double factor) {
      for (double& component : v) component *= factor;
      return v;
    };
    visit_material([&](int cell, const ElasticElement<2>::Point& at, double angle, double weight) {
      const Vec<2> force = exact[layer_of(cell)].body_force(rotated<2>(at.position, angle));
      add(cell, at, scaled(rotated<2>(force, -angle), weight));
    });
    for (const auto& cut : domain_.cut)
      for (const auto& q : cut.boundary) {
        const auto at = element(cut.cell).at(q.xi);
        const auto surface = map_surface<2>(at.jacobian, q.normal);
        const double angle = azimuth(cut.cell);
        const auto sigma =
            stress<2>(table_.law(grid_.cell_position(cut.cell)[0]),
                      strain_of(exact[layer_of(cut.cell)].gradient(rotated<2>(at.position, angle))));
        const Vec<2> t = traction<2>(sigma, rotated<2>(surface.normal, angle));
        add(cut.cell, at, scaled(rotated<2>(t, -angle), q.weight * surface.scale));
      }
    return result;
  }

  PolarGrid<2> grid_;
  Lattice<2> lattice_;
  CutDomain<2> domain_;
  ElementTable<2> table_;
  SectorStiffness<2> sector_;
};

/// Material outside of a circle that cuts off `fraction` of the cells of one row.
LevelSet<2> circle_cut(const PolarGrid<2>& grid, int degree, double fraction) {
  LevelSet<2> psi{Lattice<2>(grid, degree), {}};
  const double height = grid.row_height(0), radius = grid.inner_radius + (3 - fraction) * height;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i)
    psi.values.push_back(radius - psi.lattice.polar_point(i)[0]);
  return psi;
}

/// Material above a roof whose sides run through the nodes at 45 degrees of the unit cell, less
/// sqrt(2 fraction): the cells below those nodes have that fraction of material, in one corner.
LevelSet<2> corner_cut(const PolarGrid<2>& grid, int degree, double fraction) {
  LevelSet<2> psi{Lattice<2>(grid, degree), {}};
  const Vec<2> size = grid.cell_size(0);
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> p = psi.lattice.polar_point(i);
    const double row = (p[0] - grid.inner_radius) / size[0], column = p[1] / size[1];
    psi.values.push_back(size[0] * (0.75 * grid.cells[0] - std::sqrt(2 * fraction) - row -
                                    std::abs(column - 0.5 * grid.cells[1])));
  }
  return psi;
}

/// Largest over smallest eigenvalue of a symmetric matrix given by its lower triangle; infinite when it is
/// not positive definite.
double condition_number(Matrix k) {
  const int n = k.rows(), work_size = 4 * n;
  std::vector<double> eigenvalues(n), work(work_size);
  int info = 0;
  dsyev_("N", "L", &n, k.data(), &n, eigenvalues.data(), work.data(), &work_size, &info);
  return info == 0 && eigenvalues.front() > 0 ? eigenvalues.back() / eigenvalues.front() : INFINITY;
}

Matrix scaled_to_unit_diagonal(Matrix k) {
  std::vector<double> scale;
  for (int i = 0; i < k.rows(); ++i) scale.push_back(1 / std::sqrt(k(i, i)));
  for (int j = 0; j < k.columns(); ++j)
    for (int i = 0; i < k.rows(); ++i) k(i, j) *= scale[i] * scale[j];
  return k;
}

constexpr auto cut_kinds = {circle_cut, corner_cut};
constexpr double cut_fractions[] = {0.5, 0.3, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};

double smallest_material_fraction(const CutDomain<2>& domain) {
  double smallest = 1;
  for (const auto& cut : domain.cut) {
    double fraction = 0;
    for (const auto& point : cut.material) fraction += point.weight;
    smallest = std::min(smallest, fraction);
  }
  return smallest;
}

PolarGrid<2> small_sector(int n) { return {0.20, 0.34, 0.12, 12, {n, n}}; }

void expect_patch_test(const Material& material) {
  const Mat<2> a{{{0.3, -0.4}, {1.1, 0.7}}};
  const ExactSolution linear{
      [&](const Vec<2>& x) {
        return Vec<2>{a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1]};
      },
      [&](const Vec<2>&) { return a; }, [](const Vec<2>&) { return Vec<2>{}; }};
  const auto expected = stress<2>(material, strain_of(a));
  const double size = std::hypot(expected[0], expected[1], expected[2]);
  double smallest = 1;
  for (auto cut : cut_kinds)
    for (int degree : {1, 2})
      for (int level_set_degree : {1, 2})
        for (double fraction : cut_fractions) {
          const LoadedSector sector(cut(small_sector(8), level_set_degree, fraction), degree, material, {});
          smallest = std::min(smallest, smallest_material_fraction(sector.domain()));
          const auto x = sector.solve(linear);
          double error = 0;
          sector.visit_material([&](int cell, const ElasticElement<2>::Point& at, double angle, double) {
            const auto sigma = stress<2>(material, sector.evaluate(x, cell, at).second);
            // Tractions on two planes, turned back, are the stress in the field's frame.
            for (const Vec<2>& plane : {Vec<2>{1, 0}, Vec<2>{0, 1}}) {
              const Vec<2> t = rotated<2>(traction<2>(sigma, rotated<2>(plane, -angle)), angle);
              const Vec<2> t_expected = traction<2>(expected, plane);
              for (int d = 0; d < 2; ++d) error = std::max(error, std::abs(t[d] - t_expected[d]) / size);
            }
          });
          EXPECT_LT(error, 1e-8) << "degree " << degree << ", level set " << level_set_degree << ", fraction "
                                 << fraction;
        }
  EXPECT_LT(smallest, 2e-12);
}

TEST(CutElasticity, PassesThePatchTestOnSlivers) { expect_patch_test({200e6, 0.48}); }

TEST(CutElasticity, PassesThePatchTestNearlyIncompressible) { expect_patch_test({200e6, 0.4999}); }

TEST(CutElasticity, PassesThePatchTestInPlaneStress) { expect_patch_test({200e6, 0.48, Plane::stress}); }

Materials<2> two_layers(double interface, const Material& inside, const Material& outside) {
  return Materials<2>(std::vector<Materials<2>::Layer>{{interface, std::make_shared<IsotropicLaw<2>>(inside)},
                                                       {0, std::make_shared<IsotropicLaw<2>>(outside)}});
}

/// Layers that meet on a circle have the same constant stress only if they have the same linear displacement:
/// a shear in materials of the same mu, or a dilation in materials of the same lambda + mu. A roof cuts the
/// cells on both sides of the interface at any height. Slivers beside it get a millionth of the stiffness of
/// a full cell, with which they feel the load of their neighbours: their stress is wrong, but hardly any
/// energy.
TEST(CutElasticity, PassesThePatchTestAcrossLayers) {
  const auto shear = [](double nu) { return Material{2e8 * (1 + nu), nu}; };  // mu = 1e8
  const auto dilation = [](double nu) {
    return Material{2e8 * (1 + nu) * (1 - 2 * nu), nu};
  };  // lambda + mu = 1e8
  for (const bool is_shear : {true, false}) {
    const Mat<2> a = is_shear ? Mat<2>{{{0.3, -0.4}, {1.1, -0.3}}} : Mat<2>{{{0.5, -0.4}, {0.4, 0.5}}};
    const ExactSolution linear{
        [&](const Vec<2>& x) {
          return Vec<2>{a[0][0] * x[0] + a[0][1] * x[1], a[1][0] * x[0] + a[1][1] * x[1]};
        },
        [&](const Vec<2>&) { return a; }, [](const Vec<2>&) { return Vec<2>{}; }};
    const Material inside = is_shear ? shear(0.1) : dilation(0.1),
                   outside = is_shear ? shear(0.45) : dilation(0.45);
    const auto expected = stress<2>(inside, strain_of(a));
    const double size = std::hypot(expected[0], expected[1], expected[2]);
    for (int degree : {1, 2})
      for (double interface : {0.2525, 0.2531})  // on a line of the grid, and beside it
        for (double fraction : cut_fractions) {
          const auto grid = with_lines_at(small_sector(8), {interface});
          const LoadedSector sector(corner_cut(grid, 2, fraction), degree,
                                    two_layers(interface, inside, outside), {});
          const auto x = sector.solve(LayeredSolution{linear, linear});
          double largest = 0, square = 0, area = 0;
          sector.visit_material(
              [&](int cell, const ElasticElement<2>::Point& at, double angle, double weight) {
                const Material& material = sector.layer_of(cell) == 0 ? inside : outside;
                const auto sigma = stress<2>(material, sector.evaluate(x, cell, at).second);
                area += weight;
                for (const Vec<2>& plane : {Vec<2>{1, 0}, Vec<2>{0, 1}}) {
                  const Vec<2> t = rotated<2>(traction<2>(sigma, rotated<2>(plane, -angle)), angle);
                  const Vec<2> off = 1 / size * (t - traction<2>(expected, plane));
                  square += weight * dot<2>(off, off);
                  largest = std::max(largest, norm<2>(off));
                }
              });
          SCOPED_TRACE(::testing::Message() << (is_shear ? "shear" : "dilation") << ", degree " << degree
                                            << ", " << interface << ", fraction " << fraction);
          EXPECT_LT(std::sqrt(square / area), 3e-5);
          EXPECT_LT(largest, 0.02);
        }
  }
}

// The penalty bounds the energy of a sliver from below by xi times that of a full cell: so 1/xi bounds the
// condition number, and scaling to a unit diagonal, which a Cholesky factorization is invariant to, takes
// most of that away.
TEST(CutElasticity, ConditionIsBoundedForAllCuts) {
  const Material material{200e6, 0.48};
  const GhostPenalty ghost;
  for (auto cut : cut_kinds)
    for (int degree : {1, 2}) {
      std::vector<double> plain, scaled;
      for (double fraction : cut_fractions) {
        const LoadedSector sector(cut(small_sector(8), 2, fraction), degree, material, ghost);
        plain.push_back(condition_number(sector.free_stiffness()));
        scaled.push_back(condition_number(scaled_to_unit_diagonal(sector.free_stiffness())));
      }
      const auto largest = [](const auto& v) { return *std::max_element(v.begin(), v.end()); };
      EXPECT_LT(largest(scaled), 100 * scaled.front());
      EXPECT_LT(largest(plain), 10 / ghost.xi * plain.front());
      for (const auto& conditions : {plain, scaled})
        EXPECT_NEAR(conditions.back(), conditions[conditions.size() - 4], 0.01 * conditions.back());
    }
}

TEST(CutElasticity, WithoutGhostPenaltyTheConditionHasNoBound) {
  const Material material{200e6, 0.48};
  const GhostPenalty none{GhostPenaltyKind::full, 0};
  for (auto cut : cut_kinds) {
    const LoadedSector sector(cut(small_sector(8), 2, 1e-3), 2, material, none);
    EXPECT_GT(condition_number(scaled_to_unit_diagonal(sector.free_stiffness())), 1e6);
  }
}

/// u_i = (|x|^2 - Ri^2) sin(k_i . x + c_i), which vanishes on the rim.
class SmoothSolution {
 public:
  SmoothSolution(double rim_radius, const Material& material) : radius_(rim_radius), material_(material) {}

  Vec<2> displacement(const Vec<2>& x) const {
    Vec<2> u;
    for (int i = 0; i < 2; ++i) u[i] = factor(x) * std::sin(phase(i, x));
    return u;
  }

  Mat<2> gradient(const Vec<2>& x) const {
    Mat<2> g;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        g[i][j] = 2 * x[j] * std::sin(phase(i, x)) + factor(x) * wave_[i][j] * std::cos(phase(i, x));
    return g;
  }

  /// -div sigma = -(lambda + mu) grad div u - mu Laplace u.
  Vec<2> body_force(const Vec<2>& x) const {
    Vec<2> force;
    for (int i = 0; i < 2; ++i) {
      force[i] = -material_.mu() * (second(i, 0, 0, x) + second(i, 1, 1, x));
      for (int j = 0; j < 2; ++j) force[i] -= (material_.lambda() + material_.mu()) * second(j, j, i, x);
    }
    return force;
  }

 private:
  double factor(const Vec<2>& x) const { return dot<2>(x, x) - radius_ * radius_; }
  double phase(int i, const Vec<2>& x) const { return dot<2>(wave_[i], x) + 0.3 + i; }

  /// d^2 u_i / dx_j dx_k.
  double second(int i, int j, int k, const Vec<2>& x) const {
    const double sine = std::sin(phase(i, x)), cosine = std::cos(phase(i, x));
    return (j == k ? 2 : 0) * sine + 2 * (x[j] * wave_[i][k] + x[k] * wave_[i][j]) * cosine -
           factor(x) * wave_[i][j] * wave_[i][k] * sine;
  }

  double radius_;
  Material material_;
  Mat<2> wave_{{{21, -13}, {9, 24}}};
};

/// A rubber's displacement, u = curl f + v / lambda with f = (|x|^2 - Ri^2)^2 sin(k . x + c) and v a
/// SmoothSolution: its pressure -div v stays when nu -> 1/2.
class RubberSolution {
 public:
  RubberSolution(double rim_radius, const Material& material)
      : radius_(rim_radius),
        material_(material),
        compressed_(rim_radius, {2 * (1 + material.poissons_ratio) * material.mu() / material.lambda(),
                                 material.poissons_ratio}) {}

  Vec<2> displacement(const Vec<2>& x) const {
    const Vec<2> v = compressed_.displacement(x);
    return {first(1, x) + v[0] / material_.lambda(), -first(0, x) + v[1] / material_.lambda()};
  }

  Mat<2> gradient(const Vec<2>& x) const {
    Mat<2> g = compressed_.gradient(x);
    for (int j = 0; j < 2; ++j) {
      g[0][j] = g[0][j] / material_.lambda() + second(1, j, x);
      g[1][j] = g[1][j] / material_.lambda() - second(0, j, x);
    }
    return g;
  }

  /// -mu Laplace curl f, and the body force of v in a material whose constants are divided by lambda.
  Vec<2> body_force(const Vec<2>& x) const {
    const Vec<2> f = compressed_.body_force(x);
    return {f[0] - material_.mu() * laplacian(1, x), f[1] + material_.mu() * laplacian(0, x)};
  }

 private:
  double square(const Vec<2>& x) const { return dot<2>(x, x) - radius_ * radius_; }
  double sine(const Vec<2>& x) const { return std::sin(dot<2>(wave_, x) + 0.3); }
  double cosine(const Vec<2>& x) const { return std::cos(dot<2>(wave_, x) + 0.3); }

  /// df / dx_i, with f = q^2 sin and q = |x|^2 - Ri^2.
  double first(int i, const Vec<2>& x) const {
    const double q = square(x);
    return 4 * q * x[i] * sine(x) + q * q * wave_[i] * cosine(x);
  }
  double second(int i, int j, const Vec<2>& x) const {
    const double q = square(x);
    return (8 * x[i] * x[j] + (i == j ? 4 * q : 0) - q * q * wave_[i] * wave_[j]) * sine(x) +
           4 * q * (x[i] * wave_[j] + x[j] * wave_[i]) * cosine(x);
  }
  /// d(Laplace f) / dx_i, where Laplace f = (8 q + 8 |x|^2 - |k|^2 q^2) sin + 8 q x.k cos.
  double laplacian(int i, const Vec<2>& x) const {
    const double q = square(x), k2 = dot<2>(wave_, wave_), along = dot<2>(x, wave_);
    const double of_sine = 8 * q + 8 * dot<2>(x, x) - k2 * q * q;
    return (32 * x[i] - 4 * k2 * q * x[i] - 8 * q * along * wave_[i]) * sine(x) +
           (of_sine * wave_[i] + 16 * x[i] * along + 8 * q * wave_[i]) * cosine(x);
  }

  double radius_;
  Material material_;
  SmoothSolution compressed_;
  Vec<2> wave_{21, -13};
};

struct Errors {
  double l2, h1;  ///< norm of the error; of its strain
};

/// u = (|x|^2 - rho^2) s(x) / E, with s a SmoothSolution, in layers that meet at the radius rho and have the
/// same nu: there the displacement is zero and the traction the same, but the strains are as different as 1 /
/// E.
class SolutionOfLayer {
 public:
  SolutionOfLayer(double rim_radius, double interface, const Material& material)
      : interface_(interface), material_(material), smooth_(rim_radius, material) {}

  Vec<2> displacement(const Vec<2>& x) const {
    return factor(x) / material_.youngs_modulus * smooth_.displacement(x);
  }

  Mat<2> gradient(const Vec<2>& x) const {
    const Vec<2> s = smooth_.displacement(x);
    Mat<2> g = smooth_.gradient(x);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        g[i][j] = (factor(x) * g[i][j] + 2 * s[i] * x[j] / (unit * unit)) / material_.youngs_modulus;
    return g;
  }

  /// -div sigma by differences of fourth order, which are exact to 1e-9 of it.
  Vec<2> body_force(const Vec<2>& x) const {
    constexpr double step = 1e-4;
    Vec<2> force{};
    for (int j = 0; j < 2; ++j) {
      const auto at = [&](double steps) {
        Vec<2> there = x, plane{};
        there[j] += steps * step;
        plane[j] = 1;
        return traction<2>(stress<2>(material_, strain_of(gradient(there))), plane);
      };
      force -= 1 / (12 * step) * (8 * (at(1) - at(-1)) - (at(2) - at(-2)));
    }
    return force;
  }

 private:
  double factor(const Vec<2>& x) const { return (dot<2>(x, x) - interface_ * interface_) / (unit * unit); }

  static constexpr double unit = 0.14;
  double interface_;
  Material material_;
  SmoothSolution smooth_;
};

/// Errors on an n x n sector with a hole whose centre is moved by a fraction of a cell along both axes. The
/// grid's rows move to where layers meet.
template <class Solution>
Errors manufactured_errors(int n, int degree, const Materials<2>& materials,
                           const std::vector<Solution>& smooth, const Vec<2>& shift) {
  const PolarGrid<2> grid = with_lines_at(small_sector(n), materials.interfaces());
  LayeredSolution exact;
  for (const Solution& of_layer : smooth)
    exact.push_back({[&](const Vec<2>& x) { return of_layer.displacement(x); },
                     [&](const Vec<2>& x) { return of_layer.gradient(x); },
                     [&](const Vec<2>& x) { return of_layer.body_force(x); }});
  const Vec<2> size = small_sector(n).cell_size(0);
  const Vec<2> centre =
      cartesian<2>({0.27 + shift[0] * size[0], 0.5 * grid.sector_angle() + shift[1] * size[1]});
  LevelSet<2> psi{Lattice<2>(grid, degree), {}};
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<2> x = cartesian<2>(psi.lattice.polar_point(i));
    psi.values.push_back(0.035 - std::hypot(x[0] - centre[0], x[1] - centre[1]));
  }
  const LoadedSector sector(psi, degree, materials, {});
  const auto solution = sector.solve(exact);
  Errors errors{};
  sector.visit_material([&](int cell, const ElasticElement<2>::Point& at, double angle, double weight) {
    const auto [u, strain] = sector.evaluate(solution, cell, at);
    const Vec<2> x = rotated<2>(at.position, angle);
    const Vec<2> u_exact = exact[sector.layer_of(cell)].displacement(x), u_turned = rotated<2>(u, angle);
    const Voigt<2> e = strain_of(exact[sector.layer_of(cell)].gradient(x));
    const double c = std::cos(angle), s = std::sin(angle);
    const Voigt<2> turned{c * c * strain[0] + s * s * strain[1] - c * s * strain[2],
                          s * s * strain[0] + c * c * strain[1] + c * s * strain[2],
                          2 * c * s * (strain[0] - strain[1]) + (c * c - s * s) * strain[2]};
    for (int d = 0; d < 2; ++d) errors.l2 += weight * (u_turned[d] - u_exact[d]) * (u_turned[d] - u_exact[d]);
    for (int k = 0; k < 3; ++k)
      errors.h1 += weight * (k < 2 ? 1 : 0.5) * (turned[k] - e[k]) * (turned[k] - e[k]);
  });
  return {std::sqrt(errors.l2), std::sqrt(errors.h1)};
}

/// Slope of log(error) over log(1/n) by least squares.
double observed_order(const std::vector<int>& cells, const std::vector<double>& errors) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (size_t k = 0; k < cells.size(); ++k) {
    const double x = -std::log(cells[k]), y = std::log(errors[k]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double n = double(cells.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

template <class Solution>
void expect_optimal_orders(const std::vector<int>& degrees, const Materials<2>& materials,
                           const std::vector<Solution>& smooth, int n_shifts, const std::vector<int>& cells) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int degree : degrees) {
    std::vector<std::vector<double>> l2(n_shifts), h1(n_shifts);
    for (int shift = 0; shift < n_shifts; ++shift) {
      const Vec<2> fraction{uniform(random), uniform(random)};
      for (int n : cells) {
        const Errors errors = manufactured_errors<Solution>(n, degree, materials, smooth, fraction);
        l2[shift].push_back(errors.l2);
        h1[shift].push_back(errors.h1);
      }
      EXPECT_GT(observed_order(cells, h1[shift]), degree - 0.1);
      EXPECT_GT(observed_order(cells, l2[shift]), degree + 0.9);
    }
    for (size_t k = 0; k < cells.size(); ++k)
      for (const auto* errors : {&l2, &h1}) {
        double smallest = INFINITY, largest = 0;
        for (const auto& of_shift : *errors) {
          smallest = std::min(smallest, of_shift[k]);
          largest = std::max(largest, of_shift[k]);
        }
        EXPECT_LT(largest, 1.3 * smallest) << "degree " << degree << ", " << cells[k] << " cells";
      }
  }
}

TEST(CutElasticity, ManufacturedSolutionConvergesOptimally) {
  const Material material{1, 0.3};
  expect_optimal_orders<SmoothSolution>({1, 2}, material, {{0.20, material}}, 4, {8, 12, 16, 24, 32});
}

TEST(CutElasticity, ManufacturedSolutionConvergesOptimallySlow) {
  const Material material{1, 0.3};
  expect_optimal_orders<SmoothSolution>({1, 2}, material, {{0.20, material}}, 20, {8, 16, 24, 40, 64});
}

TEST(CutElasticity, NearlyIncompressibleSolutionConvergesOptimally) {
  for (const double nu : {0.49, 0.4999}) {
    const Material material{1, nu};
    expect_optimal_orders<RubberSolution>({2}, material, {{0.20, material}}, 3, {8, 12, 16, 24, 32});
  }
}

/// The hole cuts cells on both sides of where the layers meet.
TEST(CutElasticity, ManufacturedSolutionOfLayersConvergesOptimally) {
  for (const double contrast : {0.1, 30.0})
    for (const double interface : {0.27, 0.2637}) {
      SCOPED_TRACE(::testing::Message() << contrast << " at " << interface);
      const Material inside{1, 0.3}, outside{contrast, 0.3};
      expect_optimal_orders<SolutionOfLayer>({1, 2}, two_layers(interface, inside, outside),
                                             {{0.20, interface, inside}, {0.20, interface, outside}}, 2,
                                             {8, 12, 16, 24, 32});
    }
}

}  // namespace
}  // namespace wheelwright
