#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/units.h"
#include "wheelwright/mechanics/elasticity/dual_norm.h"
#include "wheelwright/quantities/functionals/part_of_ring.h"

namespace wheelwright {

template <int dim>
class StateSolver;
template <int dim>
class Functional;
template <int dim>
struct WeightedFunctional;

/// The load positions of which a quantity is a value.
enum class Positions {
  none,  ///< it depends on the shape alone
  each,  ///< it has a value at every position
  all,   ///< it has one value of all positions together
};

/// How a quantity with a value at every load position of a sector is aggregated.
enum class Over {
  positions,  ///< not at all: the functional has one value per position
  mean,       ///< their mean; of a stiffness: the mean force by the mean motion
  maximum,    ///< the maximum
  minimum,    ///< the minimum
};

/// What a case may have or not.
enum class Input {
  density,            ///< of the material
  loss_factor,        ///< of the material
  fatigue_limit,      ///< of the material
  all_loss_factors,   ///< of every material, also outside of the quantity's part
  conductivity,       ///< of every material
  cooling,            ///< something that takes the heat
  speed,              ///< of the axle
  load,               ///< a force on the rim
  travel,             ///< a prescribed travel of the rim in place of the load
  horizontal_force,   ///< on the rim
  torque,             ///< on the rim
  several_positions,  ///< more than one load position in a sector
};

/// What the functional of a quantity may depend on besides the shape and its states.
template <int dim>
struct QuantityContext {
  const StateSolver<dim>& solver;
  double characteristic_length = 0;  ///< L of the uniformities [m]
  DualNorm dual_norm = DualNorm::elasticity;
  std::optional<PartOfRing> part = {};  ///< of which the quantity is; nothing: of the whole ring
};

template <int dim>
class FunctionalMaker {
 public:
  virtual ~FunctionalMaker() = default;
  virtual Expected<WeightedFunctional<dim>> make(const QuantityContext<dim>& context) const = 0;
};

/// Makes the functional of a quantity, in one dimension or in both.
class FunctionalFactory {
 public:
  /// None: the quantity is not a functional.
  FunctionalFactory() = default;

  /// From make(const QuantityContext<dim>&), for each dim that it accepts. It returns a functional as a
  /// shared pointer, or, with a weight, as a WeightedFunctional, or an Expected of one of them.
  template <class Make>
  explicit(false) FunctionalFactory(Make make) requires(std::invocable<Make, const QuantityContext<2>&> ||
                                                        std::invocable<Make, const QuantityContext<3>&>)
      : plane_(maker<2>(make)), solid_(maker<3>(make)) {}

  explicit operator bool() const { return plane_ || solid_; }

  /// Null if there is none in this dimension.
  template <int dim>
  const FunctionalMaker<dim>* in() const {
    if constexpr (dim == 2)
      return plane_.get();
    else
      return solid_.get();
  }

 private:
  template <int dim>
  using Pointer = std::shared_ptr<const FunctionalMaker<dim>>;

  template <int dim, class Make>
  class MakerOf : public FunctionalMaker<dim> {
   public:
    explicit MakerOf(Make make) : make_(std::move(make)) {}
    Expected<WeightedFunctional<dim>> make(const QuantityContext<dim>& context) const override {
      return weighted<dim>(make_(context));
    }

   private:
    Make make_;
  };

  template <int dim, class Make>
  static Pointer<dim> maker(const Make& make) {
    if constexpr (std::invocable<Make, const QuantityContext<dim>&>)
      return std::make_shared<const MakerOf<dim, Make>>(make);
    else
      return nullptr;
  }

  template <int dim, class Made>
  static Expected<WeightedFunctional<dim>> weighted(Made made) {
    if constexpr (std::convertible_to<Made, std::shared_ptr<const Functional<dim>>>) {
      return WeightedFunctional<dim>{1, std::move(made)};
    } else if constexpr (requires { made.failure(); }) {
      if (!made) return made.failure();
      return weighted<dim>(*std::move(made));
    } else {
      return made;
    }
  }

  Pointer<2> plane_;
  Pointer<3> solid_;
};

/// A scalar that describes a shape: what a case can minimize, bound and expect, and what histories, reports
/// and pages show.
struct QuantityRow {
  std::string name;  ///< the word for case files and history.csv
  UnitKind unit;
  std::string meaning;     ///< for the reference, e.g. "largest contact pressure"
  std::string label = {};  ///< in tables and plots; empty: the name
  Positions of = Positions::each;
  Over usual = Over::mean;  ///< how history.csv and [[expect]] aggregate it

  /// Its functional: with a value per position if the quantity is of each. Sums over the positions if it is
  /// of all and a functional with a value per position.
  FunctionalFactory functional = {};
  /// Its mean over the positions, if that is not the mean of the functional's values.
  FunctionalFactory mean = {};
  /// What to minimize or bound instead; empty if the optimizer has its derivative.
  std::string instead = {};

  std::vector<Input> needs = {};        ///< without which it has no meaning
  std::vector<Input> varies_with = {};  ///< without which it is the same for every shape
  bool compares_with_mean = false;      ///< with the mean contact stress: a uniformity
  bool observes_annulus = false;        ///< the tractions in the annulus at the tread
  bool integrates_stresses = false;     ///< over the material
  bool has_kinks = false;               ///< its gradient contains those of the moving boundary
  bool depends_on_heat = false;         ///< it is a temperature
  bool is_amount_of_material = false;   ///< so that a run that optimizes it does not hold the volume
  bool is_maximum = false;        ///< over points or positions: it has the gradient of a smooth approximation
  bool is_larger_better = false;  ///< where designs are ranked by it
  bool is_of_evenness = false;    ///< how evenly the wheel rolls
  std::string ranked_as = {};     ///< the word by which designs are ranked by it; empty: the name

  bool has_parts = false;               ///< a part of the ring has a value of its own
  std::optional<PartOfRing> part = {};  ///< of which it is; nothing: of the whole ring
};

/// One row of a table of quantities (quantities/functionals/quantities.h), or the same of a part of the ring.
/// Two of them are equal if they have the same name.
class Quantity {
 public:
  /// The objective as a weighted sum, an energy.
  Quantity();
  explicit Quantity(QuantityRow row) : row_(std::make_shared<const QuantityRow>(std::move(row))) {}

  const QuantityRow* operator->() const { return row_.get(); }
  const QuantityRow& operator*() const { return *row_; }
  friend bool operator==(const Quantity& a, const Quantity& b) {
    return a->name == b->name && a->part == b->part;
  }

 private:
  std::shared_ptr<const QuantityRow> row_;
};

/// E.g. "mass", or "mass of tyre".
inline std::string name(const Quantity& quantity) { return of_part(quantity->name, quantity->part); }
inline UnitKind kind(const Quantity& quantity) { return quantity->unit; }
inline std::string label(const Quantity& quantity) {
  return of_part(quantity->label.empty() ? quantity->name : quantity->label, quantity->part);
}
/// The same quantity of a part of the ring; it must have parts.
Quantity in_part(const Quantity& of_ring, PartOfRing part);
/// Of its value on the whole width in JSON and tables for programs, e.g. "run_out_m", "mass_kg of tyre".
std::string number_key(const Quantity& quantity, int dimension);

}  // namespace wheelwright
