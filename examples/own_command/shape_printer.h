#pragma once

#include <wheelwright/run/observers/observer.h>

#include <cstdio>

/// Prints every accepted shape (number, force [N], objective) and every command with its result.
class ShapePrinter : public wheelwright::Observer<2> {
 public:
  void operator()(const wheelwright::Event<2>& event, const wheelwright::RunView<2>& run) override {
    if (const auto* done = std::get_if<wheelwright::CommandDone>(&event))
      std::printf("%s %s: %s\n", done->was_executed ? "executed" : "refused",
                  std::string(done->command.name()).c_str(), done->text.c_str());
    const auto* tried = std::get_if<wheelwright::TrialDone<2>>(&event);
    if (!tried || tried->trial.verdict != wheelwright::Verdict::accepted) return;
    std::printf("shape %d %.17g %.17g\n", tried->state.iteration, run.study.source.load.force,
                tried->state.evaluation.function("objective").value);
  }
};
