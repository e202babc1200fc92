#pragma once

#include "wheelwright/base/interrupt.h"
#include "wheelwright/output/report/accurate_numbers.h"
#include "wheelwright/run/results/finer_wheel.h"

namespace wheelwright {

/// The numbers of a shape, solved on finer and finer grids until the estimated error of each is at most
/// `accuracy` times its size, or until the next grid costs too much or cannot be solved (finer_shape). Those
/// of the last grid but one, whose errors are known. `states`: by the solver, at all load positions; they
/// must exist. `finer`: the same shape on the first finer grid, or why it is not known.
template <int dim>
AccurateNumbers refined_numbers(const Case& c, const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const SolvedStates<dim>& states,
                                Expected<SolvedFinerShape<dim>, std::string> finer, double accuracy,
                                const Interrupt& interrupt);

/// Where the largest stress of a wheel is, in words: at the rim, at the tread, or inside the ring.
template <int dim>
std::string place_of_stress(const DescribedWheel<dim>& wheel);

}  // namespace wheelwright
