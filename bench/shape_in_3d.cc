/// Solves the first shape of a case in 3D, with contact in all its load positions, adjoints and the gradient
/// of the objective, and prints phase by phase user time, wall time and the peak of memory, then the rate in
/// unknowns per second of user time. Keys of the case may be given other numbers.
/// usage: shape_in_3d [--threads N] CASE [KEY=NUMBER ...]
///
/// On one thread, the default, the parts of a shape are measured by doing them once more, after it.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include "given_case.h"
#include "unavoidable_work.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/rolling/half_width_solver.h"
#include "wheelwright/mechanics/rolling/turned_state.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright::bench {
namespace {

/// User time of this process [s].
double user_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// The peak of the resident memory since the last call of forget_peak() [GB].
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::atof(line.c_str() + 6) * 1024e-9;
  return 0;
}
void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

/// Does some work and prints its line; returns what the work returns.
template <class Work>
auto measured(const std::string& phase, double& seconds, Work work) {
  forget_peak();
  const double start = user_seconds();
  Stopwatch watch;
  auto result = work();
  seconds = user_seconds() - start;
  fmt::print("{:34} {:9.2f} s {:8.2f} GB {:9.2f} s wall time\n", phase, seconds, peak_memory(), watch.lap());
  std::fflush(stdout);
  return result;
}

/// The columns of the sector in the contact zones of all positions, and the number of columns of the widest.
struct Zones {
  std::vector<bool> loaded;
  int widest = 0;
};

Zones contact_zones(const State<3>& state, const PolarGrid<3>& grid, int points_per_column) {
  Zones zones{std::vector<bool>(grid.columns(), false)};
  for (const auto& contact : state.contacts()) {
    for (const auto& point : contact.points) zones.loaded[point.column % grid.columns()] = true;
    zones.widest = std::max(zones.widest, static_cast<int>(contact.points.size()) / points_per_column);
  }
  return zones;
}

/// The wheel whose equations are solved, in place of the wheel of the case: its half, or turned back.
struct SolvedWheel {
  const RollingProblem<3>& problem;
  CutDomain<3> domain;
};

/// Parts of a shape, done once more.
std::optional<Failure> measure_parts(const SolvedWheel& wheel, const Zones& zones) {
  const RollingProblem<3>& problem = wheel.problem;
  const SectorHarmonics harmonics(problem.model().grid.n_sectors);
  double seconds = 0;
  auto sector = measured("assembly", seconds, [&] {
    return sector_stiffness(wheel.domain, problem.elements(), problem.core_rows());
  });
  const auto ring = measured("sector's factor, harmonics", seconds, [&] {
    return CyclicStiffness<3>::factor(
        std::move(sector), [&](int harmonic) { return problem.tread().outer_stiffness(harmonics, harmonic); },
        harmonics);
  });
  if (!ring) return ring.failure();
  measured("contact operator", seconds,
           [&] { return SurfaceCompliance<3>(*ring, problem.tread(), zones.widest - 1, zones.loaded); });
  std::vector<int> order(ring->sector().space.n_nodes());
  for (int node = 0; node < static_cast<int>(order.size()); ++node) order[ring->row(3 * node) / 3] = node;
  const auto factor = measured("of it: sector's factor", seconds, [&] {
    return PartialCholesky::factor(ring->sector().matrix, 3, order, ring->sector_factor().n_trailing() / 3);
  });
  fmt::print("sector's factor: {:.1f} Gflop, {:.1f} Gflop/s\n", 1e-9 * factor->factor_flops(),
             1e-9 * factor->factor_flops() / seconds);
  fmt::print(
      "unknowns of a sector {}, of its boundary {}, of its outer line {}, of a seam of the tread {}; {} "
      "columns "
      "in contact zones of {} columns; reach {} columns\n",
      ring->sector_factor().size(), ring->n_boundary(), ring->n_outer(), problem.tread().n_seam(),
      std::ranges::count(zones.loaded, true), zones.widest, problem.tread().reach());
  return {};
}

