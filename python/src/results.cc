#include <pybind11/stl.h>

#include "computed.h"
#include "held_case.h"
#include "held_state.h"
#include "module.h"
#include "views.h"
#include "wheelwright/output/export/formats.h"
#include "wheelwright/output/page/report_run.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/run/checkpoints/resume_point.h"
#include "wheelwright/run/observers/solved_report.h"
#include "wheelwright/run/results/fitted_wheel.h"
#include "wheelwright/shape/geometry/invariance.h"
#include "wheelwright/shape/geometry/section.h"

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

std::string written(const ExportFormat& format, const WheelModel& model) {
  if (!format.of_plane) throw py::value_error(std::string(format.name) + " cannot hold a plane wheel");
  return without_gil([&] { return format.of_plane(model); });
}

std::string written(const ExportFormat& format, const SurfaceModel& model) {
  if (!format.of_surface)
    throw py::value_error(std::string(format.name) +
                          " cannot hold a wheel whose shape changes along the axle");
  return without_gil([&] { return format.of_surface(model); });
}

/// The wheel, or one of its layers as a wheel of its own.
template <class Model>
Model part_of(const Model& wheel, const std::optional<std::string>& layer) {
  if (!layer) return wheel;
  std::string known;
  for (const auto& one : wheel.layers) {
    if (one.name == *layer) return layer_model(wheel, one);
    known += (known.empty() ? "" : ", ") + one.name;
  }
  throw py::value_error("the wheel has no layer " + *layer +
                        (known.empty() ? "; it is of one material" : "; it has " + known));
}

template <int dim>
constexpr double usual_tolerance = dim == 2 ? 1e-5 : 1e-4;  // [m], as the program's

/// The file of a shape, or of one layer, in a format. A wheel that is the same all along the axle has that of
/// a plane wheel.
template <int dim>
py::bytes file(const LevelSet<dim>& psi, const HeldCase& held, const std::string& format,
               std::optional<double> tolerance, const std::optional<std::string>& layer) {
  const ExportFormat& named = format_of(format);
  if constexpr (dim == 3)
    if (named.of_plane && is_invariant(psi, Invariance::along_axle))
      return file<2>(mid_plane_section(psi), held, format, tolerance, layer);
  const auto wheel = without_gil([&] {
    return fitted_wheel(held.value, psi, held.value.title, tolerance.value_or(usual_tolerance<dim>));
  });
  if (wheel) return written(named, part_of(wheel->model, layer));
  std::string text;
  for (const cad::OutlineFault& fault : wheel.failure()) text += (text.empty() ? "" : "; ") + fault.what;
  raise("Error", text);
}

/// What the page shows of a run in a folder.
template <int dim>
PageRun page_run_of(const HeldCase& held, const std::string& folder) {
  const auto point = without_gil([&] { return resume_point<dim>(folder, held.value); });
  if (!point.newest)
    raise("RunError", "no_usable_checkpoint", folder + ": no usable checkpoint of this case");
  return computed([&](const Interrupt& interrupt) {
    return solved_page_run(folder, held.value, *point.newest, interrupt);
  });
}

}  // namespace

template <int dim>
void bind_results(py::module_& m) {
  m.def("analysis", &analysis<dim>);
  m.def("file", &file<dim>);
  m.def("page_run", &page_run_of<dim>);
}

void bind_pages(py::module_& m) {
  py::class_<PageRun>(m, "PageRun");
  m.def("report_page", [](const std::vector<PageRun>& runs) { return report_page(runs); });
}

template void bind_results<2>(py::module_&);
template void bind_results<3>(py::module_&);

}  // namespace wheelwright::python
