/// Solves the first shape of a case in 3D, with contact in all its load positions, adjoints and the gradient
/// of the objective, and prints phase by phase user time, wall time and the peak of memory, then the rate in
/// unknowns per second of user time. Keys of the case may be given other numbers.
/// usage: shape_in_3d [--threads N | --flops | --sizes] CASE [KEY=NUMBER ...]
///
/// On one thread, the default, the parts of a shape are measured by doing them once more, after it. With
/// --flops it then solves the shape once more, and prints the operations of its parts with their longest
/// chains, and what they leave of the time on 1 to 256 cores. --sizes solves nothing and prints
/// only the sizes, even of wheels that are too large for this machine.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include "given_case.h"
#include "shape_work.h"
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

/// User time of the parts of a shape [s].
struct PartTimes {
  double assembly, factors, contact_operator;
};

/// Parts of a shape, done once more.
Expected<PartTimes> measure_parts(const SolvedWheel& wheel, const Zones& zones) {
  const RollingProblem<3>& problem = wheel.problem;
  const SectorHarmonics harmonics(problem.model().grid.n_sectors);
  double seconds = 0;
  PartTimes times{};
  auto sector = measured("assembly", times.assembly, [&] {
    return sector_stiffness(wheel.domain, problem.elements(), problem.core_rows());
  });
  const auto ring = measured(of_factors, times.factors, [&] {
    return CyclicStiffness<3>::factor(
        std::move(sector), [&](int harmonic) { return problem.tread().outer_stiffness(harmonics, harmonic); },
        harmonics);
  });
  if (!ring) return ring.failure();
  measured(of_contact_operator, times.contact_operator,
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
      "columns in contact zones of {} columns; reach {} columns; unknowns of a harmonic {}\n",
      ring->sector_factor().size(), ring->n_boundary(), ring->n_outer(), problem.tread().n_seam(),
      std::ranges::count(zones.loaded, true), zones.widest, problem.tread().reach(),
      ring->n_interface_of_harmonics() + ring->n_outer());
  return times;
}

/// The rate of a large dense product [flop/s of user time].
double rate_of_products() {
  constexpr int n = 1024, repetitions = 20;
  const Matrix a(n, n);
  Matrix b = product(a, Op::none, a, Op::none);
  const double start = user_seconds();
  for (int k = 0; k < repetitions; ++k) multiply(1, a, Op::none, a, Op::none, 0, b);
  return repetitions * 2.0 * n * n * n / (user_seconds() - start);
}

/// Time of a phase on one core.
struct PhaseSeconds {
  std::string phase;
  double seconds;
};

/// The time of a shape on many cores, from those of its phases on one: of its kernels at the rate of dense
/// products their longer chains or shares, and of all the rest what it is on one.
double seconds_on(double cores, const std::vector<PartWork>& work, const std::vector<PhaseSeconds>& phases,
                  double rate) {
  double sum = 0;
  for (const auto& [phase, seconds] : phases) {
    std::vector<PartWork> own;
    for (const PartWork& one : work)
      if (one.phase == phase) own.push_back(one);
    const double flops = flops_in_turn(own, 1);
    const double of_kernels = std::min(seconds, flops / rate);
    sum += seconds - of_kernels + (flops > 0 ? of_kernels * flops_in_turn(own, cores) / flops : 0);
  }
  return sum;
}

/// The operations of a shape, and what is left of its time on many cores.
std::optional<Failure> show_work(const SolvedWheel& wheel, const LevelSet<3>& psi,
                                 const LoadPositions& positions, const std::vector<PhaseSeconds>& phases) {
  const auto solution = wheel.problem.solve({psi, &wheel.domain}, positions, {});
  if (!solution) return solution.failure();
  const auto work = shape_work(wheel.problem, *solution);
  fmt::print("{:26} {:36} {:>10} {:>14} {:>12}\n", "phase", "part", "Gflop", "longest chain", "cores of use");
  for (const PartWork& one : work)
    fmt::print("{:26} {:36} {:10.2f} {:14.3f} {:12.1f}\n", one.phase, one.part, 1e-9 * one.flops,
               1e-9 * one.longest_chain, one.flops / one.longest_chain);
  const double all = flops_in_turn(work, 1), chain = flops_in_turn(work, 1e9);
  fmt::print("{:63} {:10.2f} {:14.3f} {:12.1f}\n", "all, one after the other", 1e-9 * all, 1e-9 * chain,
             all / chain);
  const double rate = rate_of_products();
  fmt::print("dense products of one core: {:.1f} Gflop/s\n", 1e-9 * rate);
  const double on_one = seconds_on(1, work, phases, rate);
  for (const double cores : {1, 2, 16, 64, 256}) {
    const double seconds = seconds_on(cores, work, phases, rate);
    fmt::print("{:3.0f} cores: kernels {:8.3f} s, shape {:8.2f} s, {:5.2f} times as fast as one\n", cores,
               flops_in_turn(work, cores) / rate, seconds, on_one / seconds);
  }
  return {};
}

/// The columns in contact zones as the solved wheel numbers them.
Zones turned_back(const Zones& zones, int columns) {
  Zones result = zones;
  const int n = static_cast<int>(zones.loaded.size());
  for (int c = 0; c < n; ++c) result.loaded[c] = zones.loaded[(c + columns) % n];
  return result;
}

/// These are measured after the shape itself. With `sizes` no shape is solved.
enum class Afterwards { nothing, parts, work, sizes };

