#include "wheelwright/run/checkpoints/checkpoint.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "wheelwright/files/level_set_file.h"

namespace wheelwright {
namespace {

constexpr std::string_view file_kind = "CKPT", state_kind = "STAT", evaluation_kind = "EVAL";
constexpr std::uint32_t format_version = 12;

constexpr int saved_own_unit = static_cast<int>(UnitKind::power) + 1;

constexpr int largest_int = std::numeric_limits<int>::max();

// Every value is decomposed by a structured binding: adding a member to one of these types without saving it
// does not compile.

/// The number of the values, then each as append_one(value) writes it.
template <class Value, class AppendOne>
void append_all(const std::vector<Value>& values, ByteWriter& writer, AppendOne append_one) {
  writer.integer(static_cast<std::int64_t>(values.size()));
  for (const Value& value : values) append_one(value);
}

/// Reads what append_all() wrote, each value by read_one(value) from at least `least_bytes_each` bytes.
template <class Value, class ReadOne>
std::vector<Value> read_all(ByteReader& reader, std::size_t least_bytes_each, ReadOne read_one) {
  std::vector<Value> values(reader.count(least_bytes_each));
  for (Value& value : values) read_one(value);
  return values;
}

constexpr std::size_t count_size = sizeof(std::int64_t), number_size = sizeof(double);

template <class NamedValue>
void append_named(const std::vector<NamedValue>& values, ByteWriter& writer) {
  append_all(values, writer, [&](const NamedValue& named) {
    const auto& [name, value] = named;
    writer.text(name);
    writer.number(value);
  });
}

template <class NamedValue>
std::vector<NamedValue> read_named(ByteReader& reader) {
  return read_all<NamedValue>(reader, count_size + number_size, [&](NamedValue& named) {
    auto& [name, value] = named;
    name = reader.text();
    value = reader.number();
  });
}

void append(const Matrix& matrix, ByteWriter& writer) {
  writer.integer(matrix.rows());
  writer.integer(matrix.columns());
  writer.numbers(matrix.entries());
}

Matrix read_matrix(ByteReader& reader) {
  const auto rows = reader.integer(0, largest_int, "the number of rows of a matrix");
  const auto columns = reader.integer(0, largest_int, "the number of columns of a matrix");
  auto entries = reader.finite_numbers("the entries of a matrix");
  if (entries.size() != std::uint64_t(rows) * std::uint64_t(columns))
    reader.fail("a matrix does not have the entries for its rows and columns");
  if (!reader.ok()) return {};
  Matrix matrix(static_cast<int>(rows), static_cast<int>(columns));
  matrix.entries().assign(entries.begin(), entries.end());
  return matrix;
}

template <int dim>
void append(const std::vector<SurfacePoint<dim>>& points, ByteWriter& writer) {
  append_all(points, writer, [&](const SurfacePoint<dim>& one) {
    const auto& [cell, xi, normal, weight] = one;
    writer.integer(cell);
    for (const double x : xi) writer.number(x);
    for (const double x : normal) writer.number(x);
    writer.number(weight);
  });
}

template <int dim>
std::vector<SurfacePoint<dim>> read_points(ByteReader& reader) {
  return read_all<SurfacePoint<dim>>(
      reader, count_size + (2 * dim + 1) * number_size, [&](SurfacePoint<dim>& one) {
        auto& [cell, xi, normal, weight] = one;
        cell = static_cast<int>(reader.integer(0, largest_int, "the cell of a point of the boundary"));
        for (double& x : xi) x = reader.finite_number("a point of the boundary");
        for (double& x : normal) x = reader.finite_number("a normal of the boundary");
        weight = reader.finite_number("a weight of the boundary");
      });
}

/// An own unit is saved by its text: its number is that of one process.
void append(UnitKind unit, ByteWriter& writer) {
  writer.integer(is_own(unit) ? saved_own_unit : static_cast<int>(unit));
  if (is_own(unit)) writer.text(own_unit_text(unit));
}

UnitKind read_unit(ByteReader& reader) {
  const auto unit = reader.integer(0, saved_own_unit, "the unit of a function");
  return unit == saved_own_unit ? own_unit(reader.text()) : static_cast<UnitKind>(unit);
}

void append(const std::vector<FunctionValue>& functions, ByteWriter& writer) {
  append_all(functions, writer, [&](const FunctionValue& one) {
    const auto& [name, value, by_position, gradient, bounds, edge_gradient, unit, by_radius] = one;
    writer.text(name);
    writer.number(value);
    writer.numbers(by_position);
    writer.numbers(gradient);
    writer.number(bounds.lower);
    writer.number(bounds.upper);
    writer.numbers(edge_gradient);
    append(unit, writer);
    writer.numbers(by_radius);
  });
}

std::vector<FunctionValue> read_functions(ByteReader& reader) {
  return read_all<FunctionValue>(reader, 5 * count_size + 3 * number_size, [&](FunctionValue& one) {
    auto& [name, value, by_position, gradient, bounds, edge_gradient, unit, by_radius] = one;
    name = reader.text();
    value = reader.finite_number("the value of a function");
    by_position = reader.finite_numbers("the values of a function by position");
    gradient = reader.finite_numbers("the gradient of a function");
    bounds.lower = reader.number();
    bounds.upper = reader.number();
    edge_gradient = reader.finite_numbers("the gradient of a function at the edges");
    unit = read_unit(reader);
    by_radius = reader.finite_numbers("the derivatives of a function with respect to radii");
  });
}

void append(const std::vector<TermValue>& terms, ByteWriter& writer) {
  append_all(terms, writer, [&](const TermValue& one) {
    const auto& [name, value, by_position] = one;
    writer.text(name);
    writer.number(value);
    writer.numbers(by_position);
  });
}

std::vector<TermValue> read_terms(ByteReader& reader) {
  return read_all<TermValue>(reader, 2 * count_size + number_size, [&](TermValue& one) {
    auto& [name, value, by_position] = one;
    name = reader.text();
    value = reader.finite_number("the value of a term");
    by_position = reader.finite_numbers("the values of a term by position");
  });
}

void append(const std::vector<int>& values, ByteWriter& writer) {
  append_all(values, writer, [&](int value) { writer.integer(value); });
}

std::vector<int> read_integers(ByteReader& reader, std::string_view name) {
  return read_all<int>(reader, count_size,
                       [&](int& value) { value = static_cast<int>(reader.integer(0, largest_int, name)); });
}

/// Displacements are saved where there is material, elsewhere they are NaN.
void append(const StartDisplacements& starts, ByteWriter& writer) {
  append_all(starts, writer, [&](const StartDisplacement& start) {
    const auto& [ground, displacement] = start;
    const auto& [column, offset, camber] = ground;
    const auto& [components, values, is_odd_row, odd_values] = displacement;
    assert(is_odd_row.empty() && odd_values.empty());
    writer.integer(column);
    writer.number(offset);
    writer.number(camber);
    writer.integer(components);
    writer.numbers(values);
  });
}

StartDisplacements read_starts(ByteReader& reader) {
  return read_all<StartDisplacement>(reader, 3 * count_size + 2 * number_size, [&](StartDisplacement& start) {
    auto& [ground, displacement] = start;
    auto& [column, offset, camber] = ground;
    column = static_cast<int>(reader.integer(0, largest_int, "the column of a displacement to start from"));
    offset = reader.finite_number("the place of a displacement to start from");
    camber = reader.finite_number("the camber of a displacement to start from");
    displacement.components =
        static_cast<int>(reader.integer(1, 3, "the components of a displacement to start from"));
    displacement.values = reader.numbers();
    if (std::ranges::any_of(displacement.values, [](double value) { return std::isinf(value); }))
      reader.fail("a displacement to start from is not finite");
  });
}

template <int dim>
void append(const Evaluation<dim>& evaluation, ByteWriter& writer) {
  const auto& [functions, terms, boundary, newton_iterations, mean_observations, phases, measures, edges,
               starts] = evaluation;
  append(functions, writer);
  append(terms, writer);
  append(boundary, writer);
  append(newton_iterations, writer);
  append(mean_observations, writer);
  append_named(phases, writer);
  append_named(measures, writer);
  append(edges, writer);
  append(starts, writer);
}

template <int dim>
Evaluation<dim> read_evaluation(ByteReader& reader) {
  Evaluation<dim> evaluation;
  auto& [functions, terms, boundary, newton_iterations, mean_observations, phases, measures, edges, starts] =
      evaluation;
  functions = read_functions(reader);
  terms = read_terms(reader);
  boundary = read_points<dim>(reader);
  newton_iterations = read_integers(reader, "a number of Newton iterations");
  mean_observations = read_matrix(reader);
  phases = read_named<PhaseTime>(reader);
  measures = read_named<MeasureValue>(reader);
  edges = read_points<dim>(reader);
  starts = read_starts(reader);
  return evaluation;
}

void append(const StepMemory& memory, ByteWriter& writer) {
  const auto& [pairs, penalties, multipliers] = memory;
  append_all(pairs, writer, [&](const CurvaturePair& pair) {
    const auto& [move, change] = pair;
    writer.numbers(move);
    writer.numbers(change);
  });
  writer.numbers(penalties);
  writer.numbers(multipliers);
}

StepMemory read_memory(ByteReader& reader) {
  StepMemory memory;
  auto& [pairs, penalties, multipliers] = memory;
  pairs = read_all<CurvaturePair>(reader, 2 * count_size, [&](CurvaturePair& pair) {
    auto& [move, change] = pair;
    move = reader.finite_numbers("a move of the boundary");
    change = reader.finite_numbers("a change of the gradient");
  });
  penalties = reader.finite_numbers("the penalties of the constraints");
  multipliers = reader.finite_numbers("the multipliers of the constraints");
  return memory;
}

void append(const std::vector<AcceptedShape>& history, ByteWriter& writer) {
  append_all(history, writer, [&](const AcceptedShape& shape) {
    const auto& [objective, violation, trials] = shape;
    writer.number(objective);
    writer.number(violation);
    writer.integer(trials);
  });
}

std::vector<AcceptedShape> read_history(ByteReader& reader) {
  return read_all<AcceptedShape>(reader, 2 * number_size + count_size, [&](AcceptedShape& shape) {
    auto& [objective, violation, trials] = shape;
    objective = reader.finite_number("an objective so far");
    violation = reader.finite_number("a violation so far");
    trials = static_cast<int>(reader.integer(0, largest_int, "a number of trials"));
  });
}

template <int dim>
void append(const OptimizationState<dim>& state, ByteWriter& writer) {
  const auto& [shape, evaluation, measure, target_measure, iteration, step, since_redistance, since_smoothing,
               memory, history, history_begin, final_widths] = state;
  append(shape, writer);
  append(evaluation, writer);
  writer.number(measure);
  writer.number(target_measure);
  writer.integer(iteration);
  writer.number(step);
  writer.integer(since_redistance);
  writer.integer(since_smoothing);
  append(memory, writer);
  append(history, writer);
  writer.integer(history_begin);
  writer.integer(static_cast<int>(final_widths));
}

template <int dim>
std::size_t number_of_radii(const Evaluation<dim>& evaluation) {
  return evaluation.functions.empty() ? 0 : evaluation.functions.front().by_radius.size();
}

/// The inconsistency between the parts of an evaluation; empty if they fit.
template <int dim>
std::string_view misfit(const Evaluation<dim>& evaluation) {
  for (const FunctionValue& function : evaluation.functions) {
    if (function.by_radius.size() != number_of_radii(evaluation))
      return "there is not one derivative of every function with respect to every radius";
    if (function.gradient.size() != evaluation.boundary.size() ||
        function.edge_gradient.size() != evaluation.edges.size())
      return "there is not one value of a gradient for every point of the boundary";
  }
  return {};
}

/// The same of a state.
template <int dim>
std::string_view misfit(const OptimizationState<dim>& state) {
  const int n_cells = state.shape.lattice.grid().n_cells();
  for (const auto* points : {&state.evaluation.boundary, &state.evaluation.edges})
    for (const auto& point : *points)
      if (point.cell >= n_cells) return "a point of the boundary lies outside the grid";
  if (const auto problem = misfit(state.evaluation); !problem.empty()) return problem;
  const size_t n_radii = number_of_radii(state.evaluation);
  const size_t n_nodes = state.shape.values.size();
  for (const CurvaturePair& pair : state.memory.pairs)
    if ((pair.move.size() != n_nodes + n_radii && pair.move.size() != dim * n_nodes + n_radii) ||
        pair.change.size() != pair.move.size())
      return "a move of the boundary does not have one number, or one vector, for every node, and for every "
             "radius";
  if (state.history_begin > state.iteration ||
      state.history.size() != std::size_t(state.iteration) - std::size_t(state.history_begin) + 1)
    return "there is not one objective for every shape";
  if (!(state.step > 0)) return "the step is not positive";
  return {};
}

template <int dim>
std::optional<OptimizationState<dim>> read_state(ByteReader& reader) {
  auto shape = read_level_set<dim>(reader);
  auto evaluation = read_evaluation<dim>(reader);
  const double measure = reader.finite_number("the measure of the material");
  const double target_measure = reader.finite_number("the target measure");
  const auto count = [&](std::string_view name) {
    return static_cast<int>(reader.integer(0, largest_int - 1, name));
  };
  const int iteration = count("the number of the shape");
  const double step = reader.finite_number("the step");
  const int since_redistance = count("the number of shapes since the last redistancing");
  const int since_smoothing = count("the number of shapes since the last smoothing");
  auto memory = read_memory(reader);
  auto history = read_history(reader);
  const int history_begin = count("the shape that the objectives begin with");
  const auto final_widths = static_cast<FinalWidths>(reader.integer(
      0, static_cast<int>(FinalWidths::kept_with_sharper_corners), "whether shapes have their final widths"));
  if (!reader.ok()) return {};
  OptimizationState<dim> state{.shape = *std::move(shape),
                               .evaluation = std::move(evaluation),
                               .measure = measure,
                               .target_measure = target_measure,
                               .iteration = iteration,
                               .step = step,
                               .since_redistance = since_redistance,
                               .since_smoothing = since_smoothing,
                               .memory = std::move(memory),
                               .history = std::move(history),
                               .history_begin = history_begin,
                               .final_widths = final_widths};
  const std::string_view problem = misfit(state);
  if (!problem.empty()) reader.fail(problem);
  return state;
}

template <int dim>
void append(const InitialShape<dim>& initial, ByteWriter& writer) {
  const auto& [shape, objective, measure] = initial;
  append(shape, writer);
  writer.number(objective);
  writer.number(measure);
}

template <int dim>
std::optional<InitialShape<dim>> read_initial(ByteReader& reader) {
  auto shape = read_level_set<dim>(reader);
  const double objective = reader.finite_number("the initial objective");
  const double measure = reader.finite_number("the initial measure");
  if (!reader.ok()) return {};
  return InitialShape<dim>{*std::move(shape), objective, measure};
}

template <int dim>
void append(const Nucleation<dim>& nucleation, ByteWriter& writer) {
  const auto& [before, is_over] = nucleation;
  writer.integer(is_over ? 1 : 0);
  writer.integer(before ? 1 : 0);
  if (!before) return;
  const auto& [shape, objective, violation, is_comparable] = *before;
  append(shape, writer);
  writer.number(objective);
  writer.number(violation);
  writer.integer(is_comparable ? 1 : 0);
}

template <int dim>
Nucleation<dim> read_nucleation(ByteReader& reader) {
  Nucleation<dim> nucleation;
  nucleation.is_over = reader.integer(0, 1, "whether holes are made no more") == 1;
  if (reader.integer(0, 1, "whether holes are to be judged") == 0) return nucleation;
  auto shape = read_level_set<dim>(reader);
  const double objective = reader.finite_number("the objective before the newest holes");
  const double violation = reader.finite_number("the violation before the newest holes");
  const bool is_comparable = reader.integer(0, 1, "whether the newest holes can be judged") == 1;
  if (reader.ok()) nucleation.before = {*std::move(shape), objective, violation, is_comparable};
  return nucleation;
}

void append(const std::vector<FoundQuantity>& found, ByteWriter& writer) {
  append_all(found, writer, [&](const FoundQuantity& one) {
    const auto& [iteration, quantity, value] = one;
    writer.integer(iteration);
    writer.text(quantity);
    writer.number(value);
  });
}

std::vector<FoundQuantity> read_found(ByteReader& reader) {
  return read_all<FoundQuantity>(reader, 2 * count_size + number_size, [&](FoundQuantity& one) {
    auto& [iteration, quantity, value] = one;
    iteration = static_cast<int>(reader.integer(0, largest_int, "the shape of a value that was found"));
    quantity = reader.text();
    value = reader.number();
  });
}

}  // namespace

template <int dim>
std::string checkpoint_file(const Checkpoint<dim>& checkpoint) {
  const auto& [provenance, state, initial, nucleation, found, history, elapsed_seconds, finished, tolerance] =
      checkpoint;
  ByteWriter origin, current, first, holes, run;
  origin.text(provenance.resolved_case);
  origin.text(provenance.program);
  append(state, current);
  append(initial, first);
  append(nucleation, holes);
  run.integer(static_cast<std::int64_t>(history.bytes));
  run.integer(history.checksum);
  run.number(elapsed_seconds);
  run.integer(finished ? static_cast<int>(*finished) : -1);
  run.number(tolerance);
  append(found, run);
  return block_file(file_kind, format_version,
                    {{"CASE", origin.bytes()},
                     {"STAT", current.bytes()},
                     {"INIT", first.bytes()},
                     {"HOLE", holes.bytes()},
                     {"RUN ", run.bytes()}});
}

template <int dim>
Expected<Checkpoint<dim>, FormatError> parse_checkpoint_file(std::string_view bytes) {
  const auto blocks =
      parse_block_file(bytes, file_kind, format_version, {"CASE", "STAT", "INIT", "HOLE", "RUN "});
  if (!blocks) return blocks.failure();
  ByteReader origin((*blocks)[0]), current((*blocks)[1]), first((*blocks)[2]), holes((*blocks)[3]),
      run((*blocks)[4]);
  Provenance provenance{origin.text(), origin.text()};
  auto state = read_state<dim>(current);
  auto initial = read_initial<dim>(first);
  auto nucleation = read_nucleation<dim>(holes);
  const HistoryMark history{
      static_cast<std::uint64_t>(
          run.integer(0, std::numeric_limits<std::int64_t>::max(), "the length of history.csv")),
      static_cast<std::uint32_t>(
          run.integer(0, std::numeric_limits<std::uint32_t>::max(), "the checksum of history.csv"))};
  const double elapsed_seconds = run.finite_number("the elapsed time");
  const auto finished =
      run.integer(-1, static_cast<int>(StopReason::stop_requested), "the reason why the run ended");
  const double tolerance = run.finite_number("the tolerance");
  auto found = read_found(run);
  for (ByteReader* reader : {&origin, &current, &first, &holes, &run}) {
    reader->finish();
    if (!reader->ok()) return FormatError{FormatFault::invalid_value, reader->problem()};
  }
  Checkpoint<dim> checkpoint{std::move(provenance),
                             *std::move(state),
                             *std::move(initial),
                             std::move(nucleation),
                             std::move(found),
                             history,
                             elapsed_seconds,
                             {},
                             tolerance};
  if (finished >= 0) checkpoint.finished = static_cast<StopReason>(finished);
  return checkpoint;
}

template <int dim>
std::string state_file(const OptimizationState<dim>& state) {
  ByteWriter writer;
  append(state, writer);
  return block_file(state_kind, format_version, {{"STAT", writer.bytes()}});
}

template <int dim>
Expected<OptimizationState<dim>, FormatError> parse_state_file(std::string_view bytes) {
  const auto blocks = parse_block_file(bytes, state_kind, format_version, {"STAT"});
  if (!blocks) return blocks.failure();
  ByteReader reader(blocks->front());
  auto state = read_state<dim>(reader);
  reader.finish();
  if (!reader.ok()) return FormatError{FormatFault::invalid_value, reader.problem()};
  return *std::move(state);
}

template <int dim>
std::string evaluation_file(const Evaluation<dim>& evaluation) {
  ByteWriter writer;
  append(evaluation, writer);
  return block_file(evaluation_kind, format_version, {{"EVAL", writer.bytes()}});
}

template <int dim>
Expected<Evaluation<dim>, FormatError> parse_evaluation_file(std::string_view bytes) {
  const auto blocks = parse_block_file(bytes, evaluation_kind, format_version, {"EVAL"});
  if (!blocks) return blocks.failure();
  ByteReader reader(blocks->front());
  auto evaluation = read_evaluation<dim>(reader);
  if (const auto problem = misfit(evaluation); !problem.empty()) reader.fail(problem);
  reader.finish();
  if (!reader.ok()) return FormatError{FormatFault::invalid_value, reader.problem()};
  return evaluation;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                        \
  template decltype(checkpoint_file<dim>) checkpoint_file<dim>;             \
  template decltype(parse_checkpoint_file<dim>) parse_checkpoint_file<dim>; \
  template decltype(state_file<dim>) state_file<dim>;                       \
  template decltype(parse_state_file<dim>) parse_state_file<dim>;           \
  template decltype(evaluation_file<dim>) evaluation_file<dim>;             \
  template decltype(parse_evaluation_file<dim>) parse_evaluation_file<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
