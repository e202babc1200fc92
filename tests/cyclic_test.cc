#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "tests/support.h"
#include "wheelwright/linalg/sparse_spd.h"
#include "wheelwright/mechanics/ring/nested_dissection.h"

namespace wheelwright {
namespace {

using testing::holes;
using testing::paper_model;
using testing::relative_difference;

constexpr int n_sectors = 4;

/// A wheel of four sectors; the same wheel as a single sector.
RollingModel<2> four_sectors() {
  auto model = paper_model();
  model.grid.n_sectors = n_sectors;
  model.grid.cells = {10, 24};
  model.n_positions = 4;
  return model;
}

RollingModel<2> one_sector() {
  auto model = four_sectors();
  model.grid.n_sectors = 1;
  model.grid.cells[1] *= n_sectors;
  model.n_positions *= n_sectors;
  return model;
}

/// Holes across the sector's face, inside, and one in a corner of a cell's face.
LevelSet<2> unsymmetric_holes(const PolarGrid<2>& grid) {
  return holes(grid, 2, {{0.265, 0.02, 0.034}, {0.27, 0.55, 0.031}, {0.262, 1.05, 0.027}});
}

/// Holes that are their own mirror image, across the sector's face and inside.
LevelSet<2> symmetric_holes(const PolarGrid<2>& grid) {
  const double angle = grid.sector_angle();
  return holes(grid, 2, {{0.265, 0, 0.034}, {0.262, 0.31 * angle, 0.029}, {0.262, 0.69 * angle, 0.029}});
}

LevelSet<2> repeated(const LevelSet<2>& sector, const PolarGrid<2>& ring) {
  LevelSet<2> psi{Lattice<2>(ring, sector.lattice.degree()), {}};
  for (int s = 0; s < n_sectors; ++s)
    psi.values.insert(psi.values.end(), sector.values.begin(), sector.values.end());
  return psi;
}

TEST(Cyclic, SectorsAgreeWithTheWholeRing) {
  for (int degree : {1, 2}) {
    auto by_sector = four_sectors(), whole = one_sector();
    by_sector.degree = whole.degree = degree;
    const auto psi = unsymmetric_holes(by_sector.grid);
    const auto a = RollingProblem<2>::create(by_sector)->solve(psi);
    const auto b = RollingProblem<2>::create(whole)->solve(repeated(psi, whole.grid));
    ASSERT_TRUE(a) << a.failure().detail;
    ASSERT_TRUE(b) << b.failure().detail;
    const int ring_columns = by_sector.grid.ring_columns();
    for (int i = 0; i < whole.n_positions; ++i) {
      const int own = i % by_sector.n_positions, sectors_ahead = i / by_sector.n_positions;
      EXPECT_NEAR(a->strain_energy[own], b->strain_energy[i], 1e-9 * b->strain_energy[i]);
      EXPECT_NEAR(a->states[own].rim.towards_ground, b->states[i].rim.towards_ground,
                  1e-9 * b->states[i].rim.towards_ground);
      std::vector<double> traction_a, traction_b, observed_a, observed_b;
      for (const auto& t : a->states[own].traction) traction_a.push_back(t[0]);
      for (const auto& t : b->states[i].traction) traction_b.push_back(t[0]);
      for (int c = 0; c < ring_columns; ++c) {
        const int turned = (c + sectors_ahead * by_sector.grid.columns()) % ring_columns;
        for (int r = 0; r < a->observations.rows(); ++r) {
          // Displacements and tractions (in units of E) are of one size.
          const double unit = r % 4 < 2 ? 1 : 1 / whole.materials.at_tread().scaling_modulus();
          observed_a.push_back(unit * a->observations(r, own * ring_columns + c));
          observed_b.push_back(unit * b->observations(r, i * ring_columns + turned));
        }
      }
      EXPECT_LT(relative_difference(traction_a, traction_b), 1e-9);
      EXPECT_LT(relative_difference(observed_a, observed_b), 1e-9);
    }
  }
}

/// The core of the whole ring, assembled cell by cell and face by face with nodes numbered periodically.
class PlainRing {
 public:
  PlainRing(const CutDomain<2>& domain, const ElementTable<2>& table, int core_rows)
      : lattice_(domain.grid, table.degree()), outer_(table.degree() * core_rows) {
    const PolarGrid<2>& grid = domain.grid;
    std::vector<const CutCell<2>*> cut(grid.n_cells());
    for (const auto& cell : domain.cut) cut[cell.cell] = &cell;
    for (int cell = 0; cell < grid.n_cells(); ++cell) {
      const int row = grid.cell_position(cell)[0];
      if (row >= core_rows || !domain.active(cell)) continue;
      add(nodes(cell),
          cut[cell] ? cell_stiffness<2>(table.element(row), table.materials().at_tread(), cut[cell]->material)
                    : table.full_cell_stiffness(row));
    }
    for (const GhostFace& face : domain.ghost_faces) {
      if (grid.cell_position(face.plus)[0] >= core_rows) continue;
      auto both = nodes(face.minus);
      const auto plus = nodes(face.plus);
      both.insert(both.end(), plus.begin(), plus.end());
      add(both, table.face_ghost(grid.cell_position(face.minus)[0], face.axis));
    }
  }

