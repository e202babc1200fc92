#pragma once

#include "wheelwright/run/commands/run_control.h"

namespace wheelwright::testing {

/// A run that takes every case.
class TakesAnyCase : public RunControl {
 public:
  explicit TakesAnyCase(Case c) : case_(std::move(c)) {}
  const Case& current_case() const override { return case_; }
  int iteration() const override { return 0; }
  void save() override {}
  void stop() override {}
  std::optional<Refusal> pause(int) override { return {}; }
  std::optional<Refusal> continue_run() override { return {}; }
  std::optional<Refusal> change_case(const Case& changed, const std::string&) override {
    case_ = changed;
    return {};
  }
  std::vector<Point> hole_at(const Point&) const override { return {}; }
  std::optional<Refusal> draw(std::span<const Stroke>, const std::string&) override { return {}; }
  std::optional<Refusal> take_shape(const std::filesystem::path&, const std::string&) override { return {}; }
  std::optional<Refusal> reset() override { return {}; }
  Expected<std::string, Refusal> undo() override { return Refusal{""}; }

 private:
  Case case_;
};

}  // namespace wheelwright::testing
