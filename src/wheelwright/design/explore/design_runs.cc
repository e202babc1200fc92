#include "wheelwright/design/explore/design_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <variant>

#include "wheelwright/case/dimension.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/design/explore/shared_work.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/file_content.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/files/written_files.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/run/checkpoints/own_drawings.h"
#include "wheelwright/run/session/run.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

fs::path result_file(const fs::path& designs, const Design& design, Progression progression) {
  return designs /
         fmt::format("{}.{}.json", design.name, progression == Progression::full ? "full" : "preview");
}

/// Stops a run once, on request.
class StopOnce {
 public:
  explicit StopOnce(const std::function<bool()>& requested) : requested_(requested) {}
  std::optional<Command> operator()() {
    if (was_passed_on_ || !requested_()) return {};
    was_passed_on_ = true;
    return Stop{};
  }

 private:
  const std::function<bool()>& requested_;
  bool was_passed_on_ = false;
};

/// Stops a run where its preview ends: on the case's grid after the coarser ones, or after a few shapes.
template <int dim>
class EndOfPreview : public Observer<dim> {
 public:
  explicit EndOfPreview(CommandQueue& commands) : commands_(commands) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override {
    if (const auto* started = std::get_if<RunStarted>(&event); started && started->resumed_after)
      resume_after(*started->resumed_after, run);
    if (std::holds_alternative<GridChanged>(event)) has_changed_grid_ = true;
    const auto* done = std::get_if<TrialDone<dim>>(&event);
    if (!done || done->trial.verdict != Verdict::accepted || run.study.level > 0 || is_over_) return;
    if (has_changed_grid_ || done->state.iteration >= shapes_of_preview) end();
  }

  bool is_over() const { return is_over_; }

 private:
  /// A process may have died after the last shape of the preview, and before its result was stored.
  void resume_after(int shape, const RunView<dim>& run) {
    if (run.study.level > 0 || shape == 0) return;
    has_changed_grid_ = run.study.source.optimizer.coarse_levels > 0;
    if (has_changed_grid_ || shape >= shapes_of_preview) end();
  }

  void end() {
    is_over_ = true;
    commands_.push(Stop{});
  }

  CommandQueue& commands_;
  bool has_changed_grid_ = false, is_over_ = false;
};

/// Saves and ends a run at an accepted shape, on request, without its results, which the run that continues
/// it writes.
template <int dim>
class Pause : public Observer<dim> {
 public:
  Pause(std::function<bool(int)> is_requested, CommandQueue& commands)
      : is_requested_(std::move(is_requested)), commands_(commands) {}

  void operator()(const Event<dim>& event, const RunView<dim>&) override {
    const auto* done = std::get_if<TrialDone<dim>>(&event);
    if (!done || done->trial.verdict != Verdict::accepted || is_over_) return;
    is_over_ = is_requested_(done->state.iteration);
    if (!is_over_) return;
    commands_.push(Stop{});
    commands_.push(Stop{});  // the second one while the results of the last shape are computed
  }

 private:
  std::function<bool(int)> is_requested_;
  CommandQueue& commands_;
  bool is_over_ = false;
};

/// The largest violation of a summary's bounds, as a fraction of the bound.
double largest_violation(const nlohmann::json& bounds) {
  double largest = 0;
  for (const auto& bound : bounds) {
    if (bound.at("is_kept")) continue;
    const double limit = bound.at("bound");
    largest = std::max(
        largest, std::abs(bound.at("value").get<double>() - limit) / (limit == 0 ? 1 : std::abs(limit)));
  }
  return largest;
}

/// Reads the numbers of the last shape that a run wrote to its folder.
template <int dim>
void read_summary(const fs::path& folder, const Case& c, DesignResult& result) {
  if (!is_there(folder / "summary.json")) return;
  const auto summary = nlohmann::json::parse(file_content(folder / "summary.json"));
  if (!summary.contains("after")) return;
  if (summary.contains("bounds")) result.violation = largest_violation(summary["bounds"]);
  const auto& after = summary.at("after");
  auto& numbers = result.numbers;
  result.shapes = after.at("shape");
  const auto read = [&](const std::string& key) {  // some numbers exist only for some wheels
    if (after.contains(key) && after[key].is_number()) numbers[key] = after[key].get<double>();
  };
  for (const WheelNumber<dim>& number : wheel_numbers<dim>()) read(number.key);
  for (const std::string& layer : names_of_layers(c))
    for (const WheelNumber<dim>& number : layer_numbers<dim>(layer)) read(number.key);
  for (const Quantity& own : c.vocabulary.quantities.own()) read(number_key(own, dim));
  if (after.contains("load_cases"))
    for (const auto& [load_case, of_case] : after["load_cases"].items())
      for (const auto& [key, value] : of_case.items())
        if (value.is_number()) numbers[key_in_case(key, load_case)] = value.template get<double>();
}

/// The outcome of a design's run: a result, or who is writing to its folder, or why that cannot be used; none
/// of these if it was stopped.
struct DesignRun {
  std::optional<DesignResult> result = {};
  std::optional<FolderInUse> holder = {};
  std::string fault = {};
};

/// The outcome if the folder cannot be used.
template <int dim>
DesignRun without_folder(const NotBegun<dim>& reason, const fs::path& folder) {
  if (const auto* in_use = std::get_if<FolderInUse>(&reason)) return {.holder = *in_use};
  return {.fault = fmt::format("{} cannot be used: its files belong to another design, or are corrupted",
                               folder.string())};
}