  /// Radial and azimuthal displacements of the outer line (node major) for loads on it.
  std::vector<double> solve(const std::vector<double>& outer_loads) {
    const auto factor = SparseSpd::factor(static_cast<int>(number_.size()), entries_);
    std::vector<double> x(number_.size()), result;
    for (size_t i = 0; i < outer_loads.size(); ++i) x[outer_dof(static_cast<int>(i))] = outer_loads[i];
    x = factor->solve(x);
    for (size_t i = 0; i < outer_loads.size(); ++i) result.push_back(x[outer_dof(static_cast<int>(i))]);
    return result;
  }

 private:
  int outer_dof(int i) { return dof(lattice_.node_index({outer_, i / 2}), i % 2); }

  std::vector<int> nodes(int cell) const {
    const int degree = lattice_.degree();
    const auto c = lattice_.grid().cell_position(cell);
    std::vector<int> result;
    for (int a = 0; a < nodes_per_cell<2>(degree); ++a) {
      const auto p = local_node_position<2>(degree, a);
      result.push_back(lattice_.node_index({degree * c[0] + p[0], degree * c[1] + p[1]}));
    }
    return result;
  }

  int dof(int node, int component) {
    return number_.try_emplace(2 * node + component, static_cast<int>(number_.size())).first->second;
  }

  void add(const std::vector<int>& nodes, const Matrix& block) {
    const auto fixed = [&](int i) { return lattice_.node_position(nodes[i / 2])[0] == 0; };
    for (int j = 0; j < block.columns(); ++j)
      for (int i = 0; i < block.rows(); ++i) {
        if (fixed(i) || fixed(j)) continue;
        const int row = dof(nodes[i / 2], i % 2), column = dof(nodes[j / 2], j % 2);
        if (row >= column) entries_.push_back({row, column, block(i, j)});
      }
  }

