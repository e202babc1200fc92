#include "shape_work.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/linalg/packed_lower.h"
#include "wheelwright/mechanics/rolling/position_tree.h"

namespace wheelwright::bench {
namespace {

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

/// The blocks in which PartialCholesky sweeps through vectors, each on one thread.
double sweep_blocks(double vectors) { return std::ceil(vectors / 24); }

/// The factored ring: sizes of the harmonics' matrices.
struct Harmonics {
  explicit Harmonics(const CyclicStiffness<3>& ring)
      : n(ring.n_sectors() / 2 + 1),
        n_complex(ring.is_mirror_symmetric() ? 0 : (ring.n_sectors() - 1) / 2),
        parts(ring.is_symmetric_across_width() ? 2 : 1),
        interface(double(ring.n_interface_of_harmonics()) / parts),
        outer(double(ring.n_outer()) / parts),
        section(ring.harmonic_factor(0).of_section()) {}

  /// The factors of all harmonics, of which a complex one takes four times a real one, and of one harmonic
  /// the panels: what is below a panel, and then the longest of the updates, which the threads share.
  PartWork factors() const {
    if (section) {
      const PartialCholesky& first = section->first();
      return {of_factors, "factors of the sections", n * (first.factor_flops() + cube(outer) / 3),
              first.longest_chain_flops() + cube(outer) / 3};
    }
    const double size = interface + outer, real = cube(size) / 3;
    double chain = 0;
    const PackedLower<double> stiffness(static_cast<int>(size), static_cast<int>(interface));
    for (const auto& panel : stiffness.panels()) {
      const double own = panel.n_columns, below = panel.stride - own;
      chain += cube(own) / 3 + square(own) * below + 2 * own * std::min(own, below) * below;
    }
    return {of_factors, "factors of the harmonics", parts * real * (n + 3 * n_complex),
            parts * std::min(real, chain) * (n_complex > 0 ? 4 : 1)};
  }
  /// The same of the vectors of all harmonics, complex ones but for two.
  PartWork work_on_vectors(const std::string& phase, const std::string& part, double real) const {
    const double per_vector = n_complex > 0 ? 4 : 2;
    return {phase, part, parts * real * per_vector * n, parts * real * per_vector};
  }

  /// The entries of a factor that the interface's part of a vector meets.
  double interface_entries() const {
    return section ? section->first().sweep_entries(section->first().full_sweep())
                   : square(interface) / 2 + interface * outer;
  }

