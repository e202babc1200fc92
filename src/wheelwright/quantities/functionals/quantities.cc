#include "wheelwright/quantities/functionals/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "wheelwright/quantities/functionals/fatigue.h"
#include "wheelwright/quantities/functionals/largest_strain.h"
#include "wheelwright/quantities/functionals/mass.h"
#include "wheelwright/quantities/functionals/material_volume.h"
#include "wheelwright/quantities/functionals/over_positions.h"
#include "wheelwright/quantities/functionals/peak_pressure.h"
#include "wheelwright/quantities/functionals/peak_temperature.h"
#include "wheelwright/quantities/functionals/peak_von_mises.h"
#include "wheelwright/quantities/functionals/perimeter.h"
#include "wheelwright/quantities/functionals/quotient.h"
#include "wheelwright/quantities/functionals/rim_quantities.h"
#include "wheelwright/quantities/functionals/rolling_resistance.h"
#include "wheelwright/quantities/functionals/shape_function.h"
#include "wheelwright/quantities/functionals/strain_energy.h"
#include "wheelwright/quantities/functionals/uniformity_annulus.h"
#include "wheelwright/quantities/functionals/uniformity_dual.h"
#include "wheelwright/quantities/functionals/uniformity_l2.h"

namespace wheelwright {
namespace {

/// A functional whose constructor takes these arguments.
template <template <int> class Kind, class... Arguments>
FunctionalFactory made(Arguments... arguments) {
  return
      [=]<int dim>(const QuantityContext<dim>&) { return std::make_shared<const Kind<dim>>(arguments...); };
}

/// A uniformity with a characteristic length.
template <template <int> class Kind>
FunctionalFactory of_length() {
  return []<int dim>(const QuantityContext<dim>& context) {
    return std::make_shared<const Kind<dim>>(context.characteristic_length);
  };
}

FunctionalFactory peak_von_mises(double from_tread) {
  return [=]<int dim>(const QuantityContext<dim>& context) {
    return std::make_shared<const PeakVonMises<dim>>(from_tread, PeakNorm(), context.part);
  };
}

template <int dim>
std::shared_ptr<const Functional<dim>> mass(const QuantityContext<dim>& context) {
  return std::make_shared<const Mass<dim>>(context.solver.model().materials, context.part);
}

template <int dim>
Expected<std::shared_ptr<const Functional<dim>>> uniformity_dual(const QuantityContext<dim>& context) {
  auto map = context.solver.neumann_to_dirichlet(context.dual_norm);
  if (!map) return map.failure();
  return std::shared_ptr<const Functional<dim>>(std::make_shared<UniformityDual<dim>>(*std::move(map)));
}

template <int dim>
WeightedFunctional<dim> volume_fraction(const QuantityContext<dim>& context) {
  return {.weight = 1 / sector_measure<dim>(context.solver.model().grid),
          .functional = std::make_shared<MaterialVolume<dim>>(),
          .quantity = material_volume()};
}

template <int dim>
std::shared_ptr<const Functional<dim>> rim_motion(RimWay way) {
  if (way == RimWay::towards_ground) return std::make_shared<Travel<dim>>();
  return std::make_shared<RimTravel<dim>>(way);
}

/// Force of the ground by motion of the rim, as Quotient or RatioOfMeans.
template <template <int> class Ratio>
FunctionalFactory stiffness(std::string name, RimWay way) {
  return [=]<int dim>(const QuantityContext<dim>&) {
    return std::make_shared<const Ratio<dim>>(name, std::make_shared<GroundForce<dim>>(way),
                                              rim_motion<dim>(way));
  };
}

/// A function of the values at all positions of RimTravel or GroundForce towards the ground.
template <template <int> class Kind, class Function>
FunctionalFactory variation(std::string name, Function function) {
  return [=]<int dim>(const QuantityContext<dim>&) {
    return std::make_shared<const FunctionOfPositions<dim>>(
        name, std::make_shared<Kind<dim>>(RimWay::towards_ground), function);
  };
}

OfPositions first_harmonic(std::span<const double> values) { return harmonic_amplitude(values, 1); }

std::vector<QuantityRow> objective_rows() {
  return {{.name = "objective",
           .unit = UnitKind::energy,
           .meaning = "the weighted sum of [objective]",
           .of = Positions::all,
           .instead = "bound one of its terms, or another quantity"},
          {.name = "strain_energy",
           .unit = UnitKind::energy,
           .meaning = "strain energy J_e (3)",
           .label = "strain energy per position",
           .functional = made<StrainEnergy>()},
          {.name = "uniformity_annulus",
           .unit = UnitKind::energy,
           .meaning = "J_p1 (60), uniformity of the contact stress in an annulus; the sum over the positions",
           .of = Positions::all,
           .functional = of_length<UniformityAnnulus>(),
           .compares_with_mean = true,
           .observes_annulus = true},
          {.name = "uniformity_dual",
           .unit = UnitKind::energy,
           .meaning = "J_p2 (61), uniformity of the contact stress in H^-1/2; the sum over the positions",
           .of = Positions::all,
           .functional =
               []<int dim>(const QuantityContext<dim>& context) { return uniformity_dual<dim>(context); },
           .compares_with_mean = true},
          {.name = "uniformity_l2",
           .unit = UnitKind::energy,
           .meaning = "J_p (4), uniformity of the contact stress in L2; the sum over the positions",
           .of = Positions::all,
           .functional = of_length<UniformityL2>(),
           .compares_with_mean = true}};
}

/// The measures of every history.
std::vector<QuantityRow> measure_rows() {
  return {{.name = "mean_travel",
           .unit = UnitKind::length,
           .meaning = "travel of the rim towards the ground, the mean",
           .label = "mean travel",
           .functional = made<Travel>(),
           .varies_with = {Input::load}},
          {.name = "run_out",
           .unit = UnitKind::length,
           .meaning = "difference of the largest and the smallest travel at a held load",
           .label = "run-out",
           .of = Positions::all,
           .functional = variation<RimTravel>("run_out", peak_to_peak_of),
           .needs = {Input::load},
           .varies_with = {Input::several_positions},
           .is_maximum = true,
           .is_of_evenness = true},
          {.name = "peak_pressure",
           .unit = UnitKind::stress,
           .meaning = "largest contact pressure",
           .label = "peak contact pressure",
           .usual = Over::maximum,
           .functional = made<PeakPressure>(),
           .is_maximum = true,
           .is_of_evenness = true},
          {.name = "pressure_spread",
           .unit = UnitKind::ratio,
           .meaning = "variation of the contact pressure between the positions",
           .of = Positions::all,
           .instead = "use uniformity_dual, run_out or peak_pressure"},
          {.name = "volume_fraction",
           .unit = UnitKind::ratio,
           .meaning = "material as a fraction of the ring",
           .label = "volume of the ring",
           .of = Positions::none,
           .functional =
               []<int dim>(const QuantityContext<dim>& context) { return volume_fraction<dim>(context); },
           .is_amount_of_material = true,
           .ranked_as = "volume"}};
}

std::vector<QuantityRow> material_rows() {
  constexpr double everywhere = 0, inside = 0.025;  // distance from the tread [m]
  return {{.name = "peak_von_mises",
           .unit = UnitKind::stress,
           .meaning = "largest von Mises stress",
           .label = "peak von Mises stress",
           .usual = Over::maximum,
           .functional = peak_von_mises(everywhere),
           .integrates_stresses = true,
           .is_maximum = true,
           .ranked_as = "peak_stress",
           .has_parts = true},
          {.name = "largest_strain",
           .unit = UnitKind::ratio,
           .meaning = "largest principal strain",
           .label = "largest strain",
           .usual = Over::maximum,
           .functional =
               []<int dim>(const QuantityContext<dim>& context) {
                 return std::make_shared<const LargestStrain<dim>>(PeakNorm(), context.part);
               },
           .integrates_stresses = true,
           .is_maximum = true,
           .ranked_as = "strain",
           .has_parts = true},
          {.name = "peak_von_mises_inside",
           .unit = UnitKind::stress,
           .meaning = "largest von Mises stress farther than 25 mm from the tread",
           .usual = Over::maximum,
           .functional = peak_von_mises(inside),
           .integrates_stresses = true,
           .is_maximum = true},
          {.name = "mass",
           .unit = UnitKind::mass,
           .meaning = "mass of the ring",
           .of = Positions::none,
           .functional = []<int dim>(const QuantityContext<dim>& context) { return mass<dim>(context); },
           .needs = {Input::density},
           .is_amount_of_material = true,
           .has_parts = true},
          {.name = "perimeter",
           .unit = UnitKind::length,
           .meaning = "length of the edges of the holes in one sector",
           .of = Positions::none,
           .functional = made<Perimeter>()}};
}

/// Of the rim and of the ground's action on the wheel. A stiffness is a force of the ground by a motion of
/// the rim, the secant stiffness under the load, which is what the load test of a wheel shows.
std::vector<QuantityRow> rim_rows() {
  return {{.name = "travel",
           .unit = UnitKind::length,
           .meaning = "travel of the rim towards the ground",
           .functional = made<Travel>(),
           .varies_with = {Input::load}},
          {.name = "stiffness",
           .unit = UnitKind::stiffness,
           .meaning = "force by travel, towards the ground",
           .functional = stiffness<Quotient>("stiffness", RimWay::towards_ground),
           .mean = stiffness<RatioOfMeans>("stiffness", RimWay::towards_ground),
           .is_larger_better = true},
          {.name = "tangential_stiffness",
           .unit = UnitKind::stiffness,
           .meaning = "force by motion of the rim, along the ground",
           .functional = stiffness<Quotient>("tangential_stiffness", RimWay::along_ground),
           .mean = stiffness<RatioOfMeans>("tangential_stiffness", RimWay::along_ground),
           .needs = {Input::horizontal_force}},
          {.name = "torsional_stiffness",
           .unit = UnitKind::torsional_stiffness,
           .meaning = "torque by rotation of the rim",
           .functional = stiffness<Quotient>("torsional_stiffness", RimWay::rotation),
           .mean = stiffness<RatioOfMeans>("torsional_stiffness", RimWay::rotation),
           .needs = {Input::torque}},
          {.name = "radial_force",
           .unit = UnitKind::force,
           .meaning = "force of the wheel on the ground",
           .functional = made<GroundForce>(RimWay::towards_ground),
           .varies_with = {Input::travel}}};
}

/// What the losses of the material cost.
std::vector<QuantityRow> loss_rows() {
  constexpr auto resistance = []<int dim>(const QuantityContext<dim>& context) {
    return std::make_shared<const RollingResistance<dim>>(context.solver.model(), context.part);
  };
  constexpr auto coefficient = []<int dim>(const QuantityContext<dim>& context) {
    return std::make_shared<const RatioOfMeans<dim>>(
        "rolling_resistance_coefficient",
        std::make_shared<const RollingResistance<dim>>(context.solver.model()),
        std::make_shared<const GroundForce<dim>>(RimWay::towards_ground));
  };
  return {{.name = "rolling_resistance",
           .unit = UnitKind::force,
           .meaning = "force that keeps the wheel rolling against the losses of its material",
           .label = "rolling resistance",
           .of = Positions::all,
           .functional = resistance,
           .needs = {Input::loss_factor},
           .has_parts = true},
          {.name = "rolling_resistance_coefficient",
           .unit = UnitKind::ratio,
           .meaning = "rolling resistance by the mean force of the wheel on the ground",
           .label = "coefficient of rolling resistance",
           .of = Positions::all,
           .functional = coefficient,
           .needs = {Input::loss_factor}}};
}

/// What the material bears over many turns.
std::vector<QuantityRow> fatigue_rows() {
  constexpr auto utilization = []<int dim>(const QuantityContext<dim>& context) {
    return std::make_shared<const FatigueUtilization<dim>>(context.solver.model().materials, context.part);
  };
  return {{.name = "fatigue_utilization",
           .unit = UnitKind::ratio,
           .meaning = "largest fatigue measure of a turn by the fatigue limit of the material",
           .label = "fatigue utilization",
           .of = Positions::all,
           .functional = utilization,
           .needs = {Input::fatigue_limit},
           .integrates_stresses = true,
           .is_maximum = true,
           .has_parts = true}};
}

/// How warm the rolling wheel gets.
std::vector<QuantityRow> heat_rows() {
  constexpr auto peak = []<int dim>(const QuantityContext<dim>& context) {
    return std::make_shared<const PeakTemperature<dim>>(context.part);
  };
  return {{.name = "peak_temperature",
           .unit = UnitKind::temperature,
           .meaning = "highest steady temperature of the rolling wheel",
           .label = "peak temperature",
           .of = Positions::all,
           .functional = peak,
           .needs = {Input::speed, Input::all_loss_factors, Input::conductivity, Input::cooling},
           .has_kinks = true,
           .depends_on_heat = true,
           .is_maximum = true,
           .has_parts = true}};
}

/// How the wheel varies while it rolls: the travel at a held load, the force at a held travel.
std::vector<QuantityRow> variation_rows() {
  return {{.name = "run_out_harmonic",
           .unit = UnitKind::length,
           .meaning = "amplitude of the first harmonic of the travel at a held load",
           .of = Positions::all,
           .functional = variation<RimTravel>("run_out_harmonic", first_harmonic),
           .needs = {Input::load},
           .varies_with = {Input::several_positions}},
          {.name = "force_variation",
           .unit = UnitKind::force,
           .meaning = "difference of the largest and the smallest force at a held travel",
           .label = "radial force variation",
           .of = Positions::all,
           .functional = variation<GroundForce>("force_variation", peak_to_peak_of),
           .needs = {Input::travel},
           .varies_with = {Input::several_positions},
           .is_maximum = true,
           .is_of_evenness = true},
          {.name = "force_variation_harmonic",
           .unit = UnitKind::force,
           .meaning = "amplitude of the first harmonic of the force at a held travel",
           .of = Positions::all,
           .functional = variation<GroundForce>("force_variation_harmonic", first_harmonic),
           .needs = {Input::travel},
           .varies_with = {Input::several_positions}}};
}

/// Measured on the curves fitted to the edges.
std::vector<QuantityRow> outline_rows() {
  return {{.name = "minimum_wall",
           .unit = UnitKind::length,
           .meaning = "width of the thinnest wall",
           .label = "thinnest wall",
           .of = Positions::none,
           .instead = "set optimizer.minimum_wall, which every shape keeps"},
          {.name = "minimum_gap",
           .unit = UnitKind::length,
           .meaning = "width of the narrowest gap",
           .label = "narrowest gap",
           .of = Positions::none,
           .instead = "set optimizer.minimum_gap, which every shape keeps"},
          {.name = "roughness",
           .unit = UnitKind::turns,
           .meaning = "turns of the edges below the size of a cell",
           .label = "roughness of the edges",
           .of = Positions::none,
           .instead = "set optimizer.minimum_radius, which every shape keeps"}};
}

/// In the order of the reference.
const std::vector<Quantity>& built_in_quantities() {
  static const std::vector<Quantity> all = [] {
    std::vector<Quantity> quantities;
    for (const auto& rows : {objective_rows(), measure_rows(), material_rows(), rim_rows(), loss_rows(),
                             heat_rows(), fatigue_rows(), variation_rows(), outline_rows()})
      for (const QuantityRow& row : rows) quantities.emplace_back(row);
    return quantities;
  }();
  return all;
}

bool is_in_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

template <int dim>
std::shared_ptr<const Functional<dim>> aggregated(const std::string& name,
                                                  std::shared_ptr<const Functional<dim>> functional,
                                                  Over over) {
  if (over == Over::positions) return functional;
  const auto function = over == Over::mean ? mean_of : over == Over::maximum ? maximum_of : minimum_of;
  return std::make_shared<FunctionOfPositions<dim>>(name, std::move(functional), function);
}

}  // namespace

Quantities::Quantities() : rows_(built_in_quantities()) {}

void Quantities::add(QuantityRow row) {
  if (row.name.empty() || !std::ranges::all_of(row.name, is_in_word))
    throw std::invalid_argument(
        fmt::format("the name of a quantity is a word of letters, digits and _, not '{}'", row.name));
  if (find(row.name))
    throw std::invalid_argument(fmt::format("there is a quantity with the name {} already", row.name));
  rows_.emplace_back(std::move(row));
}

std::span<const Quantity> Quantities::own() const {
  return std::span(rows_).subspan(built_in_quantities().size());
}

const Quantity* Quantities::find(std::string_view name) const {
  const auto found = std::ranges::find_if(rows_, [&](const Quantity& q) { return q->name == name; });
  return found == rows_.end() ? nullptr : &*found;
}

std::vector<std::string_view> Quantities::names() const {
  std::vector<std::string_view> names;
  for (const Quantity& quantity : rows_) names.push_back(quantity->name);
  return names;
}

Quantity::Quantity() : Quantity(built_in("objective")) {}

Quantity in_part(const Quantity& of_ring, PartOfRing part) {
  QuantityRow row = *of_ring;
  row.part = std::move(part);
  return Quantity(std::move(row));
}

std::string number_key(const Quantity& quantity, int dimension) {
  const std::string_view unit = unit_in_key(kind(quantity), dimension);
  return of_part(unit.empty() ? quantity->name : fmt::format("{}_{}", quantity->name, unit), quantity->part);
}

const Quantity& built_in(std::string_view name) {
  const auto& all = built_in_quantities();
  const auto found = std::ranges::find_if(all, [&](const Quantity& q) { return q->name == name; });
  if (found == all.end()) throw std::logic_error(fmt::format("no quantity is built in as {}", name));
  return *found;
}

const Quantity& material_volume() {
  static const Quantity volume(QuantityRow{.name = "volume",
                                           .unit = UnitKind::volume,
                                           .meaning = "volume of the material of one sector",
                                           .of = Positions::none,
                                           .functional = made<MaterialVolume>(),
                                           .is_amount_of_material = true});
  return volume;
}

template <int dim>
Expected<WeightedFunctional<dim>> functional_of(const Quantity& quantity, Over over,
                                                const QuantityContext<dim>& context) {
  const bool is_each = quantity->of == Positions::each;
  const FunctionalMaker<dim>* mean = quantity->mean.template in<dim>();
  const bool has_own_mean = is_each && over == Over::mean && mean;
  const FunctionalMaker<dim>* maker = has_own_mean ? mean : quantity->functional.template in<dim>();
  if (!maker)
    return Failure{FailureReason::unsupported_model,
                   fmt::format("{} is not computed in {}D", quantity->name, dim)};
  QuantityContext<dim> of_its_part = context;
  of_its_part.part = quantity->part;
  auto term = maker->make(of_its_part);
  if (!term) return term.failure();
  if (term->quantity == Quantity()) term->quantity = quantity;
  if (is_each && !has_own_mean)
    term->functional = aggregated<dim>(name(quantity), std::move(term->functional), over);
  return term;
}

template decltype(functional_of<2>) functional_of<2>;
template decltype(functional_of<3>) functional_of<3>;

}  // namespace wheelwright
