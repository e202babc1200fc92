#include "module.h"

#include "errors.h"

namespace wheelwright::python {
namespace {

template <int dim>
void bind(py::module_ m) {
  bind_shape<dim>(m);
  bind_state<dim>(m);
  bind_study<dim>(m);
  bind_optimizer<dim>(m);
  bind_run<dim>(m);
  bind_results<dim>(m);
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  translate_errors();
  bind_settings(m);
  bind_case(m);
  bind_pages(m);
  bind<2>(m.def_submodule("plane"));
  bind<3>(m.def_submodule("solid"));
  bind_designs(m);
}

}  // namespace wheelwright::python