/// The wheel whose equations the solver solves for this shape: its half, or turned back.
Expected<SolvedWheel> solved_wheel(const StateSolver<3>& solver, const LevelSet<3>& psi,
                                   const CutDomain<3>& domain) {
  const auto* half = dynamic_cast<const HalfWidthSolver*>(&solver);
  if (half && is_mirror_symmetric(psi, MirrorPlane::width))
    return SolvedWheel{half->half(), first_half(domain)};
  if (!half) return SolvedWheel{dynamic_cast<const RollingProblem<3>&>(solver), domain};
  const auto whole = half->whole();
  if (!whole) return whole.failure();
  return SolvedWheel{**whole, domain};
}

/// The column from which on its sector is cut out of the ring.
int first_column(const SolvedWheel& wheel, const LevelSet<3>& psi) {
  return best_first_column(wheel.domain, wheel.problem.elements(), wheel.problem.core_rows(),
                           possible_first_columns(wheel.domain.grid, is_mirror_symmetric(psi)));
}

SectorSpace<3> core_space(const RollingModel<3>& model, const CutDomain<3>& domain) {
  return {domain, model.degree, model.grid.cells[0] - model.tread.rows, model.side_faces, model.ghost};
}

/// The sizes on which time and memory depend, without solving anything.
std::optional<Failure> show_sizes(const Case& c) {
  const auto study = make_study<3>(c);
  if (!study) return study.failure();
  const LevelSet<3>& psi = study->initial;
  const RollingModel<3>& model = study->solver->model();
  const auto domain = cut_domain(psi, model.points_in_cut_cells());
  if (!domain) return domain.failure();
  auto wheel = solved_wheel(*study->solver, psi, *domain);
  if (!wheel) return wheel.failure();
  const int first = first_column(*wheel, psi);
  if (first > 0) wheel->domain = turned_back(psi, wheel->domain, first).domain;
  const SectorSpace<3> space = core_space(wheel->problem.model(), wheel->domain);
  const Tread<3>& tread = wheel->problem.tread();
  const int outer = tread.base_per_column() * tread.columns_per_sector();
  int on_last_face = 0;
  for (int node = 0; node < space.n_nodes(); ++node) {
    const auto& place = space.position(node);
    if (place[1] >= space.last_line() && place[0] != space.degree() * space.core_rows()) ++on_last_face;
  }
  fmt::print(
      "{} unknowns; of a sector {}, of its boundary {}, of its outer line {}, of a seam of the tread {}; "
      "reach {} "
      "columns\n",
      ring_unknowns(core_space(model, *domain)), 3 * space.n_nodes(), 3 * on_last_face + outer, outer,
      tread.n_seam(), tread.reach());
  return {};
}

std::optional<Failure> measure(const Case& c, Afterwards afterwards) {
  if (afterwards == Afterwards::sizes) return show_sizes(c);
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
  double of_states = 0, of_gradient_seconds = 0;
  int unknowns = 0;
  {
    const auto state =
        measured("one shape: states", of_states, [&] { return (*solver)->states(psi, positions, {}); });
    if (!state) return state.failure();
    const auto evaluation = measured("one shape: adjoints, gradient", of_gradient_seconds, [&] {
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
    unknowns = ring_unknowns(core_space(model, domain));
    auto solved = solved_wheel(**solver, psi, domain);
    if (!solved) return solved.failure();
    wheel.emplace(*std::move(solved));
  }
  const int first = first_column(*wheel, psi);
  if (first > 0) wheel->domain = turned_back(psi, wheel->domain, first).domain;
  if (afterwards != Afterwards::nothing) {
    const auto times = measure_parts(*wheel, turned_back(zones, first));
    if (!times) return times.failure();
    const double others = of_states - times->assembly - times->factors - times->contact_operator;
    if (afterwards == Afterwards::work)
      if (const auto failure = show_work(*wheel, psi, turned_back(positions, wheel->domain.grid, first),
                                         {{"assembly", times->assembly},
                                          {of_factors, times->factors},
                                          {of_contact_operator, times->contact_operator},
                                          {of_positions, others},
                                          {of_gradient, of_gradient_seconds}}))
        return failure;
  }
  fmt::print("{} unknowns, {} of {} positions solved: {:.0f} unknowns/s per core\n", unknowns,
             positions.size(), (*solver)->model().n_positions, unknowns / (of_states + of_gradient_seconds));
  return {};
}

int run(int count, char** arguments, Afterwards afterwards) {
  const auto c = given_case(arguments[1], {arguments + 2, arguments + count});
  if (!c) return 2;
  if (const auto failure = measure(*c, afterwards)) {
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
  const std::string option = count > 2 ? arguments[1] : "";
  const bool has_threads = option == "--threads", counts = option == "--flops", sizes = option == "--sizes";
  const int threads = has_threads ? std::atoi(arguments[2]) : 1, skipped = has_threads         ? 2
                                                                           : (counts || sizes) ? 1
                                                                                               : 0;
  if (count - skipped < 2 || threads < 1) {
    fmt::print(stderr, "usage: {} [--threads N | --flops | --sizes] CASE [KEY=NUMBER ...]\n", arguments[0]);
    return 2;
  }
  const wheelwright::ThreadLimit limit(threads);
  using wheelwright::bench::Afterwards;
  return wheelwright::bench::run(count - skipped, arguments + skipped,
                                 sizes          ? Afterwards::sizes
                                 : counts       ? Afterwards::work
                                 : threads == 1 ? Afterwards::parts
                                                : Afterwards::nothing);
}
