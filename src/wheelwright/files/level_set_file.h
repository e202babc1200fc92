#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "wheelwright/files/block_file.h"
#include "wheelwright/files/byte_stream.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

// A level set as bytes, with its grid and degree, exact to the last bit. To save one in its own file:
//
//   write_atomically(path, level_set_file(psi));
//   const auto psi = parse_level_set_file<2>(bytes);   // Expected: the level set, or what is wrong with it
//
// To store it in a block of another file, append it to the block's ByteWriter.

template <int dim>
std::string level_set_file(const LevelSet<dim>& psi);

/// From bytes that may contain anything.
template <int dim>
Expected<LevelSet<dim>, FormatError> parse_level_set_file(std::string_view bytes);

template <int dim>
void append(const LevelSet<dim>& psi, ByteWriter& writer);

/// Empty if and only if the reader has a problem.
template <int dim>
std::optional<LevelSet<dim>> read_level_set(ByteReader& reader);

}  // namespace wheelwright
