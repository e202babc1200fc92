/// One shape of the paper's 16-hole wheel, phase by phase, on grids from coarse to fine. One thread.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <memory>
#include <numeric>
#include <optional>

#include "summary.h"
#include "tests/support.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/mechanics/contact/contact_starts.h"
#include "wheelwright/mechanics/contact/newton_tangent.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/evolver.h"

namespace wheelwright::bench {
namespace {

/// A benchmark's case.
struct Size {
  int radial_cells, angular_cells, n_positions = 8;
  bool operator==(const Size&) const = default;
  std::string grid() const { return fmt::format("{}x{}", radial_cells, angular_cells); }
};

template <class T>
T value_of(Expected<T> expected) {
  if (!expected) throw std::runtime_error(expected.failure().detail);
  return *std::move(expected);
}

/// A wheel and its initial shape.
class Wheel {
 public:
  explicit Wheel(const Size& size)
      : size_(size),
        problem_(value_of(RollingProblem<2>::create(model(size)))),
        psi_(testing::paper_holes(problem_.model().grid)) {}

  const Size& size() const { return size_; }
  const RollingProblem<2>& problem() const { return problem_; }
  const LevelSet<2>& psi() const { return psi_; }
  Evaluation<2> evaluate() const {
    return value_of(testing::evaluate_objective<2>(problem_, testing::strain_energy_alone(), psi_));
  }
  Evaluation<2> evaluate_all_positions() const {
    const ShapeFunction<2> function = objective(testing::strain_energy_alone());
    const auto states = value_of(testing::all_states<2>(problem_, psi_));
    return value_of(differentiate<2>(problem_, std::span(&function, 1), psi_, *states));
  }

 private:
  static RollingModel<2> model(const Size& size) {
    auto model = testing::paper_model(size.radial_cells, size.angular_cells);
    model.n_positions = size.n_positions;
    return model;
  }

  Size size_;
  RollingProblem<2> problem_;
  LevelSet<2> psi_;
};

/// Keeps the wheel that the last benchmark used, for the next one.
class Workshop {
 public:
  const Wheel& wheel(const Size& size) {
    if (!wheel_ || !(wheel_->size() == size)) {
      solution_.reset();
      wheel_.reset();
      wheel_ = std::make_unique<Wheel>(size);
    }
    return *wheel_;
  }
  const RollingSolution<2>& solution(const Size& size) {
    const Wheel& current = wheel(size);
    if (!solution_)
      solution_ = std::make_unique<RollingSolution<2>>(value_of(
          current.problem().solve(current.psi(), current.problem().distinct_positions(current.psi()))));
    return *solution_;
  }

 private:
  std::unique_ptr<Wheel> wheel_;
  std::unique_ptr<RollingSolution<2>> solution_;
};

/// Runs the work as the benchmark asks and keeps every single time.
template <class Work>
void measure(benchmark::State& state, Samples& samples, Work work) {
  for (auto _ : state) {
    Stopwatch watch;
    benchmark::DoNotOptimize(work());
    samples.add(watch.lap());
  }
}

double peak_memory() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * usage.ru_maxrss;
}

void dense_product(benchmark::State& state, Measurements& m) {
  constexpr int n = 512;
  Matrix a(n, n), b(n, n), c(n, n);
  std::iota(a.entries().begin(), a.entries().end(), 0.0);
  b = a;
  m.dense_product_flops = 2.0 * n * n * n;
  measure(state, m.dense_product, [&] {
    multiply(1, a, Op::none, b, Op::none, 0, c);
    return c.data();
  });
  state.counters["flops"] =
      benchmark::Counter(m.dense_product_flops, benchmark::Counter::kIsIterationInvariantRate);
}

/// A whole shape: the phases as the evaluation itself times them.
void shape(benchmark::State& state, const Wheel& wheel, GridTimes& times) {
  measure(state, times.shape, [&] {
    auto evaluation = wheel.evaluate();
    for (const auto& [phase, seconds] : evaluation.phases) times.phase(phase).add(seconds);
    return evaluation;
  });
  for (const auto& [name, samples] : times.phases) state.counters[name + "_ms"] = 1e3 * samples.fastest();
  times.peak_memory = peak_memory();
}

/// The sparse factorization within the phase "factorization"; what remains of it are the harmonics.
void sector_cholesky(benchmark::State& state, const RollingSolution<2>& solution, Samples& samples) {
  const auto& ring = solution.ring;
  std::vector<int> order(ring.sector().space.n_nodes());
  for (int node = 0; node < static_cast<int>(order.size()); ++node) order[ring.row(2 * node) / 2] = node;
  measure(state, samples, [&] {
    return value_of(
        PartialCholesky::factor(ring.sector().matrix, 2, order, ring.sector_factor().n_trailing() / 2));
  });
}

void contact_operators(benchmark::State& state, const Wheel& wheel, const RollingSolution<2>& solution,
                       Samples& samples) {
  measure(state, samples, [&] {
    const SurfaceCompliance<2> surface(solution.ring, wheel.problem().tread(), solution.surface->width());
    std::vector<ReducedContact<2>> contacts;
    for (size_t i = 0; i < solution.contacts.size(); ++i)
      contacts.push_back(reduced_contact<2>(surface, wheel.problem().tread(), wheel.problem().model().grid,
                                            solution.positions.grounds[i], solution.contacts[i].zone(),
                                            std::make_shared<CoulombLaw<2>>(0), solution.contacts[i].rim()));
    return contacts;
  });
}

/// One iteration for every position, at its solution.
void newton(benchmark::State& state, const RollingSolution<2>& solution, Samples& samples) {
  measure(state, samples, [&] {
    std::vector<std::optional<ContactUnknowns<2>>> steps;
    for (size_t i = 0; i < solution.contacts.size(); ++i) {
      const auto& contact = solution.contacts[i];
      const auto x = start_from(contact, solution.states[i]);
      steps.push_back(NewtonTangent<2>(contact).step(x, contact.residual(x)));
    }
    return steps;
  });
}

/// The steps from one shape to the next.
class Evolution {
 public:
  explicit Evolution(const Wheel& wheel)
      : wheel_(wheel),
        evolver_(wheel.psi().lattice, options(wheel)),
        gradient_(wheel.evaluate().gradient("objective")),
        velocity_(value_of(evolver_.measure_preserving_velocity(gradient_))),
        moved_(move()) {}

