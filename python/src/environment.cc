#include <pybind11/pybind11.h>

#include "wheelwright/base/fastest_kernels.h"

// A module that does not load BLAS: what to set before that.
PYBIND11_MODULE(_environment, m) {
  m.def("fastest_kernels", [] {
    const char* kernels = wheelwright::fastest_kernels();
    return kernels ? pybind11::object(pybind11::str(kernels)) : pybind11::none();
  });
}
