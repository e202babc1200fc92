#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/run_support.h"
#include "wheelwright/app/exit_code.h"

namespace wheelwright::testing {
namespace {

namespace fs = std::filesystem;

/// A copy of the program, with documents where an installed one has them.
class Docs : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    const fs::path built = fs::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
    fs::create_directories(folder() / "bin");
    fs::copy_file(built, folder() / "bin" / "wheelwright");
  }

  fs::path documents() const { return folder() / "share" / "doc" / "wheelwright"; }

  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  std::string content(const fs::path& file) const {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  struct Outcome {
    int code;
    std::string output;  ///< standard output
  };
  Outcome run(const std::string& environment, const std::string& arguments) const {
    const fs::path output = folder() / "output";
    const int status =
        std::system(fmt::format("env -u DISPLAY -u WAYLAND_DISPLAY {} '{}/bin/wheelwright' docs {} >'{}'",
                                environment, folder().string(), arguments, output.string())
                        .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(output)};
  }
};

TEST_F(Docs, ThatAreNotInstalledAreRefused) {
  for (const char* arguments : {"", "--print"}) {
    const Outcome outcome = run("", arguments);
    EXPECT_EQ(outcome.code, exit_refused);
    EXPECT_EQ(outcome.output, "");
  }
}

TEST_F(Docs, WithoutASiteBeginWithTheReadme) {
  write(documents() / "README.md", "# Wheelwright");
  for (const char* arguments : {"", "--print"}) {
    const Outcome outcome = run("", arguments);
    EXPECT_EQ(outcome.code, exit_done);
    EXPECT_EQ(outcome.output, (documents() / "README.md").string() + "\n");
  }
}

TEST_F(Docs, AreOpenedInABrowserIfThereIsOne) {
  const fs::path site = documents() / "html" / "index.html", opened = folder() / "opened";
  write(documents() / "README.md", "# Wheelwright");
  write(site, "<!DOCTYPE html>");
  const fs::path browser = folder() / "stand_in" / "xdg-open";
  write(browser, fmt::format("#!/bin/sh\nprintf %s \"$1\" >'{}'\n", opened.string()));
  fs::permissions(browser, fs::perms::owner_all);
  const std::string desktop = fmt::format("DISPLAY=:9 PATH='{}':\"$PATH\"", browser.parent_path().string());

  EXPECT_EQ(run("", "").output, site.string() + "\n");
  EXPECT_EQ(run(desktop, "--print").output, site.string() + "\n");
  EXPECT_FALSE(fs::exists(opened));
  const Outcome outcome = run(desktop, "");
  EXPECT_EQ(outcome.code, exit_done);
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(content(opened), site.string());
}

}  // namespace
}  // namespace wheelwright::testing