/// The columns in contact zones as the solved wheel numbers them.
Zones turned_back(const Zones& zones, int columns) {
  Zones result = zones;
  const int n = static_cast<int>(zones.loaded.size());
  for (int c = 0; c < n; ++c) result.loaded[c] = zones.loaded[(c + columns) % n];
  return result;
}

std::optional<Failure> measure(const Case& c, bool with_parts) {
  const auto study = make_study<3>(c);
  if (!study) return study.failure();
  double seconds = 0;
  const auto solver =
      measured("tread, once per run", seconds, [&] { return make_solver(study->solver->model()); });
  if (!solver) return solver.failure();
  const LevelSet<3>& psi = study->initial;
  const LoadPositions positions = (*solver)->distinct_positions(psi);

  std::optional<SolvedWheel> wheel;
  Zones zones;
  double of_states = 0, of_gradient = 0;
  int unknowns = 0;
  {
    const auto state =
        measured("one shape: states", of_states, [&] { return (*solver)->states(psi, positions, {}); });
    if (!state) return state.failure();
    const auto evaluation = measured("one shape: adjoints, gradient", of_gradient, [&] {
      return differentiate<3>(**solver, study->functions, psi, **state);
    });
    if (!evaluation) return evaluation.failure();
    for (const auto& [phase, wall] : evaluation->phases)
      fmt::print("  wall time of {:20} {:9.2f} s\n", phase, wall);
    fmt::print("objective {:.16g}; Newton iterations {}\n", evaluation->function("objective").value,
               fmt::join(evaluation->newton_iterations, " "));
    const RollingModel<3>& model = (*solver)->model();
    zones = contact_zones(**state, model.grid, static_cast<int>((*solver)->tread_surface().points.size()));
    const CutDomain<3>& domain = (*state)->domain();
    unknowns = ring_unknowns(SectorSpace<3>(domain, model.degree, model.grid.cells[0] - model.tread.rows,
                                            model.side_faces, model.ghost));
    if (const auto* half = dynamic_cast<const HalfWidthSolver*>(solver->get());
        half && is_mirror_symmetric(psi, MirrorPlane::width)) {
      wheel.emplace(half->half(), first_half(domain));
    } else {
      const auto whole = half ? half->whole()
                              : Expected<std::shared_ptr<const RollingProblem<3>>>(
                                    std::dynamic_pointer_cast<const RollingProblem<3>>(*solver));
      if (!whole) return whole.failure();
      wheel.emplace(**whole, domain);
    }
  }
  const int first = best_first_column(wheel->domain, wheel->problem.elements(), wheel->problem.core_rows(),
                                      possible_first_columns(wheel->domain.grid, is_mirror_symmetric(psi)));
  if (first > 0) wheel->domain = turned_back(psi, wheel->domain, first).domain;
  if (with_parts)
    if (const auto failure = measure_parts(*wheel, turned_back(zones, first))) return failure;
  fmt::print("{} unknowns, {} of {} positions solved: {:.0f} unknowns/s per core\n", unknowns,
             positions.size(), (*solver)->model().n_positions, unknowns / (of_states + of_gradient));
  return {};
}

int run(int count, char** arguments, bool with_parts) {
  const auto c = given_case(arguments[1], {arguments + 2, arguments + count});
  if (!c) return 2;
  if (const auto failure = measure(*c, with_parts)) {
    fmt::print(stderr, "{}: {}\n", to_string(failure->reason), failure->detail);
    return 3;
  }
  return 0;
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  wheelwright::restart_with_blas_settings(arguments);
  wheelwright::keep_freed_memory();
  const bool has_threads = count > 2 && std::string(arguments[1]) == "--threads";
  const int threads = has_threads ? std::atoi(arguments[2]) : 1, skipped = has_threads ? 2 : 0;
  if (count - skipped < 2 || threads < 1) {
    fmt::print(stderr, "usage: {} [--threads N] CASE [KEY=NUMBER ...]\n", arguments[0]);
    return 2;
  }
  const wheelwright::ThreadLimit limit(threads);
  return wheelwright::bench::run(count - skipped, arguments + skipped, threads == 1);
}
