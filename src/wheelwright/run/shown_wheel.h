#pragma once

#include <optional>
#include <string>

#include "wheelwright/page/report_run.h"
#include "wheelwright/report/field_points.h"

namespace wheelwright {

/// A shape that was solved for results.
template <int dim>
struct SolvedShape {
  const LevelSet<dim>* shape;
  const StateSolver<dim>* solver;
  const State<dim>* solution;
};

/// Collects what the page shows of the load positions of a shape, one after the other. In 3D, where all of
/// them are too many for the page, it keeps the worst one.
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
  std::optional<int> only_;  ///< the position that is kept; all without it
};

/// The shape in all of its load positions.
template <int dim>
ShownWheel<dim> shown_wheel(const SolvedShape<dim>& solved);

/// The loaded wheel in one of its load positions, as the page holds it.
template <int dim>
std::string loaded_wheel(const SolvedShape<dim>& solved, int position);

}  // namespace wheelwright