template <int dim>
Expected<Run<dim>, NotBegun<dim>> begun_or_resumed(const Design& design, const fs::path& folder) {
  if (is_there(folder / "case.toml")) return Run<dim>::resume(with_own_drawings(design.source), folder);
  return Run<dim>::begin(design.source, folder);
}

template <int dim>
DesignRun run_design(const Design& design, const fs::path& folder, Progression progression,
                     const RunSettings& settings) {
  DesignResult result{progression, ""};
  auto run = begun_or_resumed<dim>(design, folder);
  if (run) {
    CommandQueue commands;
    commands.add_source(StopOnce(settings.stop_requested));
    const EndOfPreview<dim>* end = nullptr;
    if (progression == Progression::preview) {
      auto observer = std::make_unique<EndOfPreview<dim>>(commands);
      end = observer.get();
      run->add(std::move(observer));
    }
    run->add(std::make_unique<Pause<dim>>(
        [&](int shape) { return settings.pauses(design, shape) && !(end && end->is_over()); }, commands));
    const RunResult<dim> ended = run->execute(commands);
    const bool is_end_of_preview = end && end->is_over();
    if (ended.reason == StopReason::stop_requested && !is_end_of_preview) return {};
    result.status = is_end_of_preview ? "preview" : to_string(ended.reason);
  } else if (const auto* finished = std::get_if<AlreadyFinished<dim>>(&run.failure())) {
    result.status = to_string(*finished->end.finished);
  } else if (const auto* failure = std::get_if<Failure>(&run.failure())) {
    result.status = to_string(failure->reason);
    return {.result = result};
  } else {
    return without_folder<dim>(run.failure(), folder);
  }
  read_summary<dim>(folder, design.source, result);
  return {.result = result};
}

/// Runs designs one by one, while others may run the same ones.
class SharedRuns {
 public:
  SharedRuns(const fs::path& folder, const std::vector<Design>& designs, Progression progression,
             const RunSettings& settings)
      : folder_(folder),
        designs_(designs),
        progression_(progression),
        settings_(settings),
        results_(designs.size()) {}

  /// Returns who keeps the design from being run.
  std::optional<FolderInUse> run(int i) {
    const Design& design = designs_[i];
    if (const auto known = known_result(folder_, design, progression_)) return add(i, *known), std::nullopt;
    if (settings_.stop_requested() || !settings_.may_begin()) return {};
    const fs::path place = folder_ / folder_of_designs;
    const DesignRun run = in_dimension_of(design.source, [&](auto dim) {
      return run_design<dim>(design, place / design.name, progression_, settings_);
    });
    if (!run.fault.empty()) leave_out(i, run.fault);
    if (!run.result) return run.holder;
    write_atomically(result_file(place, design, progression_), to_json(*run.result));
    add(i, *run.result);
    return {};
  }

  /// Whether to wait for the process that keeps a design from being run.
  bool waits(int i, const FolderInUse& holder) {
    if (settings_.stop_requested() || !settings_.may_begin()) return false;
    if (settings_.waits(designs_[i], holder)) return true;
    leave_out(i, fmt::format("{} is writing to {}", to_string(holder),
                             (folder_ / folder_of_designs / designs_[i].name).string()));
    return false;
  }

  std::vector<std::optional<DesignResult>> results() { return std::move(results_); }

 private:
  void add(int i, const DesignResult& result) {
    const std::scoped_lock lock(mutex_);
    settings_.done(designs_[i], result);
    results_[i] = result;
  }

  void leave_out(int i, const std::string& why) {
    const std::scoped_lock lock(mutex_);
    settings_.left_out(designs_[i], why);
  }

  const fs::path& folder_;
  const std::vector<Design>& designs_;
  Progression progression_;
  const RunSettings& settings_;
  std::vector<std::optional<DesignResult>> results_;
  std::mutex mutex_;
};

}  // namespace

std::optional<DesignResult> known_result(const fs::path& folder, const Design& design,
                                         Progression progression) {
  const fs::path file = result_file(folder / folder_of_designs, design, progression);
  if (!is_there(file)) return {};
  try {
    return design_result(file_content(file));
  } catch (const nlohmann::json::exception&) {
    return {};  // computed again
  }
}

fs::path lock_of_design(const fs::path& folder, const Design& design) {
  return folder / folder_of_designs / (design.name + ".lock");
}

void prepare_designs(const fs::path& folder, const std::vector<Design>& designs) {
  const fs::path place = folder / folder_of_designs;
  make_subfolder(place);
  WrittenFiles list(place);
  for (const Design& design : designs) {
    for (const char* ending : {"toml", "lock", "preview.json", "full.json", "finer.json"})
      list.claim_file(fmt::format("{}.{}", design.name, ending));
    make_subfolder(place / design.name);
  }
}

std::vector<std::optional<DesignResult>> run_designs(const fs::path& folder,
                                                     const std::vector<Design>& designs,
                                                     Progression progression, const RunSettings& settings) {
  prepare_designs(folder, designs);
  SharedRuns runs(folder, designs, progression, settings);
  share_work(settings.threads, static_cast<int>(designs.size()),
             {.lock = [&](int i) { return lock_of_design(folder, designs[i]); },
              .work = [&](int i) { return runs.run(i); },
              .waits = [&](int i, const FolderInUse& holder) { return runs.waits(i, holder); }});
  return runs.results();
}

}  // namespace wheelwright
