#pragma once

#include <pybind11/pybind11.h>

#include "wheelwright/quantities/functionals/quantity.h"

namespace wheelwright::python {

namespace py = pybind11;

/// The quantity of a functional written in Python, an object of wheelwright.Functional, MaterialDensity or
/// EdgeDensity. It owns the object: what C++ holds keeps its Python part.
QuantityRow own_quantity(py::object functional);

}  // namespace wheelwright::python
