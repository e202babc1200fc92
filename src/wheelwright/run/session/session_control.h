#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/run/commands/command_queue.h"
#include "wheelwright/run/session/journal.h"
#include "wheelwright/run/session/session.h"

namespace wheelwright {

/// Executes commands on a session, and waits where they or the end of a search say so.
template <int dim>
class SessionControl : private RunControl {
 public:
  /// The arguments must outlive this.
  SessionControl(const std::filesystem::path& folder, Session<dim>& session, Journal<dim>& journal,
                 CommandQueue& commands)
      : folder_(folder), session_(session), journal_(journal), commands_(commands) {}

  bool is_stopped() const { return is_stopped_; }

  /// Executes the waiting commands, and waits while the run is paused. Returns whether the search must return
  /// to its loop, to end or to continue from another stage.
  bool obey();

  /// At the end of a search: waits until a command gives the run something to do, or stops it. After a
  /// command to pause it keeps waiting through further changes.
  void wait_for_more(StopReason reason);

  /// Begins another search from the current shape, without the objectives of the earlier ones.
  std::optional<Refusal> search_again();

  void save() override { journal_.notify(SaveRequested<dim>{session_.state()}); }

 private:
  const Case& current_case() const override { return session_.study().source; }
  int iteration() const override { return session_.state().iteration; }
  void stop() override { is_stopped_ = true; }
  std::optional<Refusal> pause(int after_shapes) override;
  std::optional<Refusal> continue_run() override;
  std::optional<Refusal> change_case(const Case& changed, const std::string& what) override;
  std::vector<Point> hole_at(const Point& point) const override;
  std::optional<Refusal> draw(std::span<const Stroke> strokes, const std::string& what) override;
  std::optional<Refusal> take_shape(const std::filesystem::path& file, const std::string& what) override;
  std::optional<Refusal> reset() override;
  Expected<std::string, Refusal> undo() override;

  void execute(const Command& command);
  bool is_paused() const;
  void wait_while_paused();
  std::optional<Refusal> change_shape(const LevelSet<dim>& shape, const std::string& what);
  std::optional<Refusal> continue_under(const Case& changed, const LevelSet<dim>& shape,
                                        const std::string& what);
  std::optional<Refusal> continue_at(const LevelSet<dim>& shape, const std::string& what);
  void continue_from(Stage<dim> stage, const Event<dim>& change);

  const std::filesystem::path& folder_;
  Session<dim>& session_;
  Journal<dim>& journal_;
  CommandQueue& commands_;

  bool is_stopped_ = false;
  std::optional<int> pause_at_;  ///< number of the shape after which the run waits
  int stages_ = 0;               ///< entered by commands, so far
  /// Why the search ended, while the run waits for something to do.
  std::optional<StopReason> search_end_;
};

}  // namespace wheelwright
