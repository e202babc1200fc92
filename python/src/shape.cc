#include <pybind11/stl.h>

#include "computed.h"
#include "held_case.h"
#include "module.h"
#include "views.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/study/gradient_check.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright::python {
namespace {

/// (azimuth, [axial,] radial).
template <int dim>
Shape array_shape(const Lattice<dim>& lattice) {
  const auto& nodes = lattice.nodes();
  if constexpr (dim == 3) return {nodes[1], nodes[2], nodes[0]};
  return {nodes[1], nodes[0]};
}

template <int dim>
LevelSet<dim> with_values(const LevelSet<dim>& psi, const Array& values) {
  const Shape shape = array_shape(psi.lattice);
  if (!std::equal(shape.begin(), shape.end(), values.shape(), values.shape() + values.ndim()))
    throw py::value_error("the values of a shape on this grid are an array " +
                          py::str(py::tuple(py::cast(shape))).cast<std::string>());
  return {psi.lattice, numbers(values)};
}

/// Polar coordinates of the nodes: (azimuth, [axial,] radial, component).
template <int dim>
py::array nodes(const LevelSet<dim>& psi) {
  std::vector<double> places;
  for (int i = 0; i < psi.lattice.n_nodes(); ++i) {
    const Vec<dim> place = psi.lattice.polar_point(i);
    places.insert(places.end(), place.begin(), place.end());
  }
  Shape shape = array_shape(psi.lattice);
  shape.push_back(dim);
  return owned(std::move(places), shape);
}

template <int dim>
LevelSet<dim> from_bytes(const py::bytes& bytes) {
  auto psi = parse_level_set_file<dim>(std::string_view(bytes));
  if (!psi) raise("FormatError", to_string(psi.failure().fault), psi.failure().detail);
  return *std::move(psi);
}

py::list contours(const LevelSet<2>& psi) {
  py::list result;
  for (const Contour& contour : material_contours(psi, contour_subdivisions(psi.lattice.degree())))
    result.append(rows<2>(contour.points));
  return result;
}

}  // namespace

template <int dim>
void bind_shape(py::module_& m) {
  using Psi = LevelSet<dim>;
  auto shape =
      py::class_<Psi, std::shared_ptr<Psi>>(m, "LevelSet")
          .def_property_readonly("values",
                                 [](const py::object& self) {
                                   const Psi& psi = py::cast<const Psi&>(self);
                                   return view(self, psi.values.data(), array_shape(psi.lattice));
                                 })
          .def("with_values", &with_values<dim>)
          .def("nodes", &nodes<dim>)
          .def("to_bytes", [](const Psi& psi) { return py::bytes(level_set_file(psi)); })
          .def_static("from_bytes", &from_bytes<dim>)
          .def_property_readonly(
              "measure", [](const Psi& psi) { return without_gil([&] { return material_measure(psi); }); })
          .def_property_readonly("resolution", [](const Psi& psi) { return psi.lattice.grid().resolution(); })
          .def_property_readonly("degree", [](const Psi& psi) { return psi.lattice.degree(); })
          .def_property_readonly("n_sectors", [](const Psi& psi) { return psi.lattice.grid().n_sectors; })
          .def_property_readonly("radii",
                                 [](const Psi& psi) {
                                   const auto& grid = psi.lattice.grid();
                                   return std::pair(grid.inner_radius, grid.outer_radius);
                                 })
          .def_property_readonly("test_step",
                                 [](const Psi& psi) { return largest_test_step(psi.lattice.grid()); })
          .def("test_direction", [](const Psi& psi, int number, double step) {
            return owned(test_direction(psi, number, step), array_shape(psi.lattice));
          });
  if constexpr (dim == 2) shape.def("contours", &contours);
  m.def("initial_shape", [](const HeldCase& held) { return initial_shape<dim>(held.value); });
}

template void bind_shape<2>(py::module_&);
template void bind_shape<3>(py::module_&);

}  // namespace wheelwright::python
