#pragma once

#include <functional>

#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/position_functions.h"

namespace wheelwright {

/// Adds to `sum` the derivative of a function of all positions' values of one functional: `slopes` with
/// respect to each of them, mirror images included. A position's derivative is per position that it
/// represents.
template <int dim>
void add_over_positions(const LoadPositions& positions, const FunctionalDerivative<dim>& of_functional,
                        std::span<const double> slopes, FunctionalDerivative<dim>& sum);

/// A function of a functional's values at all load positions: their mean, the worst of them, a harmonic.
template <int dim>
class FunctionOfPositions : public Functional<dim> {
 public:
  using Function = std::function<OfPositions(std::span<const double>)>;

  /// The function must have the same value for the positions in reverse order.
  FunctionOfPositions(std::string name, std::shared_ptr<const Functional<dim>> functional, Function function)
      : name_(std::move(name)), functional_(std::move(functional)), function_(std::move(function)) {}

  std::string name() const override { return name_; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane plane) const override {
    return functional_->is_mirror_symmetric(plane);
  }

 private:
  std::string name_;
  std::shared_ptr<const Functional<dim>> functional_;
  Function function_;
};

/// mean of a over the positions / mean of b: the mean stiffness is the mean force by the mean travel. a may
/// also be one value of all positions together.
template <int dim>
class RatioOfMeans : public Functional<dim> {
 public:
  RatioOfMeans(std::string name, std::shared_ptr<const Functional<dim>> numerator,
               std::shared_ptr<const Functional<dim>> denominator)
      : name_(std::move(name)), numerator_(std::move(numerator)), denominator_(std::move(denominator)) {}

  std::string name() const override { return name_; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane plane) const override {
    return numerator_->is_mirror_symmetric(plane) && denominator_->is_mirror_symmetric(plane);
  }

 private:
  std::string name_;
  std::shared_ptr<const Functional<dim>> numerator_, denominator_;
};

}  // namespace wheelwright
