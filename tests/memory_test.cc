#include "wheelwright/app/memory.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "wheelwright/run/study/problem_size.h"

namespace wheelwright {
namespace {

/// A folder with proc and sys as Linux writes them.
class FakeSystem : public testing::Test {
 protected:
  FakeSystem() {
    std::string name = (std::filesystem::temp_directory_path() / "wheelwright-XXXXXX").string();
    root_ = mkdtemp(name.data());
  }
  ~FakeSystem() override { std::filesystem::remove_all(root_); }

  void write(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  double available() const { return available_memory(root_).value_or(-1); }

  std::filesystem::path root_;
};

const std::string meminfo = "MemTotal:       8000 kB\nMemFree:        1000 kB\nMemAvailable:   4000 kB\n";

TEST_F(FakeSystem, NothingIsKnownWithoutProc) { EXPECT_FALSE(available_memory(root_)); }

TEST_F(FakeSystem, WithoutGroupsWhatLinuxCallsAvailable) {
  write("proc/meminfo", meminfo);
  EXPECT_EQ(available(), 4000 * 1024);
}

TEST_F(FakeSystem, TheGroupsOfVersionTwoLeaveTheirLimitLessWhatCannotBeReclaimed) {
  write("proc/meminfo", meminfo);
  write("proc/self/cgroup", "0::/slice/service\n");
  write("sys/fs/cgroup/slice/service/memory.max", "max\n");
  EXPECT_EQ(available(), 4000 * 1024);
  write("sys/fs/cgroup/slice/service/memory.max", "3000000\n");
  EXPECT_EQ(available(), 3000000);
  write("sys/fs/cgroup/slice/service/memory.current", "1000000\n");
  write("sys/fs/cgroup/slice/service/memory.stat", "active_file 7\ninactive_file 250000\n");
  EXPECT_EQ(available(), 2250000);
  write("sys/fs/cgroup/slice/memory.max", "2000000\n");
  EXPECT_EQ(available(), 2000000);
  write("sys/fs/cgroup/slice/memory.current", "2500000\n");
  EXPECT_EQ(available(), 0);
}

TEST_F(FakeSystem, AContainerThatSeesItsOwnGroupAsTheTopOne) {
  write("proc/self/cgroup", "0::/docker/0123\n");
  write("sys/fs/cgroup/memory.max", "123456\n");
  EXPECT_EQ(available(), 123456);
}

TEST_F(FakeSystem, TheGroupsOfVersionOne) {
  write("proc/meminfo", meminfo);
  write("proc/self/cgroup", "5:cpu,cpuacct:/x\n4:blkio,memory:/a/b\n0::/\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(available(), 4000 * 1024);
  write("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "2000000\n");
  write("sys/fs/cgroup/memory/a/memory.usage_in_bytes", "1500000\n");
  write("sys/fs/cgroup/memory/a/memory.stat", "inactive_file 1\ntotal_inactive_file 100000\n");
  EXPECT_EQ(available(), 600000);
}

TEST_F(FakeSystem, UnexpectedFilesAreIgnored) {
  write("proc/meminfo", "MemAvailable: some\n");
  write("proc/self/cgroup", "nonsense\n:::::\n0::/../..\n\n");
  write("sys/fs/cgroup/memory.max", "\n");
  EXPECT_FALSE(available_memory(root_));
}

TEST_F(FakeSystem, TheAddressSpaceIsTheSoftLimitLessWhatIsMapped) {
  EXPECT_FALSE(address_space_left(root_));
  const std::string head = "Limit                     Soft Limit           Hard Limit           Units     \n";
  write("proc/self/status", "Name:\tx\nVmPeak:\t 9000 kB\nVmSize:\t 1000 kB\n");
  write("proc/self/limits",
        head + "Max address space         unlimited            unlimited            bytes\n");
  EXPECT_FALSE(address_space_left(root_));
  write("proc/self/limits",
        head + "Max address space         2048000              4096000              bytes\n");
  EXPECT_EQ(address_space_left(root_), 1024000);
  write("proc/self/limits",
        head + "Max address space         1000                 4096000              bytes\n");
  EXPECT_EQ(address_space_left(root_), 0);
}

// A hole that is its own mirror image across the width lets half of it be solved.
TEST(Memory, AnUnevenTaperedHoleTakesThatOfTheWholeWidth) {
  Case c;
  c.wheel.dimension = 3;
  c.grid.axial_cells = 4;
  const auto with_profile = [&](const std::vector<std::array<double, 2>>& profile) {
    c.holes.tapered = {{.count = 16, .center_radius = 0.27, .profile = profile, .phase = {}}};
    return estimated_memory(problem_size(c));
  };
  const double even = with_profile({{-0.06, 0.02}, {-0.01, 0.03}, {0.01, 0.03}, {0.06, 0.02}}),
               shifted = with_profile({{-0.06, 0.02}, {-0.01, 0.03}, {0.02, 0.03}, {0.06, 0.02}}),
               cone = with_profile({{-0.06, 0.02}, {-0.01, 0.03}, {0.01, 0.03}, {0.06, 0.04}});
  EXPECT_LT(even, 0.9 * cone);
  EXPECT_EQ(shifted, cone);
}

TEST(Memory, EachThreadTakesAddressSpace) {
  const Case c;
  EXPECT_FALSE(lack_of_address_space(c, 64, {}));
  const double left = estimated_memory(problem_size(c)) + 500e6;
  EXPECT_FALSE(lack_of_address_space(c, 1, left));
  EXPECT_TRUE(lack_of_address_space(c, 64, left));
}

TEST(Memory, SomeIsAvailableHere) { EXPECT_GT(available_memory().value_or(0), 0); }

TEST(Memory, ACaseLacksMemoryFromItsEstimateOn) {
  const Case c;
  EXPECT_FALSE(lack_of_memory(c, {}));
  EXPECT_FALSE(lack_of_memory(c, estimated_memory(problem_size(c))));
  EXPECT_TRUE(lack_of_memory(c, estimated_memory(problem_size(c)) - 1));
}

}  // namespace
}  // namespace wheelwright
