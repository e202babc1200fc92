#include "unavoidable_work.h"

namespace wheelwright::bench {
namespace {

/// Harmonics of real data in units of real ones, when each of the complex ones, all but 0 and n/2, costs
/// `complex` as much.
double real_harmonics(int n_sectors, double complex) {
  const int real = n_sectors % 2 == 0 ? 2 : 1;
  return real + complex * (n_sectors - real) / 2;
}

double cube(double x) { return x * x * x; }

}  // namespace

std::vector<KernelWork> unavoidable_work(const RollingProblem<2>& problem,
                                         const RollingSolution<2>& solution) {
  const auto& ring = solution.ring;
  // A symmetric wheel has real factors, to which a complex vector is two real ones.
  const bool symmetric = ring.is_mirror_symmetric();
  const double factors = real_harmonics(ring.n_sectors(), symmetric ? 1 : 4),
               vectors = real_harmonics(ring.n_sectors(), symmetric ? 2 : 4), boundary = ring.n_boundary(),
               outer = ring.n_outer();
  const double positions = solution.states.size();
  const double modes = solution.displacement.modes.rows(),
               swept_entries = ring.sector_factor().sweep_entries(solution.sweep);

  double boundary_points = 0;
  for (const auto& cell : solution.domain.cut) boundary_points += cell.boundary.size();
  const double cell_dofs = problem.elements().element(0).n_dofs();
  const double interface = boundary - outer, solutions = vectors * positions;
  const double outer_line = solutions * 2 * outer * outer,
               interface_sweep = solutions * interface * (2 * outer + interface);

  return {{"Cholesky of a sector", ring.sector_factor().factor_flops()},
          {"Cholesky of the harmonics", factors * cube(boundary) / 3},
          {"compliance of the surface", solution.surface->flops()},
          {"backward sweep, direct", 2 * swept_entries * modes + outer_line + interface_sweep},
          {"both sweeps, adjoint", 4 * swept_entries * modes + 2 * (outer_line + interface_sweep)},
          {"strains on the boundary", boundary_points * 2 * n_strains<2> * cell_dofs * 2 * modes}};
}

template <int dim>
int ring_unknowns(const SectorSpace<dim>& space) {
  const PolarGrid<dim>& grid = space.grid();
  const int lines = space.degree() * grid.columns();
  int core_nodes = 0, axial_nodes = 1;
  for (int node = 0; node < space.n_nodes(); ++node) {
    const int line = space.position(node)[1];
    if (line >= 0 && line < lines) ++core_nodes;
  }
  if constexpr (dim == 3) axial_nodes = space.degree() * grid.cells[2] + 1;
  const int tread_nodes = lines * space.degree() * (grid.cells[0] - space.core_rows()) * axial_nodes;
  return dim * grid.n_sectors * (core_nodes + tread_nodes);
}

template int ring_unknowns(const SectorSpace<2>&);
template int ring_unknowns(const SectorSpace<3>&);

}  // namespace wheelwright::bench
