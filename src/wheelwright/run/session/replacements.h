#pragma once

#include <filesystem>
#include <span>

#include "wheelwright/run/commands/run_control.h"
#include "wheelwright/shape/evolution/evolver.h"

namespace wheelwright {

// Replacements of a run's case and shape by commands.

/// A failure as the reason why a command was refused.
Refusal refusal(const Failure& failure);

/// The case after writing and reading it as a file; refused like the file. Paths in it are relative to the
/// file's folder.
Expected<Case, Refusal> accepted_case(const Case& c, const std::filesystem::path& file);

/// A shape with strokes drawn over it, each over the earlier ones, finished like shapes of the evolver: a
/// distance function with the protected bands, without islands up to this measure per sector.
template <int dim>
Expected<LevelSet<dim>, Refusal> drawn_over(const LevelSet<dim>& shape, std::span<const Stroke> strokes,
                                            const Evolver<dim>& evolver, double largest_island);

/// The shape in a file (files/level_set_file.h), on a lattice of the same wheel and with the evolver's bands.
/// Refused if the file's wheel has other radii, another width or another number of sectors.
template <int dim>
Expected<LevelSet<dim>, Refusal> shape_of_file(const std::filesystem::path& file, const Lattice<dim>& lattice,
                                               const Evolver<dim>& evolver);

}  // namespace wheelwright
