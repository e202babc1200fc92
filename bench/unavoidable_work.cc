#include "unavoidable_work.h"

namespace wheelwright::bench {
namespace {

/// Harmonics of real data, a complex one counted as four real ones: those of 0 and n/2 are real.
double real_harmonics(int n_sectors) {
  const int real = n_sectors % 2 == 0 ? 2 : 1;
  return real + 4.0 * (n_sectors - real) / 2;
}

double cube(double x) { return x * x * x; }

}  // namespace

std::vector<KernelWork> unavoidable_work(const RollingProblem<2>& problem,
                                         const RollingSolution<2>& solution) {
  const auto& ring = solution.ring;
  const auto& tread = problem.tread();
  const double harmonics = real_harmonics(ring.n_sectors()), boundary = ring.n_boundary(),
               outer = ring.n_outer();
  const double positions = solution.states.size(), fields = positions * ring.n_sectors();
  const double trailing = ring.sector_factor().n_trailing(),
               interior_entries = ring.sector_factor().factor_entries() - trailing * trailing;

  double contact_operator = 0;
  for (const auto& contact : solution.contacts) {
    const double points = contact.n_points(),
                 base = tread.base_per_column() * (contact.zone().n_columns + 2.0 * tread.reach() + 1);
    contact_operator += 2 * base * base * points + 2 * points * points * base;
  }
  double boundary_points = 0;
  for (const auto& cell : solution.domain.cut) boundary_points += cell.boundary.size();
  const double cell_dofs = problem.elements().element(0).n_dofs();
  const double boundary_solve = harmonics * 2 * boundary * boundary * positions;

  return {{"Cholesky of a sector", ring.sector_factor().factor_flops()},
          {"Cholesky of the harmonics", harmonics * cube(boundary) / 3},
          {"compliance of the outer line", harmonics * 2 * cube(outer) / 3},
          {"contact operators", contact_operator},
          {"backward sweep, direct", 2 * interior_entries * fields + boundary_solve},
          {"both sweeps, adjoint", 4 * interior_entries * fields + 2 * boundary_solve},
          {"strains on the boundary", boundary_points * 2 * n_strains<2> * cell_dofs * 2 * fields}};
}

int ring_unknowns(const RollingProblem<2>& problem, const RollingSolution<2>& solution) {
  const auto& space = solution.ring.sector().space;
  const int lines = space.degree() * problem.model().grid.columns();
  int core_nodes = 0;
  for (int node = 0; node < space.n_nodes(); ++node) core_nodes += space.position(node)[1] < lines;
  const int tread_nodes = lines * space.degree() * problem.tread().rows();
  return 2 * problem.model().grid.n_sectors * (core_nodes + tread_nodes);
}

}  // namespace wheelwright::bench
