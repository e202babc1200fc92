#include <pybind11/stl.h>

#include "computed.h"
#include "held_state.h"
#include "module.h"
#include "views.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/place_in_body.h"
#include "wheelwright/output/report/solution_fields.h"

namespace wheelwright::python {
namespace {

/// The contact of one position, which shares the ownership of its state.
template <int dim>
struct HeldContact {
  HeldState<dim> held;
  int position;

  const ContactPatch<dim>& patch() const { return held.state->contacts()[position]; }
};

py::tuple motion(const RimMotion& rim) {
  return py::make_tuple(rim.towards_ground, rim.along_ground, rim.rotation, rim.along_axle);
}

py::tuple force(const RimForce& rim) {
  return py::make_tuple(rim.towards_ground, rim.along_ground, rim.torque, rim.along_axle);
}

template <int dim>
Vec<dim> place_of(const RollingModel<dim>& model, const SurfacePoint<dim>& point) {
  return cartesian_place<dim>(model.grid, model.degree, point.cell, point.xi);
}

/// A field of the whole ring: (sector, azimuth, [axial,] radial, component).
template <int dim>
py::array ring_array(const Lattice<dim>& lattice, RingField field) {
  const auto& nodes = lattice.nodes();
  Shape shape{lattice.grid().n_sectors, nodes[1]};
  if constexpr (dim == 3) shape.push_back(nodes[2]);
  shape.push_back(nodes[0]);
  shape.push_back(field.components);
  return owned(std::move(field.values), shape);
}

/// With a position that exists.
template <int dim>
void check_position(const HeldState<dim>& held, int position) {
  if (position < 0 || position >= held.state->positions().size())
    throw py::index_error("there are " + std::to_string(held.state->positions().size()) + " positions");
}

template <int dim>
py::array displacement(const HeldState<dim>& held, int position) {
  check_position(held, position);
  return ring_array(displacement_lattice(held.state->model()),
                    without_gil([&] { return held.state->displacement().at_nodes(position); }));
}

template <int dim>
py::array stress(const HeldState<dim>& held, int position) {
  check_position(held, position);
  const auto& model = held.state->model();
  return ring_array(displacement_lattice(model), without_gil([&] {
                      return stress_field<dim>(model, held.state->domain(),
                                               held.state->displacement().at_nodes(position));
                    }));
}

/// Of every load position of a sector, images too: places along the ground and pressures, (place, pressure).
template <int dim>
py::list pressure_curves(const HeldState<dim>& held) {
  const auto points =
      without_gil([&] { return curve_points<dim>(contact_points<dim>(*held.solver, *held.state)); });
  std::vector<std::array<std::vector<double>, 2>> curves;
  for (const ContactPoint& point : points) {
    curves.resize(std::max<std::size_t>(curves.size(), point.position + 1));
    curves[point.position][0].push_back(point.x);
    curves[point.position][1].push_back(point.pressure);
  }
  py::list result;
  for (auto& [places, pressures] : curves)
    result.append(py::make_tuple(owned(std::move(places)), owned(std::move(pressures))));
  return result;
}

/// A cell with its strains, which it owns.
template <int dim>
struct HeldCell {
  HeldState<dim> held;
  StrainedCell<dim> cell;
};

/// Covers all rows: for the cells of the whole material.
template <int dim>
class Everywhere : public MaterialDensity<dim> {
 public:
  Matrix densities(const StrainsInCell<dim>& cell) const override {
    return Matrix(cell.n_cases(), cell.n_points());
  }
  Matrix slopes(const StrainsInCell<dim>& cell, std::span<const double>) const override {
    return Matrix(cell.n_cases(), n_strains<dim> * cell.n_points());
  }
};

/// The cells with material, one after the other.
template <int dim>
struct HeldCells {
  explicit HeldCells(HeldState<dim> state)
      : held(std::move(state)), cells(*held.solver, *held.state, Everywhere<dim>()) {}

