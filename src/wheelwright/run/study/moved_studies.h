#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// The studies of a case with other radii of its design lines (case/design_radii.h), each made once while it
/// is among the newest. May be called from several threads.
template <int dim>
class MovedStudies {
 public:
  struct Moved {
    Study<dim> study;
    std::shared_ptr<const Evolver<dim>> evolver;
  };

  explicit MovedStudies(Study<dim> study);

  /// With the radii of a grid, which is that of the study but for them. Fails like make_study().
  Expected<std::shared_ptr<const Moved>> on(const PolarGrid<dim>& grid);

 private:
  std::shared_ptr<const Moved> remembered(Study<dim> study);

  const Case source_;
  const int level_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<const Moved>> newest_;  ///< the oldest first
};

/// The loop on the study's functions. With `studies`, those of a case with design radii, it moves them;
/// otherwise null.
template <int dim>
ShapeOptimizer<dim> optimizer_of(const Study<dim>& study, const std::shared_ptr<MovedStudies<dim>>& studies,
                                 const Interrupt& interrupt);

/// Those of a study; null if its case has no design radii.
template <int dim>
std::shared_ptr<MovedStudies<dim>> moved_studies(const Study<dim>& study);

}  // namespace wheelwright
