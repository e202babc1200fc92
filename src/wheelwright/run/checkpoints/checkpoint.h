#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/files/block_file.h"
#include "wheelwright/optimization/nucleation/nucleation.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/run/checkpoints/history.h"

namespace wheelwright {

/// The shape from which a run started, for comparison in its pictures and summary.
template <int dim>
struct InitialShape {
  LevelSet<dim> shape;
  double objective;
  double measure;  ///< of the material, one sector
};

/// A quantity for which the case has an expectation, and its value at an earlier shape.
struct FoundQuantity {
  int iteration;
  std::string quantity;
  double value;
};

/// Everything that a run depends on besides its state. A run may be resumed if the case is the same; with
/// another program or on another machine its last digits may differ.
struct Provenance {
  std::string resolved_case;  ///< text of the keys that change what is computed
  std::string program;        ///< version, compiler and libraries
};

/// A run after an accepted shape: everything needed to continue as if it had never stopped.
template <int dim>
struct Checkpoint {
  Provenance provenance;
  OptimizationState<dim> state;
  InitialShape<dim> initial;
  Nucleation<dim> nucleation;
  std::vector<FoundQuantity> found;    ///< for the case's expectations
  HistoryMark history;                 ///< the end of history.csv at this shape
  double elapsed_seconds;              ///< of computation so far
  std::optional<StopReason> finished;  ///< set if the run ended by itself and its results are written
  double tolerance = 0;                ///< OptimizerOptions::tolerance, with which it may have converged
};

template <int dim>
std::string checkpoint_file(const Checkpoint<dim>& checkpoint);

/// From bytes that may contain anything. A pure function; it allocates no more than a small multiple of
/// bytes.size().
template <int dim>
Expected<Checkpoint<dim>, FormatError> parse_checkpoint_file(std::string_view bytes);

/// The state alone, or an evaluation alone, for programs that keep them or send them to others.
template <int dim>
std::string state_file(const OptimizationState<dim>& state);
template <int dim>
Expected<OptimizationState<dim>, FormatError> parse_state_file(std::string_view bytes);
template <int dim>
std::string evaluation_file(const Evaluation<dim>& evaluation);
template <int dim>
Expected<Evaluation<dim>, FormatError> parse_evaluation_file(std::string_view bytes);

}  // namespace wheelwright