  Lattice<2> lattice_;
  int outer_;
  std::map<int, int> number_;
  std::vector<SparseSpd::Entry> entries_;
};

/// Random loads on the outer line, by the ring of sectors and by the whole ring at once.
void expect_plain_solution(int degree, const LevelSet<2>& psi, bool symmetric) {
  const auto model = four_sectors(), whole = one_sector();
  const int core_rows = model.grid.cells[0] - 1;
  const auto domain = cut_domain(psi, 4);
  const auto whole_domain = cut_domain(repeated(psi, whole.grid), 4);
  ASSERT_TRUE(domain && whole_domain);
  const ElementTable<2> table(model.grid, degree, model.materials, model.ghost);
  const ElementTable<2> whole_table(whole.grid, degree, whole.materials, whole.ghost);
  auto sector = sector_stiffness(*domain, table, core_rows);
  ASSERT_TRUE(std::any_of(domain->ghost_faces.begin(), domain->ghost_faces.end(),
                          [&](const GhostFace& face) { return sector.space.wraps(face); }));

  const SectorHarmonics harmonics(n_sectors);
  const int n_outer = 2 * degree * model.grid.columns();
  const auto no_tread = [&](int) { return ComplexMatrix(n_outer, n_outer); };
  const auto ring = CyclicStiffness<2>::factor(std::move(sector), no_tread, harmonics);
  ASSERT_TRUE(ring) << ring.failure().detail;
  EXPECT_EQ(ring->is_mirror_symmetric(), symmetric);

  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> loads(n_outer * n_sectors);
  for (double& x : loads) x = uniform(random);
  Matrix outer_loads(n_outer, n_sectors);
  std::copy(loads.begin(), loads.end(), outer_loads.data());
  const auto outer_line = ring->outer_displacements(outer_loads);
  const std::vector<double> displacement(outer_line.entries().begin(), outer_line.entries().end());
  const auto expected = PlainRing(*whole_domain, whole_table, core_rows).solve(loads);
  EXPECT_LT(relative_difference(displacement, expected), 1e-9);
}

// With holes across the sectors' faces, where ghost faces couple nodes of both sectors.
TEST(Cyclic, AgreesWithAPlainSolveOfTheWholeRing) {
  for (const int degree : {1, 2}) {
    const PolarGrid<2> grid = four_sectors().grid;
    expect_plain_solution(degree, unsymmetric_holes(grid), false);
    expect_plain_solution(degree, symmetric_holes(grid), true);
  }
}

/// Displacements of the boundary for random loads on all of its unknowns, two right-hand sides.
Matrix boundary_displacements(const CyclicStiffness<2>& ring) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Matrix loads(ring.n_boundary(), 2 * ring.n_sectors());
  for (double& x : loads.entries()) x = uniform(random);
  const auto eliminated = ring.eliminate_interface(loads);
  return ring.boundary_displacements(ring.outer_displacements(eliminated.outer), eliminated.interface);
}

double relative_difference_of(const Matrix& a, const Matrix& b) {
  return relative_difference({a.entries().begin(), a.entries().end()},
                             {b.entries().begin(), b.entries().end()});
}

// With and without symmetry, which the strong modes do not use.
TEST(Cyclic, StrongModesAgreeWithAllInterfaceUnknowns) {
  const auto model = four_sectors();
  const SectorHarmonics harmonics(n_sectors);
  const ElementTable<2> table(model.grid, 2, model.materials, model.ghost);
  const auto problem = RollingProblem<2>::create(model);
  const auto in_the_middle = holes(model.grid, 2, {{0.265, 0.5 * model.grid.sector_angle(), 0.034}});
  for (const auto& psi : {unsymmetric_holes(model.grid), in_the_middle}) {
    const auto domain = cut_domain(psi, 4);
    ASSERT_TRUE(domain);
    const auto factored = [&](InterfaceRoute route) {
      return CyclicStiffness<2>::factor(
          sector_stiffness(*domain, table, problem->core_rows()),
          [&](int harmonic) { return problem->tread().outer_stiffness(harmonics, harmonic); }, harmonics,
          route);
    };
    const auto all = factored(InterfaceRoute::all_unknowns), strong = factored(InterfaceRoute::strong_modes);
    ASSERT_TRUE(all && strong);
    EXPECT_EQ(all->n_interface_of_harmonics(), all->n_boundary() - all->n_outer());
    EXPECT_LT(strong->n_interface_of_harmonics(), 0.6 * all->n_interface_of_harmonics());
    EXPECT_LT(relative_difference_of(boundary_displacements(*strong), boundary_displacements(*all)), 1e-10);
    const auto compliance = strong->outer_compliance(2), expected = all->outer_compliance(2),
               in_batches = all->outer_compliance(2, 2);
    for (int ahead = 0; ahead < n_sectors; ++ahead) {
      EXPECT_LT(relative_difference_of(compliance[ahead], expected[ahead]), 1e-10);
      EXPECT_LT(relative_difference_of(in_batches[ahead], expected[ahead]), 1e-14);
    }
  }
}

/// The same shape, `columns` farther round.
LevelSet<2> turned(const LevelSet<2>& psi, int columns) {
  LevelSet<2> result = psi;
  const Lattice<2>& lattice = psi.lattice;
  for (int i = 0; i < lattice.n_nodes(); ++i) {
    auto place = lattice.node_position(i);
    place[1] += lattice.degree() * columns;
    result.values[lattice.node_index(place)] = psi.values[i];
  }
  return result;
}

// A mirror-symmetric wheel has real harmonics; turned by a column it has complex ones. The loads need no
// symmetry.
TEST(Cyclic, RealHarmonicsAgreeWithComplexOnes) {
  auto model = four_sectors();
  model.n_positions = model.grid.columns();
  model.contact.friction = 0.3;
  model.torque = 800;
  const auto problem = RollingProblem<2>::create(model);
  ASSERT_TRUE(problem);
  const auto psi = symmetric_holes(model.grid);
  const auto real = problem->solve(psi), complex = problem->solve(turned(psi, 1));
  ASSERT_TRUE(real && complex);
  EXPECT_TRUE(real->ring.is_mirror_symmetric());
  EXPECT_FALSE(complex->ring.is_mirror_symmetric());
  const int n = model.n_positions;
  for (int i = 0; i < n; ++i) {
    const auto &a = real->states[i], &b = complex->states[(i + 1) % n];
    EXPECT_NEAR(real->strain_energy[i], complex->strain_energy[(i + 1) % n], 1e-10 * real->strain_energy[i]);
    EXPECT_NEAR(a.rim.rotation, b.rim.rotation, 1e-9 * std::abs(a.rim.rotation));
    ASSERT_EQ(a.traction.size(), b.traction.size());
    for (int d = 0; d < 2; ++d) {
      std::vector<double> traction_a, traction_b;
      for (size_t q = 0; q < a.traction.size(); ++q) {
        traction_a.push_back(a.traction[q][d]);
        traction_b.push_back(b.traction[q][d]);
      }
      EXPECT_LT(relative_difference(traction_a, traction_b), 1e-9);
    }
  }
  const WeightedSum<2> energy = testing::strain_energy_alone();
  const auto evaluation = testing::evaluate_objective<2>(*problem, energy, psi),
             turned_evaluation = testing::evaluate_objective<2>(*problem, energy, turned(psi, 1));
  ASSERT_TRUE(evaluation && turned_evaluation);
  EXPECT_NEAR(evaluation->function("objective").value, turned_evaluation->function("objective").value,
              1e-10 * evaluation->function("objective").value);
  std::vector<double> by_row(model.grid.cells[0]), turned_by_row = by_row;
  for (const auto& s : evaluation->gradient("objective"))
    by_row[model.grid.cell_position(s.cell)[0]] += s.weight * s.value;
  for (const auto& s : turned_evaluation->gradient("objective"))
    turned_by_row[model.grid.cell_position(s.cell)[0]] += s.weight * s.value;
  EXPECT_LT(relative_difference(by_row, turned_by_row), 1e-9);
}

/// A boundary in 3D: an interface of two azimuths and an outer line of four, three nodes along the axle each.
struct SpatialBoundary {
  SpatialBoundary() {
    for (const int period : {2, 4}) {
      const int first = static_cast<int>(azimuth.unknowns.size());
      const auto unknown = [&](int line, int axial, int c) { return first + 3 * (3 * line + axial) + c; };
      for (int line = 0; line < period; ++line)
        for (int axial = 0; axial < 3; ++axial)
          for (int c = 0; c < 3; ++c) {
            azimuth.unknowns.push_back(
                {unknown((period - line) % period, axial, c), line == 0 ? 0 : 1, c == 1 ? -1.0 : 1.0});
            width.unknowns.push_back({unknown(line, 2 - axial, c), 0, c == 2 ? -1.0 : 1.0});
          }
    }
  }
  int n_interface = 18, n = 54;
  BoundaryMirror azimuth, width;
};

/// A Hermitian, positive definite matrix that commutes with both reflections.
ComplexMatrix symmetric_stiffness(const SpatialBoundary& boundary, std::complex<double> forward) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  ComplexMatrix k(boundary.n, boundary.n);
  for (int j = 0; j < boundary.n; ++j)
    for (int i = j; i < boundary.n; ++i) {
      k(i, j) =
          i == j ? std::complex<double>(boundary.n) : std::complex<double>(uniform(random), uniform(random));
      k(j, i) = std::conj(k(i, j));
    }
  const auto average = [&](auto image) {
    const ComplexMatrix before = k;
    for (int j = 0; j < boundary.n; ++j)
      for (int i = 0; i < boundary.n; ++i) k(i, j) = 0.5 * (before(i, j) + image(before, i, j));
  };
  average([&](const ComplexMatrix& a, int i, int j) {
    const auto &from = boundary.width.unknowns[i], &to = boundary.width.unknowns[j];
    return from.sign * to.sign * a(from.image, to.image);
  });
  average([&](const ComplexMatrix& a, int i, int j) {
    const auto &from = boundary.azimuth.unknowns[i], &to = boundary.azimuth.unknowns[j];
    const auto phase = [&](const auto& u) { return u.sign * (u.ahead == 1 ? forward : 1.0); };
    return phase(from) * std::conj(a(from.image, to.image)) * std::conj(phase(to));
  });
  return k;
}

