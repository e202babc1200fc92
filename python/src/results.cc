#include <pybind11/stl.h>

#include "computed.h"
#include "held_case.h"
#include "held_state.h"
#include "module.h"
#include "views.h"
#include "wheelwright/cad/outline/check_outline.h"
#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/case/version.h"
#include "wheelwright/output/export/fit_surface.h"
#include "wheelwright/output/export/formats.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"

namespace wheelwright::python {
namespace {

template <class Value>
py::array of_positions(const std::vector<ContactSummary>& positions, Value ContactSummary::*member) {
  std::vector<double> values;
  for (const ContactSummary& position : positions) values.push_back(position.*member);
  return owned(std::move(values));
}

/// Numbers, or None if they could not be solved.
py::object optional_numbers(const Expected<std::vector<double>>& values) {
  if (!values) return py::none();
  return owned(std::vector<double>(*values));
}

template <int dim>
py::dict analysis(const HeldState<dim>& held) {
  const RollingAnalysis result =
      without_gil([&] { return rolling_analysis<dim>(*held.solver, *held.state); });
  py::dict values;
  values["azimuths"] = owned(std::vector<double>(result.azimuths));
  values["strain_energy"] = owned(std::vector<double>(result.strain_energy));
  values["peak_von_mises"] = owned(std::vector<double>(result.peak_von_mises));
  values["peak_strain"] = owned(std::vector<double>(result.peak_strain));
  values["travel"] = of_positions(result.positions, &ContactSummary::travel);
  values["radial_force"] = of_positions(result.positions, &ContactSummary::radial_force);
  values["peak_pressure"] = of_positions(result.positions, &ContactSummary::peak_pressure);
  values["patch_length"] = of_positions(result.positions, &ContactSummary::patch_length);
  values["friction_force"] = of_positions(result.positions, &ContactSummary::friction_force);
  values["wind_up"] = of_positions(result.positions, &ContactSummary::wind_up);
  values["descent"] = of_positions(result.positions, &ContactSummary::descent);
  values["travel_at_load"] = optional_numbers(result.travel_at_load);
  values["force_at_travel"] = optional_numbers(result.force_at_travel);
  return values;
}

const ExportFormat& format_of(const std::string& name) {
  if (const ExportFormat* format = find_export_format(name)) return *format;
  std::string known;
  for (const ExportFormat& one : export_formats())
    known += (known.empty() ? "" : ", ") + std::string(one.name);
  throw py::value_error(name + " is none of the formats " + known);
}

std::string program() { return "wheelwright " + std::string(version()); }

[[noreturn]] void refuse(const std::vector<cad::OutlineFault>& faults) {
  std::string text;
  for (const cad::OutlineFault& fault : faults) text += (text.empty() ? "" : "; ") + fault.what;
  raise("Error", text);
}

py::bytes file(const LevelSet<2>& psi, const HeldCase& held, const ExportFormat& format, double tolerance) {
  if (!format.of_plane) throw py::value_error(std::string(format.name) + " cannot hold a plane wheel");
  const auto outline = without_gil([&] { return cad::fit_outline(psi, tolerance); });
  if (!outline) refuse({outline.failure()});
  const auto checked = without_gil([&] { return cad::check_outline(*outline, psi, tolerance); });
  if (!checked) refuse(checked.failure());
  return without_gil([&] {
    return format.of_plane(WheelModel{.title = held.value.title,
                                      .program = program(),
                                      .shape = psi,
                                      .outline = *outline,
                                      .width = held.value.wheel.width,
                                      .tolerance = tolerance});
  });
}

py::bytes file(const LevelSet<3>& psi, const HeldCase& held, const ExportFormat& format, double tolerance) {
  if (!format.of_surface)
    throw py::value_error(std::string(format.name) +
                          " cannot hold a wheel whose shape changes along the axle");
  const int degree = held.value.grid.degree;
  const auto fitted = without_gil([&] { return fit_surface(psi, degree, tolerance); });
  if (!fitted) raise("Error", fitted.failure().what);
  return without_gil([&] {
    return format.of_surface(SurfaceModel{.title = held.value.title,
                                          .program = program(),
                                          .shape = psi,
                                          .surface = fitted->surface,
                                          .parts = fitted->parts,
                                          .map_degree = degree});
  });
}

}  // namespace

template <int dim>
void bind_results(py::module_& m) {
  m.def("analysis", &analysis<dim>);
  m.def("file", [](const LevelSet<dim>& psi, const HeldCase& held, const std::string& format,
                   double tolerance) { return file(psi, held, format_of(format), tolerance); });
}

template void bind_results<2>(py::module_&);
template void bind_results<3>(py::module_&);

}  // namespace wheelwright::python
