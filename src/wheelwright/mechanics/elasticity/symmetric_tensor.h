#pragma once

#include <array>

namespace wheelwright {

/// A symmetric tensor: its components 11, 22, 33, 23, 13, 12.
using SymmetricTensor = std::array<double, 6>;

/// Its eigenvalues, the largest one first.
std::array<double, 3> principal_values(const SymmetricTensor& tensor);

/// Its unit eigenvectors in the same order.
std::array<std::array<double, 3>, 3> principal_axes(const SymmetricTensor& tensor);

/// The derivative of n . T n with respect to the components of T, of which one beside the diagonal stands for
/// two.
SymmetricTensor slope_along(const std::array<double, 3>& n);

}  // namespace wheelwright
