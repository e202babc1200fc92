#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "errors.h"
#include "wheelwright/linalg/dense.h"

namespace wheelwright::python {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;

inline py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Numbers that belong to `owner`, which the array keeps alive. Strides in bytes; none: contiguous.
template <class T>
py::array view(const py::handle& owner, const T* data, const Shape& shape, const Shape& strides = {}) {
  return read_only(py::array(py::dtype::of<T>(), shape, strides, data, owner));
}

/// Numbers that the array takes over.
template <class Numbers>
py::array owned(Numbers numbers, const Shape& shape) {
  auto* kept = new Numbers(std::move(numbers));
  const py::capsule owner(kept, [](void* p) { delete static_cast<Numbers*>(p); });
  return py::array(py::dtype::of<typename Numbers::value_type>(), shape, {}, kept->data(), owner);
}

inline py::array owned(std::vector<double> numbers) {
  const auto n = static_cast<py::ssize_t>(numbers.size());
  return owned(std::move(numbers), Shape{n});
}

/// One member of every struct of a list: [struct], or [struct][component] for arrays.
template <class Struct, class Member>
py::array members(const py::handle& owner, const std::vector<Struct>& list, Member Struct::*member) {
  const auto n = static_cast<py::ssize_t>(list.size());
  constexpr py::ssize_t stride = sizeof(Struct);
  if constexpr (requires(Member m) { m.size(); }) {
    using Number = typename Member::value_type;
    constexpr auto size = static_cast<py::ssize_t>(std::tuple_size_v<Member>);
    const Number* data = list.empty() ? nullptr : (list.front().*member).data();
    return view(owner, data, {n, size}, {stride, sizeof(Number)});
  } else {
    const Member* data = list.empty() ? nullptr : &(list.front().*member);
    return view(owner, data, {n}, {stride});
  }
}

template <std::size_t size>
py::array rows(const std::vector<std::array<double, size>>& points) {
  return owned(std::vector<double>(points.empty() ? nullptr : points.front().data(),
                                   points.empty() ? nullptr : points.front().data() + size * points.size()),
               {static_cast<py::ssize_t>(points.size()), static_cast<py::ssize_t>(size)});
}

inline std::vector<double> numbers(const Array& array) { return {array.data(), array.data() + array.size()}; }

}  // namespace wheelwright::python