  double n, n_complex, parts, interface, outer;
  const SparseTwoBlockCholesky* section;  ///< one of the harmonics' factors if they are sparse
};

/// Of InterfaceModes: the ring's interface on the basis of its link's factor, its strong modes and the rest
/// eliminated to second order. Products are shared in tiles of 192 columns and 256 rows, triangular solutions
/// and Gram matrices in blocks of 96 columns, and the factor is not. The modes are found 192 at a time, with
/// ten products each.
PartWork strong_modes(const CyclicStiffness<3>& ring, double modes) {
  const double n = ring.n_boundary() - ring.n_outer(), m = ring.n_outer(), kept = modes + m, together = 192,
               rows = std::min(n, 256.0), blocked = 96;
  const double found = 1.2 * modes;  // the last block is found to be weak
  const double cholesky = cube(n) / 3;
  const double of_outer = 10 * n * n * m + 5 * n * m * m, next = 2 * cube(n);
  const double random = found * (4 * n * n + 4 * n * m) + 4 * n * square(modes);
  const double reduced = 4 * n * n * modes + 4 * 2 * n * modes * kept + 4 * n * square(kept);
  const double shared = of_outer + next + random + reduced;
  const double chain = 12 * n * rows * together +     // a tile of each product
                       10 * 2 * n * rows * found +    // of each product of every block of modes
                       6 * n * (n + kept) * blocked;  // a block of each triangular solution and Gram matrix
  return {of_factors, "strong modes of the interface", cholesky + shared, cholesky + std::min(shared, chain)};
}

/// Contact operators and Newton's method of one position. The threads share the columns of the zone, twice.
struct PositionWork {
  double operators, longest_operator, newton;
};

PositionWork work_of_position(const ReducedContact<3>& contact, const Tread<3>& tread, int components,
                              int iterations, int points_in_contact) {
  const double zone = contact.zone().n_columns, column = double(contact.n_points()) / zone * components,
               seam = tread.n_seam();
  const double responses = zone * 2 * 2 * (zone + 1) * seam * seam * column;
  const double samples = zone * 2 * column * 2 * seam * zone * column;
  const double active = double(points_in_contact) * components;
  return {responses + samples, (responses + samples) / zone,
          iterations * (2 * cube(active) / 3 + 2 * square(zone * column))};
}

/// Operators and Newton's method of all positions: generations follow each other.
std::vector<PartWork> contacts(const RollingProblem<3>& problem, const RollingSolution<3>& solution) {
  PartWork operators{of_positions, "operators of the positions", 0, 0},
      newton{of_positions, "Newton's method", 0, 0};
  for (const auto& generation : position_tree(solution.positions.size())) {
    double longest_operator = 0, longest_newton = 0;
    for (const PositionStart& start : generation) {
      const auto& state = solution.states[start.position];
      const auto in_contact = std::ranges::count_if(state.traction, [](const Vec<3>& t) { return t[0] < 0; });
      const PositionWork one = work_of_position(solution.contacts[start.position], problem.tread(),
                                                solution.contacts[start.position].components(),
                                                state.newton_iterations, static_cast<int>(in_contact));
      operators.flops += one.operators;
      newton.flops += one.newton;
      longest_operator = std::max(longest_operator, one.longest_operator);
      longest_newton = std::max(longest_newton, one.newton);
    }
    operators.longest_chain += longest_operator;
    newton.longest_chain += longest_newton;
  }
  return {operators, newton};
}

PartWork sweeps(const std::string& phase, const std::string& part, double entries, double vectors,
                int times) {
  const double flops = 2 * times * entries * vectors;
  return {phase, part, flops, flops / sweep_blocks(vectors)};
}

}  // namespace

std::vector<PartWork> shape_work(const RollingProblem<3>& problem, const RollingSolution<3>& solution) {
  const CyclicStiffness<3>& ring = solution.ring;
  const PartialCholesky& sector = ring.sector_factor();
  const Harmonics harmonics(ring);
  const double positions = solution.positions.size(), modes = solution.displacement.modes.rows(),
               cases = positions * ring.n_sectors(), entries = sector.sweep_entries(solution.sweep);
  const double outer = harmonics.outer;

  std::vector<PartWork> parts;
  parts.push_back({of_factors, "sector's factor", sector.factor_flops(), sector.longest_chain_flops()});
  if (ring.n_interface_of_harmonics() < ring.n_boundary() - ring.n_outer())
    parts.push_back(strong_modes(ring, harmonics.interface));
  parts.push_back(harmonics.factors());
  parts.push_back({of_contact_operator, "compliance of the surface", solution.surface->flops(),
                   solution.surface->longest_chain_flops()});
  std::ranges::copy(contacts(problem, solution), std::back_inserter(parts));

  const double on_outer = 2 * square(outer) * positions,
               on_interface = 2 * harmonics.interface_entries() * positions;
  parts.push_back(
      harmonics.work_on_vectors(of_positions, "boundary of the sectors", on_outer + on_interface));
  const double basis = 4 * cases * sector.n_trailing() * modes;  // column_basis()
  parts.push_back({of_positions, "modes of the boundary", basis, basis});
  parts.push_back(sweeps(of_positions, "sweep through the sector", entries, modes, 1));
  parts.push_back(sweeps(of_gradient, "sweeps through the sector, adjoint", entries, modes, 2));
  parts.push_back(harmonics.work_on_vectors(of_gradient, "boundary of the sectors, adjoint",
                                            2 * on_outer + 2 * on_interface));

  double points = 0, most = 0;
  for (const auto& cell : solution.domain.cut) {
    points += static_cast<double>(cell.boundary.size());
    most = std::max(most, static_cast<double>(cell.boundary.size()));
  }
  const double per_point = 2 * n_strains<3> * problem.elements().element(0).n_dofs() * 2 * modes;
  parts.push_back({of_gradient, "strains on the boundary", points * per_point, most * per_point});
  return parts;
}

double flops_in_turn(const std::vector<PartWork>& parts, double cores) {
  double sum = 0;
  for (const PartWork& part : parts) sum += std::max(part.longest_chain, part.flops / cores);
  return sum;
}

}  // namespace wheelwright::bench