// Symmetries of the stiffness change neither the solution nor the condensed loads; the loads have none.
TEST(HarmonicFactor, FindsTheSameSolutionWithAndWithoutSymmetries) {
  const SpatialBoundary boundary;
  const std::complex<double> forward = std::polar(1.0, 0.7);
  const ComplexMatrix k = symmetric_stiffness(boundary, forward);
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(-1, 1);
  ComplexMatrix loads(boundary.n, 3);
  for (auto& x : loads.entries()) x = {uniform(random), uniform(random)};
  const int n_outer = boundary.n - boundary.n_interface;
  for (const bool azimuth : {false, true})
    for (const bool width : {false, true}) {
      BoundarySymmetry symmetry{
          .n_interface = boundary.n_interface, .classes = {}, .width = {}, .azimuth = {}};
      if (azimuth) symmetry.azimuth = boundary.azimuth;
      if (width) {
        symmetry.width = boundary.width;
        for (const double sign : {1.0, -1.0})
          symmetry.classes.emplace_back(boundary.width, boundary.n_interface, sign);
      } else {
        symmetry.classes.emplace_back(boundary.n, boundary.n_interface);
      }
      const auto factor = HarmonicFactor::factor(std::make_shared<const BoundarySymmetry>(symmetry), forward,
                                                 false, [&](int i, int j) { return k(i, j); });
      ASSERT_TRUE(factor);
      ComplexMatrix x = loads;
      factor->eliminate(x);
      ComplexMatrix outer = block(x, boundary.n_interface, 0, n_outer, 3);
      factor->solve_last(outer);
      for (int j = 0; j < 3; ++j) std::copy_n(outer.column(j), n_outer, x.column(j) + boundary.n_interface);
      factor->substitute(x);
      ComplexMatrix residual = loads;
      multiply(1, k, Op::none, x, Op::none, -1, residual);
      double largest = 0;
      for (const auto& r : residual.entries()) largest = std::max(largest, std::abs(r));
      EXPECT_LT(largest, 1e-12) << azimuth << width;
    }
}

