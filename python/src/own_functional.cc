#include "own_functional.h"

#include <algorithm>

#include "held_state.h"
#include "views.h"
#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/mechanics/state/place_in_body.h"
#include "wheelwright/quantities/functionals/boundary_integral.h"
#include "wheelwright/quantities/functionals/shape_function.h"
#include "wheelwright/shape/cut/boundary_kinks.h"

namespace wheelwright::python {
namespace {

/// An object of Python that C++ owns, wherever its last owner ends.
class OwnedObject {
 public:
  explicit OwnedObject(py::object object) : object_(std::move(object)) {}
  OwnedObject(const OwnedObject&) = delete;
  OwnedObject& operator=(const OwnedObject&) = delete;
  ~OwnedObject() {
    if (!Py_IsInitialized()) {
      object_.release();  // the interpreter has freed it
      return;
    }
    const py::gil_scoped_acquire gil;
    object_ = py::object();
  }

  /// With the GIL.
  const py::object& get() const { return object_; }

 private:
  py::object object_;
};

using Owned = std::shared_ptr<const OwnedObject>;

/// What all kinds of own functionals say about themselves. Read once: it is asked for without the GIL.
struct Description {
  explicit Description(const py::object& functional)
      : name(functional.attr("name").cast<std::string>()),
        in_azimuth(functional.attr("symmetric_in_azimuth").cast<bool>()),
        across_width(functional.attr("symmetric_across_width").cast<bool>()) {}

  bool is_mirror_symmetric(MirrorPlane plane) const {
    return plane == MirrorPlane::azimuth ? in_azimuth : across_width;
  }

  std::string name;
  bool in_azimuth, across_width;
};

template <int dim>
HeldState<dim> held(const StateSolver<dim>& solver, const LevelSet<dim>& psi, const State<dim>& state) {
  return {solver.shared_from_this(), state.shared_from_this(), std::make_shared<const LevelSet<dim>>(psi)};
}

/// A vector per point of every position: [position][point][component].
template <int dim>
std::vector<std::vector<Vec<dim>>> vectors(const py::object& lists) {
  std::vector<std::vector<Vec<dim>>> result;
  for (const py::handle one : lists) {
    const auto array = py::cast<Array>(one);
    std::vector<Vec<dim>> of_position(array.shape(0));
    for (std::size_t i = 0; i < of_position.size(); ++i)
      std::copy_n(array.data(i, 0), dim, of_position[i].begin());
    result.push_back(std::move(of_position));
  }
  return result;
}

std::vector<double> optional_numbers(const py::object& array) {
  return array.is_none() ? std::vector<double>() : numbers(py::cast<Array>(array));
}

/// The derivatives in `result`, whose shapes Python has checked.
template <int dim>
FunctionalDerivative<dim> derivative(const py::object& result, const State<dim>& state) {
  FunctionalDerivative<dim> derivative{.energy = optional_numbers(result.attr("d_energy")),
                                       .growth = optional_numbers(result.attr("d_growth"))};
  if (const py::object tractions = result.attr("d_traction"); !tractions.is_none())
    derivative.tractions = vectors<dim>(tractions);
  if (const py::object observations = result.attr("d_observations"); !observations.is_none()) {
    const auto values = py::cast<Array>(observations);
    derivative.tread_loads = Matrix::unfilled(state.observations().rows(), state.observations().columns());
    std::transform(values.data(), values.data() + values.size(), derivative.tread_loads.data(),
                   [](double slope) { return -slope; });
  }
  if (const py::object rim = result.attr("d_rim"); !rim.is_none()) {
    const auto values = py::cast<Array>(rim);
    for (py::ssize_t i = 0; i < values.shape(0); ++i)
      derivative.rim.push_back({values.at(i, 0), values.at(i, 1), values.at(i, 2), values.at(i, 3)});
  }
  return derivative;
}

/// wheelwright.Functional.
template <int dim>
class OfStates : public Functional<dim> {
 public:
  OfStates(Owned object, Description description)
      : object_(std::move(object)), description_(std::move(description)) {}

  std::string name() const override { return description_.name; }
  bool is_mirror_symmetric(MirrorPlane plane) const override {
    return description_.is_mirror_symmetric(plane);
  }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix&) const override {
    const py::gil_scoped_acquire gil;
    const py::object result = object_->get().attr("_evaluate")(held(solver, psi, state));
    FunctionalValue<dim> value{.derivative = derivative(result, state)};
    if (py::hasattr(result, "values"))
      value.by_position = numbers(py::cast<Array>(result.attr("values")));
    else
      value.over_positions = result.attr("value").cast<double>();
    return value;
  }

 private:
  Owned object_;
  Description description_;
};

/// Strides of [position][sector][point][component] in strains of one row per load case.
Shape strides_of_strains(py::ssize_t n_cases, py::ssize_t n_sectors, py::ssize_t n_components) {
  constexpr py::ssize_t size = sizeof(double);
  return {n_sectors * size, size, n_components * n_cases * size, n_cases * size};
}

/// wheelwright.MaterialDensity, for the states of one solver.
template <int dim>
class OwnDensity : public MaterialDensity<dim> {
 public:
  OwnDensity(Owned object, std::shared_ptr<const StateSolver<dim>> solver)
      : object_(std::move(object)), solver_(std::move(solver)) {}

