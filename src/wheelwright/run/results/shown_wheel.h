#pragma once

#include <optional>
#include <string>

#include "wheelwright/output/page/report_run.h"
#include "wheelwright/output/report/field_points.h"

namespace wheelwright {

/// A solved shape for results.
template <int dim>
struct SolvedShape {
  const LevelSet<dim>* shape;
  const StateSolver<dim>* solver;
  const State<dim>* solution;
};

/// Collects the load positions of a shape for the page, one after the other. In 3D, if all of them are too
/// large for the page, keeps only the most stressed one.
template <int dim>
class ShownPositions;

template <>
class ShownPositions<2> {
 public:
  explicit ShownPositions(const SolvedShape<2>& solved);
  void add(int position, const PositionFields<2>& fields);
  ShownWheel<2> wheel() && { return std::move(wheel_); }

 private:
  ShownWheel<2> wheel_;
};

template <>
class ShownPositions<3> {
 public:
  explicit ShownPositions(const SolvedShape<3>& solved);
  void add(int position, const PositionFields<3>& fields);
  ShownWheel<3> wheel() && { return std::move(wheel_); }

 private:
  ShownWheel<3> wheel_;
  FieldPoints<3> points_;    ///< the vertices of the surface
  std::optional<int> only_;  ///< the only position to keep; absent: all
};

/// The shape at all of its load positions.
template <int dim>
ShownWheel<dim> shown_wheel(const SolvedShape<dim>& solved);

/// The loaded wheel at one of its load positions, in the form of the page.
template <int dim>
std::string loaded_wheel(const SolvedShape<dim>& solved, int position);

}  // namespace wheelwright
