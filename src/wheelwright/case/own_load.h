#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/range.h"

namespace wheelwright {

template <int dim>
struct WheelLoads;
template <int dim>
struct RollingModel;

/// How the value of a key of [load] changes the loads on a wheel, in one dimension or in both.
class LoadEffect {
 public:
  /// From act(double value, const RollingModel<dim>& wheel, WheelLoads<dim>& loads), for each dim that it
  /// accepts; in the other dimension the key has no effect. The value is in SI units; the wheel has the
  /// built-in loads, and the loads also have the effects of earlier own keys.
  template <class Act>
  explicit(false) LoadEffect(Act act) {
    if constexpr (std::invocable<Act, double, const RollingModel<2>&, WheelLoads<2>&>) plane_ = act;
    if constexpr (std::invocable<Act, double, const RollingModel<3>&, WheelLoads<3>&>) solid_ = act;
  }

  template <int dim>
  void act(double value, const RollingModel<dim>& wheel, WheelLoads<dim>& loads) const {
    const Act<dim>* act = nullptr;
    if constexpr (dim == 2)
      act = &plane_;
    else
      act = &solid_;
    if (*act) (*act)(value, wheel, loads);
  }

 private:
  template <int dim>
  using Act = std::function<void(double, const RollingModel<dim>&, WheelLoads<dim>&)>;

  Act<2> plane_;
  Act<3> solid_;
};

/// A key of [load] that a program adds: a number, which load cases may change.
struct OwnLoadKey {
  std::string name;
  std::string unit = {};  ///< in case files; empty for pure numbers
  std::string meaning;    ///< for messages and pages
  Range range;
  double usual = 0;   ///< where the file does not give it, in the unit of case files
  double factor = 1;  ///< value in SI units and radians = factor * value in the file
  LoadEffect effect;
};

/// The value of an own key in a load [SI], or, optional, in a load case.
template <class Value>
struct OwnValue {
  std::shared_ptr<const OwnLoadKey> key;
  Value value;
  bool operator==(const OwnValue& other) const {
    return key->name == other.key->name && value == other.value;
  }
};

/// The keys of [load] that a program adds to the built-in ones.
class OwnLoadKeys {
 public:
  /// Throws std::invalid_argument if the name is in use, or is not a word of letters, digits and _.
  void add(OwnLoadKey key);

  /// Their usual values, in the order in which they were added.
  std::vector<OwnValue<double>> usual_values() const;

  /// Whether they have the same names.
  bool operator==(const OwnLoadKeys& other) const;

 private:
  std::vector<std::shared_ptr<const OwnLoadKey>> keys_;
};

/// Those of a load case that changes none of these values.
std::vector<OwnValue<std::optional<double>>> no_changes(const std::vector<OwnValue<double>>& values);

}  // namespace wheelwright
