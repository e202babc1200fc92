#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// a_i / b_i of every load position: a stiffness is a force by a motion.
template <int dim>
class Quotient : public Functional<dim> {
 public:
  Quotient(std::string name, std::shared_ptr<const Functional<dim>> numerator,
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
