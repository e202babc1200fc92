#include "wheelwright/run/session/journal.h"

#include "wheelwright/case/derived.h"

namespace wheelwright {

template <int dim>
void Journal<dim>::notify(const Event<dim>& event) const {
  notify(event, elapsed_);
}

template <int dim>
void Journal<dim>::notify(const Event<dim>& event, double elapsed) const {
  const auto bench = session_.bench();
  const RunView<dim> view{.folder = folder_,
                          .study = bench->study,
                          .evolver = bench->optimizer.evolver(),
                          .initial = session_.initial(),
                          .nucleation = session_.nucleation(),
                          .elapsed_seconds = elapsed,
                          .can_undo = !session_.past().empty(),
                          .observers = observers_};
  for (const auto& observer : observers_) (*observer)(event, view);
}

template <int dim>
void Journal<dim>::record(const Trial<dim>& trial) {
  sign_of_life_.lap();
  const double seconds = watch_.lap();
  elapsed_ += seconds;
  keep(trial);
  notify(TrialDone<dim>{trial, session_.state(), seconds});
  elapsed_ += watch_.lap();
}

template <int dim>
void Journal<dim>::keep(const Trial<dim>& trial) {
  if (trial.verdict == Verdict::failed) {
    failed_trials_.push_back(trial);
    failed_trials_.back().solution.reset();
    failed_trials_.back().other_solutions.clear();
  }
  if (trial.verdict != Verdict::accepted) return;
  failed_trials_.clear();
  const Study<dim>& study = session_.study();
  const OptimizationState<dim>& state = session_.state();
  const bool is_initial =
      state.iteration == 0 && study.level == 0 && state.shape.values == session_.initial()->shape.values;
  if (is_initial && trial.solution && tread_levels_of_results(study.source) == tread_levels(study.source))
    solved_.initial = described(study.source, *study.solver, study.load_cases, state.shape, state.measure,
                                SolvedStates<dim>(trial.solution));
  solved_.last = reason_to_stop(study.optimizer, state) ? trial.solution : nullptr;
}

template <int dim>
void Journal<dim>::set_failed(int iteration, const LevelSet<dim>& shape, const Failure& failure) {
  failed_trials_ = {Trial<dim>{.iteration = iteration,
                               .halvings = 0,
                               .step = 0,
                               .max_velocity = 0,
                               .evolution_seconds = 0,
                               .shape = shape,
                               .measure = 0,
                               .verdict = Verdict::failed,
                               .failure = failure}};
}

template <int dim>
void Journal<dim>::show(const ContactAdvanced& progress) {
  constexpr double seconds_between_signs = 2;
  if (sign_of_life_.seconds() < seconds_between_signs) return;
  sign_of_life_.lap();
  notify(progress, elapsed_ + watch_.seconds());
}

template <int dim>
void enter(Session<dim>& session, Journal<dim>& journal, Stage<dim> stage, const Event<dim>& change) {
  const Trial<dim> trial = std::move(stage.trial);
  session.enter(std::move(stage));
  if (std::holds_alternative<CaseChanged>(change)) journal.forget_solutions();
  journal.notify(change);
  journal.record(trial);
}

template class Journal<2>;
template class Journal<3>;
template decltype(enter<2>) enter<2>;
template decltype(enter<3>) enter<3>;

}  // namespace wheelwright
