#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace wheelwright {

/// A value with the estimate of its error.
struct EstimatedValue {
  double value, error;
};

/// Whether two values differ, but by no more than the sum of their errors.
bool differ_within_errors(const EstimatedValue& a, const EstimatedValue& b);

/// The values that their errors do not put in order: groups of different values, by index and in the order of
/// the values, of which any two differ by no more than their errors. No group is part of another one.
std::vector<std::vector<std::size_t>> groups_within_errors(std::span<const EstimatedValue> values);

/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

}  // namespace wheelwright