  std::vector<double> velocity() const { return value_of(evolver_.measure_preserving_velocity(gradient_)); }
  LevelSet<2> move() const {
    return value_of(evolver_.move(wheel_.psi(), velocity_, 0.5 * wheel_.psi().lattice.grid().resolution()));
  }
  LevelSet<2> hold_measure() const {
    double length = 0;
    for (const auto& sample : gradient_) length += sample.weight;
    return value_of(evolver_.with_measure(moved_, material_measure(wheel_.psi()), length)).shape;
  }
  LevelSet<2> redistance() const { return value_of(evolver_.redistance(moved_)); }

 private:
  static EvolutionOptions options(const Wheel& wheel) {
    const double row = wheel.problem().model().grid.row_height(0);
    return {.velocity = {}, .smoothing = 0, .bands = {.rim = {row, 1}, .tread = {2 * row, 2}}};
  }

  const Wheel& wheel_;
  Evolver<2> evolver_;
  std::vector<SurfaceSample<2>> gradient_;
  std::vector<double> velocity_;
  LevelSet<2> moved_;
};

template <class Function>
void add(const std::string& name, Function function) {
  benchmark::RegisterBenchmark(name.c_str(), [function](benchmark::State& state) {
    try {
      function(state);
    } catch (const std::runtime_error& error) {
      state.SkipWithError(error.what());
    }
  })->Unit(benchmark::kMillisecond);
}

const std::vector<Size> grids{{14, 192}, {28, 384}, {56, 768}, {112, 1536}};
const Size reference = grids[1];

/// Whole shapes come first and from coarse to fine, so that the peak memory so far is that of the grid.
void add_benchmarks(Workshop& shop, Measurements& m) {
  m.grids.resize(grids.size());
  add("dense product/512", [&m](auto& state) { dense_product(state, m); });
  for (size_t g = 0; g < grids.size(); ++g) {
    const Size size = grids[g];
    GridTimes& times = m.grids[g];
    times.grid = size.grid();
    add("shape/" + size.grid(), [&, size](auto& state) { shape(state, shop.wheel(size), times); });
  }
  for (int n_positions : {reference.n_positions, 8 * reference.n_positions}) {
    const Size size{reference.radial_cells, reference.angular_cells, n_positions};
    add(fmt::format("shape/{}/positions:{}", size.grid(), n_positions), [&, size](auto& state) {
      const Wheel& wheel = shop.wheel(size);
      measure(state, m.positions[size.n_positions], [&] { return wheel.evaluate(); });
    });
    add(fmt::format("shape/{}/all positions:{}", size.grid(), n_positions), [&, size](auto& state) {
      const Wheel& wheel = shop.wheel(size);
      measure(state, m.all_positions[size.n_positions], [&] { return wheel.evaluate_all_positions(); });
    });
  }
  for (size_t g = 0; g < grids.size(); ++g) {
    const Size size = grids[g];
    GridTimes& times = m.grids[g];
    add("sector Cholesky/" + size.grid(), [&, size](auto& state) {
      const auto& solution = shop.solution(size);
      times.unknowns = ring_unknowns(solution.ring.sector().space);
      times.work = unavoidable_work(shop.wheel(size).problem(), solution);
      sector_cholesky(state, solution, times.phase("of factorization: sector Cholesky"));
    });
    add("contact operators/" + size.grid(), [&, size](auto& state) {
      contact_operators(state, shop.wheel(size), shop.solution(size), times.phase("of contact: operators"));
    });
    add("Newton iteration/" + size.grid(), [&, size](auto& state) {
      newton(state, shop.solution(size), times.phase("of contact: one Newton iteration"));
    });
    add("velocity/" + size.grid(), [&, size](auto& state) {
      const Evolution evolution(shop.wheel(size));
      measure(state, times.phase("evolution: velocity"), [&] { return evolution.velocity(); });
    });
    add("transport/" + size.grid(), [&, size](auto& state) {
      const Evolution evolution(shop.wheel(size));
      measure(state, times.phase("evolution: transport"), [&] { return evolution.move(); });
    });
    add("exact volume/" + size.grid(), [&, size](auto& state) {
      const Evolution evolution(shop.wheel(size));
      measure(state, times.phase("evolution: exact volume"), [&] { return evolution.hold_measure(); });
    });
    add("redistancing/" + size.grid(), [&, size](auto& state) {
      const Evolution evolution(shop.wheel(size));
      measure(state, times.phase("evolution: redistancing"), [&] { return evolution.redistance(); });
    });
  }
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  using namespace wheelwright::bench;
  wheelwright::restart_with_blas_settings(arguments);
  wheelwright::keep_freed_memory();
  const wheelwright::ThreadLimit one_thread(1);
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  Workshop shop;
  Measurements measurements;
  add_benchmarks(shop, measurements);
  benchmark::RunSpecifiedBenchmarks();
  fmt::print("\n{}", summary(measurements, reference.grid()));
  benchmark::Shutdown();
}
