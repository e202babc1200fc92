#include "wheelwright/run/observers/run_report.h"

#include <array>
#include <set>

#include "tests/run_support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/run/observers/report_file.h"
#include "wheelwright/run/results/stop_text.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright::testing {
namespace {

constexpr int last_shape = 5003;

double objective(int shape) { return 40 + 1e-3 * shape; }

ShapeOutline outline(int shape) { return {shape, objective(shape), {{{shape, 0}, {0, 1}, {1, 0}}}}; }

/// The folder of a run with thousands of shapes; every third one was rejected once before it was accepted.
class LongRun : public TemporaryFolder {
 protected:
  LongRun() : source_(*parse_case(small_case(1), "case.toml").value) {
    std::ofstream history(folder() / "history.csv"), outlines(folder() / outline_file);
    history << "iteration,trial,accepted,reason,objective [J/m],elapsed [s],events\n";
    for (int shape = 0; shape <= last_shape; ++shape) {
      if (shape % 3 == 1) history << fmt::format("{},0,0,objective_rose,50,{},\n", shape, shape);
      history << fmt::format("{},1,1,,{:.17g},{},{}\n", shape, objective(shape), shape + 0.5,
                             shape % 5 == 2 ? "a hole vanished" : "");
      outlines << outline_line(outline(shape));
    }
  }

  Case source_;
};

TEST(StopText, DiffersForEveryReasonAndSaysConvergedOnlyOfAToleranceThatWasMet) {
  std::set<std::string> texts;
  constexpr std::array all{StopReason::converged, StopReason::iterations,   StopReason::no_descent,
                           StopReason::gave_up,   StopReason::failed_start, StopReason::stop_requested};
  for (const StopReason reason : all) {
    texts.insert(text(reason));
    EXPECT_EQ(text(reason).find("converged") != std::string::npos, reason == StopReason::converged);
    EXPECT_EQ(text_of_stop(to_string(reason)), text(reason));
  }
  EXPECT_EQ(texts.size(), all.size());
}

TEST_F(LongRun, IsShownByEvenlyThinnedShapesEachWithItsOwnNumbers) {
  const auto run = report_of_folder<2>(folder(), source_);
  EXPECT_EQ(run.trials, last_shape + 1 + (last_shape + 1) / 3);
  EXPECT_EQ(run.rejected.at("objective_rose"), (last_shape + 1) / 3);
  ASSERT_EQ(run.events.size() + run.events_omitted, 1001u);
  EXPECT_EQ(run.events.size(), 400u);
  EXPECT_EQ(run.events.front().shape, std::to_string(5002 - 399 * 5));
  EXPECT_EQ(run.events.back().shape, "5002");
  EXPECT_EQ(run.seconds, last_shape + 0.5);

  const auto& iterations = run.history.front().values;
  ASSERT_EQ(run.history[3].name, "objective [J/m]");
  ASSERT_EQ(iterations.size(), run.history[3].values.size());
  EXPECT_LE(iterations.size(), 2000u);
  EXPECT_GE(iterations.size(), 1000u);
  EXPECT_EQ(iterations.front(), 0);
  EXPECT_EQ(iterations.back(), last_shape);
  const double step = iterations[1] - iterations[0];
  for (std::size_t k = 0; k < iterations.size(); ++k) {
    if (k + 1 < iterations.size()) {
      EXPECT_EQ(iterations[k], step * static_cast<double>(k));
    }
    EXPECT_EQ(run.history[3].values[k], objective(static_cast<int>(iterations[k])));
  }

  EXPECT_LE(run.outlines.size(), max_outlines + 1);
  EXPECT_GE(run.outlines.size(), max_outlines / 2);
  EXPECT_EQ(run.outlines.front().shape, 0);
  EXPECT_EQ(run.outlines.back().shape, last_shape);
  for (const ShapeOutline& shown : run.outlines) {
    EXPECT_EQ(shown.objective, objective(shown.shape));
    EXPECT_EQ(shown.contours, outline(shown.shape).contours);
  }
}

// Thinned for a page, not in the folder.
TEST_F(LongRun, KeepsOutlinesUpToTheResumedShape) {
  const auto study = make_study<2>(source_);
  ASSERT_TRUE(study);
  const auto optimizer = optimizer_of(*study);
  const Observers<2> observers;
  const Nucleation<2> nucleation;
  ReportFile<2> file;
  file(RunStarted{.resumed_after = 4990}, RunView<2>{.folder = folder(),
                                                     .study = *study,
                                                     .evolver = optimizer.evolver(),
                                                     .initial = nullptr,
                                                     .nucleation = nucleation,
                                                     .elapsed_seconds = 0,
                                                     .can_undo = false,
                                                     .observers = observers});
  std::string expected;
  for (int shape = 0; shape <= 4990; ++shape) expected += outline_line(outline(shape));
  EXPECT_TRUE(content(folder() / outline_file) == expected);
}

}  // namespace
}  // namespace wheelwright::testing