/// The stiffness of a sector with a hole, on square cells.
SectorStiffness<2> stiffness_with_a_hole(const ElementTable<2>& table) {
  const auto domain = cut_domain(testing::paper_holes(table.grid()), 4);
  EXPECT_TRUE(domain && !domain->ghost_faces.empty());
  return sector_stiffness(*domain, table, table.grid().cells[0]);
}

// Nested dissection of a plane grid of n nodes takes O(n^1.5) flops (George 1973), line after line O(n^2).
TEST(NestedDissection, HasTheTheoreticalCost) {
  std::vector<double> flops, flops_by_line, nodes;
  for (int cells : {24, 48, 96}) {
    auto model = paper_model();
    model.grid.cells = {cells, cells};
    const ElementTable<2> table(model.grid, model.degree, model.materials, model.ghost);
    const auto sector = stiffness_with_a_hole(table);
    std::vector<int> by_line(sector.space.n_nodes());
    std::iota(by_line.begin(), by_line.end(), 0);
    const auto order = nested_dissection(sector, by_line);
    auto sorted = order;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, by_line);
    nodes.push_back(double(by_line.size()));
    flops.push_back(PartialCholesky::factor(sector.matrix, 2, order, 0)->factor_flops());
    flops_by_line.push_back(PartialCholesky::factor(sector.matrix, 2, by_line, 0)->factor_flops());
  }
  const auto exponent = [&](const std::vector<double>& work) {
    return std::log(work.back() / work.front()) / std::log(nodes.back() / nodes.front());
  };
  RecordProperty("exponent", std::to_string(exponent(flops)));
  EXPECT_LT(exponent(flops), 1.5);
  EXPECT_GT(exponent(flops_by_line), 1.8);
}

TEST(NestedDissection, SeparatesNodesCoupledByGhostFaces) {
  auto model = paper_model();
  model.grid.cells = {48, 48};
  const ElementTable<2> table(model.grid, model.degree, model.materials, model.ghost);
  const auto sector = stiffness_with_a_hole(table);
  auto without_ghosts = sector;
  without_ghosts.ghosts.clear();
  std::vector<int> nodes(sector.space.n_nodes());
  std::iota(nodes.begin(), nodes.end(), 0);
  const auto flops = [&](const SectorStiffness<2>& known) {
    return PartialCholesky::factor(sector.matrix, 2, nested_dissection(known, nodes), 0)->factor_flops();
  };
  EXPECT_LT(flops(sector), 0.6 * flops(without_ghosts));
}

}  // namespace
}  // namespace wheelwright
