#pragma once

#include <pybind11/pybind11.h>

namespace wheelwright::python {

namespace py = pybind11;

// What module.cc puts together; one function for every subject. Those of one dimension put their classes into
// the module `plane` or `solid`.

void bind_case(py::module_& m);
void bind_settings(py::module_& m);
void bind_designs(py::module_& m);
void bind_pages(py::module_& m);
template <int dim>
void bind_shape(py::module_& m);
template <int dim>
void bind_state(py::module_& m);
template <int dim>
void bind_study(py::module_& m);
template <int dim>
void bind_optimizer(py::module_& m);
template <int dim>
void bind_run(py::module_& m);
template <int dim>
void bind_results(py::module_& m);

}  // namespace wheelwright::python
