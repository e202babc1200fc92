#pragma once

#include <filesystem>
#include <span>

#include "wheelwright/evolution/evolver.h"
#include "wheelwright/run/command.h"

namespace wheelwright {

// What commands put in the place of a run's case and shape.

/// A failure as the reason why a command was not obeyed.
Refusal refusal(const Failure& failure);

/// The case as its file would be read; refused as the file would be. Paths in it are relative to the file's
/// folder.
Expected<Case, Refusal> accepted_case(const Case& c, const std::filesystem::path& file);

/// A shape with strokes drawn over it, each over those before it, as a shape that the evolver makes: a
/// distance function with the protected bands, without islands of at most this measure of one sector.
template <int dim>
Expected<LevelSet<dim>, Refusal> drawn_over(const LevelSet<dim>& shape, std::span<const Stroke> strokes,
                                            const Evolver<dim>& evolver, double largest_island);

/// The shape in a file (files/level_set_file.h), on a lattice of the same wheel and with the evolver's bands.
/// Refused where the file's wheel has other radii, another width or another number of sectors.
template <int dim>
Expected<LevelSet<dim>, Refusal> shape_of_file(const std::filesystem::path& file, const Lattice<dim>& lattice,
                                               const Evolver<dim>& evolver);

}  // namespace wheelwright