  Matrix densities(const StrainsInCell<dim>& cell) const override {
    const py::gil_scoped_acquire gil;
    const auto values = py::cast<py::array_t<double>>(call("_values", cell));
    Matrix result = Matrix::unfilled(cell.n_cases(), cell.n_points());
    const auto at = values.template unchecked<3>();
    for (int point = 0; point < cell.n_points(); ++point) {
      double* to = result.column(point);
      for (py::ssize_t position = 0; position < at.shape(0); ++position)
        for (py::ssize_t sector = 0; sector < at.shape(1); ++sector) *to++ = at(position, sector, point);
    }
    return result;
  }

  Matrix slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const override {
    const py::gil_scoped_acquire gil;
    const auto slopes = py::cast<py::array_t<double>>(call("_slopes", cell));
    Matrix result = Matrix::unfilled(cell.n_cases(), n_strains<dim> * cell.n_points());
    const auto at = slopes.template unchecked<4>();
    for (int point = 0; point < cell.n_points(); ++point)
      for (int k = 0; k < n_strains<dim>; ++k) {
        double* to = result.column(n_strains<dim> * point + k);
        const double* factor = factors.data();
        for (py::ssize_t position = 0; position < at.shape(0); ++position)
          for (py::ssize_t sector = 0; sector < at.shape(1); ++sector)
            *to++ = *factor++ * at(position, sector, point, k);
      }
    return result;
  }

 private:
  py::object call(const char* method, const StrainsInCell<dim>& cell) const {
    const py::ssize_t n_cases = cell.n_cases(), n_sectors = cell.n_sectors();
    auto* kept = new Matrix(cell.strains());
    const py::capsule owner(kept, [](void* p) { delete static_cast<Matrix*>(p); });
    const py::array strains =
        view(owner, kept->data(), {n_cases / n_sectors, n_sectors, cell.n_points(), n_strains<dim>},
             strides_of_strains(n_cases, n_sectors, n_strains<dim>));
    return object_->get().attr(method)(strains, HeldMaterial<dim>{solver_, &cell.law()});
  }

  Owned object_;
  std::shared_ptr<const StateSolver<dim>> solver_;
};

/// Its integral. The GIL is not held: several threads may ask for densities.
template <int dim>
class OfMaterial : public Functional<dim> {
 public:
  OfMaterial(Owned object, Description description)
      : object_(std::move(object)), description_(std::move(description)) {}

  std::string name() const override { return description_.name; }
  bool is_mirror_symmetric(MirrorPlane plane) const override {
    return description_.is_mirror_symmetric(plane);
  }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&, const State<dim>& state,
                                const Matrix&) const override {
    const auto density = std::make_shared<const OwnDensity<dim>>(object_, solver.shared_from_this());
    FunctionalValue<dim> value{.by_position = material_integral<dim>(solver, state, *density)};
    value.derivative.integrals.push_back({density, std::vector<double>(value.by_position.size(), 1.0)});
    return value;
  }

 private:
  Owned object_;
  Description description_;
};

/// wheelwright.EdgeDensity. Its gradient is that of the level set's boundary, kinks included.
template <int dim>
class OfEdges : public BoundaryIntegral<dim> {
 public:
  OfEdges(Owned object, Description description)
      : object_(std::move(object)), description_(std::move(description)) {}

  std::string name() const override { return description_.name; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override {
    FunctionalValue<dim> value = BoundaryIntegral<dim>::evaluate(solver, psi, state, mean);
    const int degree = solver.model().degree;
    const auto density = [&](int cell, const Vec<dim>& xi) {
      const Vec<dim> x = cartesian_place<dim>(psi.lattice.grid(), degree, cell, xi);
      return densities(std::span(&x, 1)).front().value;
    };
    const auto kinks = kink_densities<dim>(psi, state.domain(), degree, state.boundary(), density);
    for (std::size_t q = 0; q < kinks.size(); ++q) value.gradient_of_shape[q] += kinks[q];
    return value;
  }

 private:
  using typename BoundaryIntegral<dim>::Density;

  std::vector<Density> densities(std::span<const Vec<dim>> points) const override {
    const py::gil_scoped_acquire gil;
    const py::array x = rows<dim>({points.begin(), points.end()});
    const auto [values, gradients] =
        object_->get().attr("_densities")(x).template cast<std::pair<Array, Array>>();
    std::vector<Density> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      result[i].value = values.at(i);
      std::copy_n(gradients.data(i, 0), dim, result[i].gradient.begin());
    }
    return result;
  }

  Owned object_;
  Description description_;
};

template <template <int> class Kind>
FunctionalFactory factory(const Owned& object, const Description& description) {
  return [object, description]<int dim>(const QuantityContext<dim>&) {
    return std::make_shared<const Kind<dim>>(object, description);
  };
}

}  // namespace

QuantityRow own_quantity(py::object functional) {
  const Description description(functional);
  const auto kind = functional.attr("_kind").cast<std::string>();
  QuantityRow row{.name = description.name,
                  .unit = own_unit(functional.attr("unit").cast<std::string>()),
                  .meaning = functional.attr("meaning").cast<std::string>(),
                  .of = kind == "edges"                                   ? Positions::none
                        : functional.attr("_over_positions").cast<bool>() ? Positions::all
                                                                          : Positions::each,
                  .has_kinks = kind == "edges"};
  const auto object = std::make_shared<const OwnedObject>(std::move(functional));
  if (kind == "edges")
    row.functional = factory<OfEdges>(object, description);
  else if (kind == "material")
    row.functional = factory<OfMaterial>(object, description);
  else
    row.functional = factory<OfStates>(object, description);
  return row;
}

}  // namespace wheelwright::python
