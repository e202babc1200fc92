#include "wheelwright/functionals/quantity_functional.h"

#include "wheelwright/functionals/mass.h"
#include "wheelwright/functionals/over_positions.h"
#include "wheelwright/functionals/peak_pressure.h"
#include "wheelwright/functionals/peak_von_mises.h"
#include "wheelwright/functionals/perimeter.h"
#include "wheelwright/functionals/quotient.h"
#include "wheelwright/functionals/rim_quantities.h"
#include "wheelwright/functionals/strain_energy.h"

namespace wheelwright {
namespace {

template <int dim>
using Pointer = std::shared_ptr<const Functional<dim>>;

template <int dim>
Pointer<dim> over_positions(std::string name, Pointer<dim> functional, Over over) {
  if (over == Over::positions) return functional;
  const auto function = over == Over::mean ? mean_of : over == Over::maximum ? maximum_of : minimum_of;
  return std::make_shared<FunctionOfPositions<dim>>(std::move(name), std::move(functional), function);
}

template <int dim>
Pointer<dim> stiffness(std::string name, RimWay way, Over over) {
  const auto force = std::make_shared<GroundForce<dim>>(way);
  Pointer<dim> travel = std::make_shared<RimTravel<dim>>(way);
  if (way == RimWay::towards_ground) travel = std::make_shared<Travel<dim>>();
  if (over == Over::mean) return std::make_shared<RatioOfMeans<dim>>(std::move(name), force, travel);
  return over_positions<dim>(name, std::make_shared<Quotient<dim>>(name, force, travel), over);
}

template <int dim>
Pointer<dim> harmonic(std::string name, Pointer<dim> functional, int k) {
  return std::make_shared<FunctionOfPositions<dim>>(
      std::move(name), std::move(functional),
      [k](std::span<const double> values) { return harmonic_amplitude(values, k); });
}

}  // namespace

template <int dim>
std::shared_ptr<const Functional<dim>> quantity_functional(Quantity quantity, Over over,
                                                           const QuantityParameters& parameters) {
  const std::string name(wheelwright::name(quantity));
  const auto travel = std::make_shared<Travel<dim>>();
  const auto axle = std::make_shared<RimTravel<dim>>(RimWay::towards_ground);
  const auto force = std::make_shared<GroundForce<dim>>(RimWay::towards_ground);
  switch (quantity) {
    case Quantity::mass:
      return std::make_shared<Mass<dim>>(parameters.density);
    case Quantity::perimeter:
      return std::make_shared<Perimeter<dim>>();
    case Quantity::strain_energy:
      return over_positions<dim>(name, std::make_shared<StrainEnergy<dim>>(), over);
    case Quantity::mean_travel:
    case Quantity::travel:
      return over_positions<dim>(name, travel, over);
    case Quantity::radial_force:
      return over_positions<dim>(name, force, over);
    case Quantity::stiffness:
      return stiffness<dim>(name, RimWay::towards_ground, over);
    case Quantity::tangential_stiffness:
      return stiffness<dim>(name, RimWay::along_ground, over);
    case Quantity::torsional_stiffness:
      return stiffness<dim>(name, RimWay::rotation, over);
    case Quantity::peak_pressure:
      return over_positions<dim>(name, std::make_shared<PeakPressure<dim>>(), over);
    case Quantity::peak_von_mises:
      return over_positions<dim>(name, std::make_shared<PeakVonMises<dim>>(0), over);
    case Quantity::peak_von_mises_inside:
      return over_positions<dim>(name, std::make_shared<PeakVonMises<dim>>(parameters.from_tread), over);
    case Quantity::run_out:
      return std::make_shared<FunctionOfPositions<dim>>(name, axle, peak_to_peak_of);
    case Quantity::run_out_harmonic:
      return harmonic<dim>(name, axle, parameters.harmonic);
    case Quantity::force_variation:
      return std::make_shared<FunctionOfPositions<dim>>(name, force, peak_to_peak_of);
    case Quantity::force_variation_harmonic:
      return harmonic<dim>(name, force, parameters.harmonic);
    case Quantity::objective:
    case Quantity::uniformity_annulus:
    case Quantity::uniformity_dual:
    case Quantity::uniformity_l2:
    case Quantity::pressure_spread:
    case Quantity::volume_fraction:
    case Quantity::minimum_wall:
    case Quantity::minimum_gap:
      return nullptr;
  }
  return nullptr;
}

Over usual_positions(Quantity quantity) {
  switch (quantity) {
    case Quantity::peak_pressure:
    case Quantity::peak_von_mises:
    case Quantity::peak_von_mises_inside:
      return Over::maximum;
    default:
      return Over::mean;
  }
}

template std::shared_ptr<const Functional<2>> quantity_functional(Quantity, Over, const QuantityParameters&);
template std::shared_ptr<const Functional<3>> quantity_functional(Quantity, Over, const QuantityParameters&);

}  // namespace wheelwright
