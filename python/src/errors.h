#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/diagnostic.h"

namespace wheelwright::python {

namespace py = pybind11;

// The exceptions are classes of wheelwright/errors.py.

[[noreturn]] void raise(const Failure& failure);
[[noreturn]] void raise(const std::vector<Diagnostic>& problems);

/// An exception of the class of that name, with these arguments.
template <class... Arguments>
[[noreturn]] void raise(const char* name, Arguments&&... arguments) {
  const py::object type = py::module_::import("wheelwright.errors").attr(name);
  const py::object error = type(std::forward<Arguments>(arguments)...);
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

template <class T>
T value_of(Expected<T> expected) {
  if (!expected) raise(expected.failure());
  return *std::move(expected);
}

/// Errors of the library that are exceptions become those of errors.py.
void translate_errors();

}  // namespace wheelwright::python
