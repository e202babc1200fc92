#include <memory>

#include "module.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/case/version.h"

namespace wheelwright::python {

void bind_settings(py::module_& m) {
  m.def("version", [] { return std::string(version()); });
  m.def("keep_freed_memory", keep_freed_memory);
  m.def("give_freed_memory_back", give_freed_memory_back);
  m.def("blas_kernels", [] { return blas_settings().kernels; });
  m.def("blas_threads", [] { return blas_settings().threads; });
  py::class_<ThreadLimit>(m, "ThreadLimit").def(py::init<int>());
}

}  // namespace wheelwright::python
