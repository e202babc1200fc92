#include "wheelwright/run/observers/solved_report.h"

#include "wheelwright/case/derived.h"
#include "wheelwright/run/observers/run_report.h"
#include "wheelwright/run/results/final_results.h"
#include "wheelwright/run/results/given_wheel.h"
#include "wheelwright/run/results/summarized_run.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

template <int dim>
Expected<PageRun> solved_page_run(const std::filesystem::path& folder, const Case& c,
                                  const Checkpoint<dim>& checkpoint, const Interrupt& interrupt) {
  const auto study = make_study<dim>(c);
  if (!study) return study.failure();
  const auto made = make_solver(rolling_model<dim>(with_levels_of_results(c)));
  if (!made) return made.failure();
  const StateSolver<dim>& solver = **made;
  const auto solved = [&](const LevelSet<dim>& shape, const StateSolver<dim>& by) {
    return by.states(shape, distinct_positions(by, study->load_cases, shape), interrupt);
  };
  const Study<dim> given = given_study(*study, checkpoint.initial);
  const auto made_for_given = make_solver(rolling_model<dim>(with_levels_of_results(given.source)));
  if (!made_for_given) return made_for_given.failure();
  const OptimizationState<dim>& last = checkpoint.state;
  const auto last_states = solved(last.shape, solver);
  if (!last_states) return last_states.failure();
  const auto summary = summarized_run(
      *study, given, checkpoint.initial, objective_as_given(given, checkpoint.initial, interrupt),
      described(given.source, **made_for_given, given.load_cases, given.initial,
                material_measure(given.initial), solved(given.initial, **made_for_given)),
      last, described(c, solver, study->load_cases, last.shape, last.measure, last_states));
  const SolvedShape<dim> shape{&last.shape, &solver, last_states->get()};
  return page_run(report_of_results<dim>(folder, c, summary, shape, shown_wheel(shape), checkpoint.finished));
}

template decltype(solved_page_run<2>) solved_page_run<2>;
template decltype(solved_page_run<3>) solved_page_run<3>;

}  // namespace wheelwright