  HeldState<dim> held;
  StrainedCells<dim> cells;
  int next = 0;
};

template <int dim>
void bind_cells(py::module_& m) {
  py::class_<HeldCell<dim>>(m, "Cell")
      .def_property_readonly("weights",
                             [](const py::object& self) {
                               const auto& weights = py::cast<const HeldCell<dim>&>(self).cell.weights;
                               return view(self, weights.data(), {static_cast<py::ssize_t>(weights.size())});
                             })
      .def_property_readonly(
          "points",
          [](const HeldCell<dim>& held) {
            const RollingModel<dim>& model = held.held.state->model();
            std::vector<Vec<dim>> places;
            for (const Vec<dim>& xi : held.cell.points())
              places.push_back(cartesian_place<dim>(model.grid, model.degree, held.cell.cell_index, xi));
            return rows<dim>(places);
          })
      .def_property_readonly(
          "strains",
          [](const py::object& self) {
            const StrainedCell<dim>& cell = py::cast<const HeldCell<dim>&>(self).cell;
            const py::ssize_t n_cases = cell.n_cases(), n_sectors = cell.n_sectors(), size = sizeof(double);
            return view(self, cell.strains().data(),
                        {n_cases / n_sectors, n_sectors, cell.n_points(), n_strains<dim>},
                        {n_sectors * size, size, n_strains<dim> * n_cases * size, n_cases * size});
          })
      .def_property_readonly("material", [](const HeldCell<dim>& held) {
        return HeldMaterial<dim>{held.held.solver, &held.cell.law()};
      });
  py::class_<HeldCells<dim>>(m, "Cells")
      .def("__len__", [](const HeldCells<dim>& held) { return held.cells.size(); })
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", [](HeldCells<dim>& held) {
        if (held.next == held.cells.size()) throw py::stop_iteration();
        const int k = held.next++;
        return without_gil([&] { return HeldCell<dim>{held.held, held.cells[k]}; });
      });
}

/// Components of points, each contiguous.
template <int dim>
StrainRows<dim> strain_rows(const Array& strains) {
  if (strains.ndim() != 2 || strains.shape(0) != n_strains<dim>)
    throw py::value_error("expected " + std::to_string(n_strains<dim>) + " components of strains");
  StrainRows<dim> rows;
  for (int k = 0; k < n_strains<dim>; ++k)
    rows[k] = {strains.data(k, 0), static_cast<std::size_t>(strains.shape(1))};
  return rows;
}

/// Tensors of the same points, from ask(rows to be written).
template <int dim, class Ask>
py::array tensors(const Array& strains, const Ask& ask) {
  const auto n = static_cast<std::size_t>(strains.shape(1));
  std::vector<double> result(n_strains<dim> * n);
  StressRows<dim> rows;
  for (int k = 0; k < n_strains<dim>; ++k) rows[k] = std::span(result).subspan(k * n, n);
  ask(strain_rows<dim>(strains), rows);
  return owned(std::move(result), {n_strains<dim>, static_cast<py::ssize_t>(n)});
}

template <int dim, class Ask>
py::array scalars(const Array& strains, const Ask& ask) {
  std::vector<double> result(strains.shape(1));
  ask(strain_rows<dim>(strains), std::span<double>(result));
  return owned(std::move(result));
}

template <int dim>
void bind_material(py::module_& m) {
  using Held = HeldMaterial<dim>;
  py::class_<Held>(m, "Material")
      .def("stress",
           [](const Held& held, const Array& strains) {
             return tensors<dim>(strains,
                                 [&](const auto& from, const auto& to) { held.law->stress(from, to); });
           })
      .def("energy_density",
           [](const Held& held, const Array& strains) {
             return scalars<dim>(strains,
                                 [&](const auto& from, auto to) { held.law->energy_density(from, to); });
           })
      .def("squared_von_mises",
           [](const Held& held, const Array& strains) {
             return scalars<dim>(strains,
                                 [&](const auto& from, auto to) { held.law->squared_von_mises(from, to); });
           })
      .def("squared_von_mises_slope",
           [](const Held& held, const Array& strains) {
             return tensors<dim>(strains, [&](const auto& from, const auto& to) {
               held.law->squared_von_mises_slope(from, to);
             });
           })
      .def_property_readonly("modulus", [](const Held& held) { return held.law->scaling_modulus(); })
      .def_property_readonly("lame", [](const Held& held) -> py::object {
        const Material* material = held.law->isotropic();
        if (!material) return py::none();
        return py::make_tuple(material->lambda(), material->mu());
      });
}

