#include "wheelwright/run/study/moved_studies.h"

#include <algorithm>

#include "wheelwright/case/design_radii.h"

namespace wheelwright {

template <int dim>
MovedStudies<dim>::MovedStudies(Study<dim> study) : source_(study.source), level_(study.level) {
  remembered(std::move(study));
}

template <int dim>
Expected<std::shared_ptr<const typename MovedStudies<dim>::Moved>> MovedStudies<dim>::on(
    const PolarGrid<dim>& grid) {
  const std::lock_guard lock(mutex_);
  for (const auto& moved : newest_)
    if (moved->study.grid() == grid) return moved;
  const auto c = with_radii_of(source_, grid, level_);
  if (!c) return Failure{FailureReason::unsupported_model, "the grid does not have the lines of the case"};
  auto study = make_study<dim>(*c, level_);
  if (!study) return study.failure();
  return remembered(*std::move(study));
}

template <int dim>
std::shared_ptr<const typename MovedStudies<dim>::Moved> MovedStudies<dim>::remembered(Study<dim> study) {
  constexpr std::size_t most = 4;
  auto evolver = std::make_shared<const Evolver<dim>>(study.initial.lattice,
                                                      in_space_of(study.optimizer.method, study.evolution));
  if (newest_.size() == most) newest_.erase(newest_.begin());
  newest_.push_back(std::make_shared<const Moved>(Moved{std::move(study), std::move(evolver)}));
  return newest_.back();
}

template <int dim>
ShapeOptimizer<dim> optimizer_of(const Study<dim>& study, const std::shared_ptr<MovedStudies<dim>>& studies,
                                 const Interrupt& interrupt) {
  if (!studies)
    return {study.initial.lattice, study.evolution, study.optimizer, evaluate_of(study, interrupt)};
  const SettingOn<dim> setting_on = [studies,
                                     interrupt](const PolarGrid<dim>& grid) -> Expected<Setting<dim>> {
    const auto moved = studies->on(grid);
    if (!moved) return moved.failure();
    return Setting<dim>{(*moved)->evolver, evaluate_of((*moved)->study, interrupt)};
  };
  auto here = setting_on(study.grid());
  if (!here) return {study.initial.lattice, study.evolution, study.optimizer, evaluate_of(study, interrupt)};
  return {study.grid(), *std::move(here), study.optimizer, setting_on};
}

template <int dim>
std::shared_ptr<MovedStudies<dim>> moved_studies(const Study<dim>& study) {
  if (study.optimizer.design_lines.empty()) return nullptr;
  return std::make_shared<MovedStudies<dim>>(study);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                      \
  template class MovedStudies<dim>;                                                                       \
  template ShapeOptimizer<dim> optimizer_of(const Study<dim>&, const std::shared_ptr<MovedStudies<dim>>&, \
                                            const Interrupt&);                                            \
  template decltype(moved_studies<dim>) moved_studies<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
