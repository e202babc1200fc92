#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "wheelwright/quantities/functionals/quantity.h"

namespace wheelwright {

/// The quantities that a case can name: the built-in ones, and those that a program adds.
class Quantities {
 public:
  /// The built-in ones.
  Quantities();

  /// Throws std::invalid_argument if the name is in use or is not a word of letters, digits and _.
  void add(QuantityRow row);

  /// Those that the program has added.
  std::span<const Quantity> own() const;
  /// Null if there is none of that name.
  const Quantity* find(std::string_view name) const;
  /// In the order of the table.
  std::vector<std::string_view> names() const;

  auto begin() const { return rows_.begin(); }
  auto end() const { return rows_.end(); }
  bool operator==(const Quantities&) const = default;

 private:
  std::vector<Quantity> rows_;
};

/// The built-in quantity of that name, which must exist.
const Quantity& built_in(std::string_view name);

/// The volume of the material of one sector, which every run computes; a case names its fraction of the ring.
const Quantity& material_volume();

/// The functional whose value is the quantity. `over` does not count unless the quantity is of each position.
/// Fails with unsupported_model if there is none in this dimension, and as the operators of the solver do.
template <int dim>
Expected<WeightedFunctional<dim>> functional_of(const Quantity& quantity, Over over,
                                                const QuantityContext<dim>& context);

}  // namespace wheelwright