template <int dim>
void bind_contact(py::module_& m) {
  using Held = HeldContact<dim>;
  using Point = typename ContactPatch<dim>::Point;
  const auto points = [](auto member) {
    return [member](const py::object& self) {
      return members(self, py::cast<const Held&>(self).patch().points, member);
    };
  };
  py::class_<Held>(m, "Contact")
      .def_property_readonly("place", points(&Point::position))
      .def_property_readonly("gap", points(&Point::gap))
      .def_property_readonly("weight", points(&Point::weight))
      .def_property_readonly("traction", points(&Point::traction))
      .def_property_readonly("column", points(&Point::column))
      .def_property_readonly("ground_traction",
                             [](const Held& held) {
                               std::vector<Vec<dim>> tractions;
                               for (const Point& point : held.patch().points)
                                 tractions.push_back(point.ground_traction());
                               return rows<dim>(tractions);
                             })
      .def_property_readonly("rim", [](const Held& held) { return motion(held.patch().rim); })
      .def_property_readonly("rim_force", [](const Held& held) { return force(held.patch().rim_force); })
      .def_property_readonly("growth", [](const Held& held) { return held.patch().growth; })
      .def_property_readonly("travel", [](const Held& held) { return held.patch().travel(); })
      .def_property_readonly("newton_iterations",
                             [](const Held& held) { return held.patch().newton_iterations; });
}

}  // namespace

template <int dim>
void bind_state(py::module_& m) {
  using Held = HeldState<dim>;
  bind_material<dim>(m);
  bind_contact<dim>(m);
  bind_cells<dim>(m);
  py::class_<Held>(m, "State")
      .def_property_readonly("dimension", [](const Held&) { return dim; })
      .def_property_readonly("n_positions", [](const Held& held) { return held.state->positions().size(); })
      .def_property_readonly("n_sectors", [](const Held& held) { return held.state->model().grid.n_sectors; })
      .def_property_readonly("azimuths",
                             [](const Held& held) {
                               std::vector<double> azimuths;
                               for (const GroundPosition& ground : held.state->positions().grounds)
                                 azimuths.push_back(ground.azimuth(held.state->model().grid));
                               return owned(std::move(azimuths));
                             })
      .def_property_readonly("multiplicities",
                             [](const py::object& self) {
                               const auto& counts =
                                   py::cast<const Held&>(self).state->positions().multiplicities;
                               return view(self, counts.data(), {static_cast<py::ssize_t>(counts.size())});
                             })
      .def_property_readonly("contacts",
                             [](const Held& held) {
                               std::vector<HeldContact<dim>> contacts;
                               for (int i = 0; i < held.state->positions().size(); ++i)
                                 contacts.push_back({held, i});
                               return contacts;
                             })
      .def_property_readonly("strain_energy",
                             [](const py::object& self) {
                               const auto& energy = py::cast<const Held&>(self).state->strain_energy();
                               return view(self, energy.data(), {static_cast<py::ssize_t>(energy.size())});
                             })
      .def_property_readonly("observations",
                             [](const py::object& self) {
                               const Held& held = py::cast<const Held&>(self);
                               const Matrix& all = held.state->observations();
                               const py::ssize_t n = held.state->positions().size();
                               return view(self, all.data(), {n, all.columns() / n, all.rows()});
                             })
      .def_property_readonly("observation_rows",
                             [](const Held& held) {
                               const auto rows = held.solver->tread_surface().rows();
                               return py::make_tuple(rows.n_points, rows.n_annulus_points, rows.has_spin);
                             })
      .def_property_readonly("tread_weights",
                             [](const Held& held) {
                               std::vector<double> weights;
                               for (const auto& point : held.solver->tread_surface().points)
                                 weights.push_back(point.weight);
                               return owned(std::move(weights));
                             })
      .def("displacement", &displacement<dim>)
      .def("stress", &stress<dim>)
      .def("pressure_curves", &pressure_curves<dim>)
      .def("cells",
           [](const Held& held) {
             return without_gil([&] { return std::make_unique<HeldCells<dim>>(held); });
           })
      .def_property_readonly("largest_von_mises",
                             [](const Held& held) {
                               return owned(std::vector<double>(
                                   without_gil([&] { return held.state->strain_peaks().von_mises; })));
                             })
      .def_property_readonly("boundary_points",
                             [](const Held& held) {
                               std::vector<Vec<dim>> places;
                               for (const auto& point : held.state->boundary())
                                 places.push_back(place_of(held.state->model(), point));
                               return rows<dim>(places);
                             })
      .def_property_readonly("level_set", [](const Held& held) { return LevelSet<dim>(*held.shape); })
      .def_property_readonly("phases", [](const Held& held) {
        py::dict phases;
        for (const auto& [phase, seconds] : held.state->phases()) phases[py::str(phase)] = seconds;
        return phases;
      });
}

template void bind_state<2>(py::module_&);
template void bind_state<3>(py::module_&);

}  // namespace wheelwright::python
