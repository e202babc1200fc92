#include "wheelwright/output/report/within_errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wheelwright {
namespace {

bool are_within_errors(const EstimatedValue& a, const EstimatedValue& b) {
  return std::abs(a.value - b.value) <= a.error + b.error;
}

}  // namespace

bool differ_within_errors(const EstimatedValue& a, const EstimatedValue& b) {
  return a.value != b.value && are_within_errors(a, b);
}

std::vector<std::vector<std::size_t>> groups_within_errors(std::span<const EstimatedValue> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i].value; });
  std::vector<std::vector<std::size_t>> groups;
  std::size_t end_of_last = 0;
  for (std::size_t first = 0; first < order.size(); ++first) {
    const auto fits = [&](std::size_t next) {
      return std::all_of(order.begin() + first, order.begin() + next,
                         [&](std::size_t i) { return are_within_errors(values[i], values[order[next]]); });
    };
    std::size_t end = first + 1;
    while (end < order.size() && fits(end)) ++end;
    if (end > end_of_last && differ_within_errors(values[order[first]], values[order[end - 1]]))
      groups.emplace_back(order.begin() + first, order.begin() + end);
    end_of_last = std::max(end_of_last, end);
  }
  return groups;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

}  // namespace wheelwright
