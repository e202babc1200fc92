#include "wheelwright/app/slow_stage.h"

#include <gtest/gtest.h>

namespace wheelwright {
namespace {

std::string printed(double seconds_until, double seconds_of_stage) {
  ::testing::internal::CaptureStderr();
  {
    const SlowStage stage("solving", seconds_until);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds_of_stage));
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(SlowStage, IsPrintedOnceIfItLasts) { EXPECT_EQ(printed(0, 0.5), "solving ...\n"); }

TEST(SlowStage, IsSilentAndEndsAtOnceIfItIsShort) { EXPECT_EQ(printed(1e6, 0), ""); }

}  // namespace
}  // namespace wheelwright
