#include "wheelwright/web/watch/products.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "wheelwright/cad/outline/check_outline.h"
#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/case/write.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/output/export/fit_surface.h"
#include "wheelwright/output/export/formats.h"
#include "wheelwright/output/page/report_run.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/run/checkpoints/provenance.h"
#include "wheelwright/run/checkpoints/run_files.h"
#include "wheelwright/run/results/final_results.h"
#include "wheelwright/run/results/remarks.h"
#include "wheelwright/run/results/run_title.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

NoProduct no_product(const Failure& failure) { return {to_string(failure)}; }

NoProduct no_product(const std::vector<cad::OutlineFault>& faults) {
  return {fmt::format("the outline cannot be exported: {}", faults.front().what)};
}

template <int dim>
std::string title(const WatchedShape<dim>& shape) {
  return fmt::format("{}, shape {}", run_title(*shape.source), shape.number);
}

/// The file of a wheel in a format.
template <class Model>
Expected<std::string, NoProduct> file(std::string (*of_wheel)(const Model&),
                                      const std::type_identity_t<Model>& wheel) {
  try {
    return of_wheel(wheel);
  } catch (const std::runtime_error& error) {
    return NoProduct{error.what()};
  }
}

}  // namespace

Expected<std::string, NoProduct> exported(const WatchedShape<2>& shape, std::string_view name) {
  constexpr double tolerance = 1e-5;
  const ExportFormat* format = find_export_format(name);
  if (!format || !format->of_plane) return NoProduct{"there is no such format for a plane wheel"};
  auto outline = cad::fit_outline(shape.psi, tolerance);
  if (!outline) return no_product({outline.failure()});
  const auto report = cad::check_outline(*outline, shape.psi, tolerance);
  if (!report) return no_product(report.failure());
  return file(format->of_plane, {.title = title(shape),
                                 .program = program_text(),
                                 .shape = shape.psi,
                                 .outline = *std::move(outline),
                                 .width = shape.source->wheel.width,
                                 .tolerance = tolerance});
}

Expected<std::string, NoProduct> exported(const WatchedShape<3>& shape, std::string_view name) {
  constexpr double tolerance = 1e-4;
  const ExportFormat* format = find_export_format(name);
  if (!format || !format->of_surface) return NoProduct{"there is no such format for a wheel in 3D"};
  const int degree = shape.source->grid.degree;
  auto fitted = fit_surface(shape.psi, degree, tolerance);
  if (!fitted) return NoProduct{fitted.failure().what};
  return file(format->of_surface, {.title = title(shape),
                                   .program = program_text(),
                                   .shape = shape.psi,
                                   .surface = std::move(fitted->surface),
                                   .parts = fitted->parts,
                                   .map_degree = degree});
}

template <int dim>
Expected<std::string, NoProduct> design_report(const std::filesystem::path& folder,
                                               const LevelSet<dim>& initial, const WatchedShape<dim>& shape) {
  const StateSolver<dim>& solver = *shape.solver;
  const LoadCases<dim> cases = load_cases<dim>(*shape.source);
  const auto first = solver.states(initial, distinct_positions(solver, cases, initial), Interrupt());
  if (!first) return no_product(first.failure());
  double energy = 0;
  for (const double value : of_all((*first)->positions(), (*first)->strain_energy())) energy += value;
  const auto before = described(*shape.source, solver, cases, initial, material_measure(initial), first),
             after = described(*shape.source, solver, cases, shape.psi, shape.measure,
                               SolvedStates<dim>(shape.solutions.front()));
  const RunSummary<dim> summary{.title = run_title(*shape.source),
                                .before = {0, energy, before},
                                .after = {shape.number, shape.objective, after},
                                .remarks = remarks(*shape.source, before, after)};
  return report_page({page_run(report_of_results<dim>(folder, *shape.source, summary, solved(shape),
                                                      shown_wheel(solved(shape)), {}))});
}

bool is_design_name(std::string_view name) {
  constexpr std::size_t most = 40;
  return !name.empty() && name.size() <= most && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

template <int dim>
Expected<std::filesystem::path, NoProduct> save_design(const std::filesystem::path& folder,
                                                       const std::string& name,
                                                       const WatchedShape<dim>& shape) {
  if (!is_design_name(name)) return NoProduct{"a name has 1 to 40 letters, digits, - and _"};
  const std::filesystem::path designs = folder / designs_folder, file = designs / (name + ".toml"),
                              level_set = designs / (name + ".levelset");
  if (is_there(file) || is_there(level_set))
    return NoProduct{fmt::format("{} already exists: choose another name", file.string())};
  Case c = *shape.source;
  c.holes = {};
  c.shapes = {};
  c.saved_shape = {.from = name + ".levelset", .checksum = {}, .shape = {}};
  c.volume.target.reset();
  c.optimizer.iterations = Optimizer{}.iterations;
  c.output = Output{};
  c.output.folder = "runs/" + name;
  make_subfolder(designs);
  write_atomically(level_set, level_set_file(shape.psi));
  write_atomically(file, fmt::format("# {}\n\n{}", program_text(), to_toml(c)));
  return file;
}

template decltype(design_report<2>) design_report<2>;
template decltype(save_design<2>) save_design<2>;
template decltype(design_report<3>) design_report<3>;
template decltype(save_design<3>) save_design<3>;

}  // namespace wheelwright
