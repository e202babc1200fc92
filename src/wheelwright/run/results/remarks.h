#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/output/report/remark.h"

namespace wheelwright {

/// The numbers by which a wheel is judged under one load: in SI units, on the whole width; nothing if
/// unknown.
struct JudgedWheel {
  std::optional<double> load = {}, mean_travel = {}, stiffness = {}, run_out = {}, force_variation = {},
                        peak_pressure = {}, peak_von_mises = {}, largest_strain = {};
};

template <int dim>
JudgedWheel judged(const DescribedWheel<dim>& wheel);

/// The numbers that are worse by a tenth or more after an optimization: a lower stiffness; a larger run-out
/// or force variation, by at least 1 % of the travel or the load; a larger pressure, stress or strain.
/// Quantities bounded by the case are omitted. Walls and gaps are covered by feature_warnings(). The
/// constraints keep the earlier value, and the case with them is valid. `load_case`: the name of the case's
/// load case; empty if it has one load.
std::vector<Remark> remarks(const Case& c, const std::string& load_case, const JudgedWheel& before,
                            const JudgedWheel& after);

/// Under all load cases.
template <int dim>
std::vector<Remark> remarks(const Case& c, const DescribedWheel<dim>& before,
                            const DescribedWheel<dim>& after);

}  // namespace wheelwright
