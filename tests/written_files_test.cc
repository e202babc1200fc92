#include "wheelwright/files/written_files.h"

#include <sys/wait.h>

#include <algorithm>

#include "tests/run_support.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/output_error.h"
#include "wheelwright/run/checkpoints/folder_lock.h"
#include "wheelwright/run/checkpoints/run_files.h"
#include "wheelwright/run/commands/stop_file.h"

// What the program did not write itself is never replaced and never removed.

namespace wheelwright::testing {
namespace {

using Files = std::map<std::string, std::string>;

/// Everything below a folder: the content of files, and where links lead.
Files everything(const fs::path& folder) {
  Files result;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    result[name] = entry.is_symlink()        ? "-> " + fs::read_symlink(entry).string()
                   : entry.is_regular_file() ? content(entry.path())
                                             : "a folder";
  }
  return result;
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

class OwnFolder : public TemporaryFolder {
 protected:
  fs::path kept() const { return folder() / "kept"; }
};

TEST_F(OwnFolder, ReplacesOnlyItsOwnFiles) {
  make_folder(kept());
  write_atomically(kept() / "a", "first");
  write_atomically(kept() / "a", "second");
  EXPECT_EQ(content(kept() / "a"), "second");
  write(kept() / "b", "mine");
  write(kept() / "c.tmp", "mine");
  fs::create_directories(kept() / "d");
  fs::create_symlink("a", kept() / "e");
  fs::create_symlink("nowhere", kept() / "f");
  fs::create_symlink(folder() / "outside", kept() / "g.tmp");
  const Files before = everything(kept());
  for (const char* name : {"b", "c", "d", "e", "f", "g"})
    EXPECT_THROW(write_atomically(kept() / name, "x"), OutputError) << name;
  for (const char* name : {"a", "b", "d", "e", "f"})
    EXPECT_THROW(make_subfolder(kept() / name), OutputError) << name;
  EXPECT_EQ(everything(kept()), before);
  EXPECT_FALSE(fs::exists(folder() / "outside"));
}

TEST_F(OwnFolder, ReplacementOfAnOwnFileIsForeign) {
  make_folder(kept());
  for (const char* name : {"link", "folder", "temporary"}) write_atomically(kept() / name, "x");
  make_subfolder(kept() / "inner");
  for (const char* name : {"link", "folder", "inner"}) fs::remove_all(kept() / name);
  write(folder() / "precious", "mine");
  fs::create_directories(folder() / "elsewhere");
  fs::create_symlink(folder() / "precious", kept() / "link");
  fs::create_symlink(folder() / "precious", kept() / "temporary.tmp");
  fs::create_directories(kept() / "folder");
  fs::create_symlink(folder() / "elsewhere", kept() / "inner");
  for (const char* name : {"link", "folder", "temporary"})
    EXPECT_THROW(write_atomically(kept() / name, "y"), OutputError) << name;
  EXPECT_THROW(make_subfolder(kept() / "inner"), OutputError);
  EXPECT_EQ(content(folder() / "precious"), "mine");
  EXPECT_TRUE(fs::is_empty(folder() / "elsewhere"));
}

TEST_F(OwnFolder, ALeftoverTemporaryFileOfAnOwnFileIsReplaced) {
  make_folder(kept());
  write_atomically(kept() / "a", "first");
  write(kept() / "a.tmp", "half of the sec");
  write_atomically(kept() / "a", "second");
  EXPECT_EQ(content(kept() / "a"), "second");
  EXPECT_FALSE(fs::exists(kept() / "a.tmp"));
}

TEST_F(OwnFolder, TheListSurvivesBeingCutAnywhere) {
  make_folder(kept());
  for (const char* name : {"first", "second"}) write_atomically(kept() / name, "x");
  const std::string list = content(kept() / list_of_written_files);
  const std::size_t header = list.find('\n') + 1;
  for (std::size_t length = header; length < list.size(); ++length) {
    write(kept() / list_of_written_files, list.substr(0, length));
    fs::remove(kept() / "third");
    write_atomically(kept() / "third", "x");
    const WrittenFiles written(kept());
    EXPECT_TRUE(written.is_own("third")) << length;
    EXPECT_EQ(written.is_own("first"), length >= header + 5) << length;
    EXPECT_EQ(written.is_own("second"), length >= header + 12) << length;
  }
  for (const std::string& text :
       {list.substr(0, header / 2), std::string("my notes\nfirst\n"), std::string()}) {
    write(kept() / list_of_written_files, text);
    EXPECT_FALSE(WrittenFiles(kept()).exists());
    EXPECT_THROW(make_folder(kept()), OutputError);
    EXPECT_EQ(content(kept() / list_of_written_files), text);
  }
}

/// The exit code of the program that the build put beside this test.
int wheelwright(const fs::path& where, const std::string& arguments) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
  const int status = std::system(
      fmt::format("cd '{}' && '{}' {} > ../printed 2>&1", where.string(), program.string(), arguments)
          .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class UsersFolder : public TemporaryFolder {
 protected:
  UsersFolder() { fs::create_directories(place()); }

  /// Where a user works; what the program prints is beside it.
  fs::path place() const { return folder() / "place"; }
  std::string printed() const { return content(folder() / "printed"); }

  /// The command is refused, says why by all the names, and changes nothing.
  void expect_refused(const std::string& arguments, const std::vector<std::string>& names) {
    const Files before = everything(place());
    EXPECT_EQ(wheelwright(place(), arguments), exit_refused) << arguments << '\n' << printed();
    for (const std::string& name : names)
      EXPECT_NE(printed().find(name), std::string::npos) << name << '\n' << printed();
    EXPECT_EQ(everything(place()), before) << arguments;
  }
};

TEST_F(UsersFolder, ARunIntoTheFolderOfItsCaseIsRefused) {
  write(place() / "case.toml", small_case(1));
  expect_refused("run case.toml --output .", {"case.toml"});
  fs::rename(place() / "case.toml", place() / "my-wheel.toml");
  EXPECT_EQ(wheelwright(place(), "run my-wheel.toml --output ."), exit_done) << printed();
  EXPECT_EQ(content(place() / "my-wheel.toml"), small_case(1));
}

TEST_F(UsersFolder, AllFilesInTheWayAreNamedAtOnce) {
  write(place() / "c.toml", small_case(1));
  std::vector<std::string> names(std::begin(names_in_a_run_folder), std::end(names_in_a_run_folder));
  names.emplace_back(stop_file);
  names.emplace_back(list_of_written_files);
  for (const std::string& name : names) write(place() / "out" / name, "mine");
  write(place() / "out/notes.txt", "mine");
  expect_refused("run c.toml --output out", names);
  for (const std::string& name : names) {
    const fs::path only = place() / ("only-" + name);
    write(only / name, "mine");
    expect_refused("run c.toml --output " + only.filename().string(), {name});
  }
}

TEST_F(UsersFolder, FilesAddedToARunsFolderStay) {
  write(place() / "c.toml", small_case(3));
  ASSERT_EQ(wheelwright(place(), "run c.toml --iterations 1"), exit_done) << printed();
  const fs::path run = place() / "run";
  write(run / "notes.txt", "mine");
  write(run / "checkpoints/shape_000000.checkpoint.mine", "mine");
  write(run / "checkpoints/shape_my.svg", "mine");
  write(run / "checkpoints/shape_000099.checkpoint/a", "mine");
  fs::create_directories(run / stop_file);
  ASSERT_EQ(wheelwright(place(), "resume run --iterations 3"), exit_done) << printed();
  for (const char* file : {"notes.txt", "checkpoints/shape_000000.checkpoint.mine",
                           "checkpoints/shape_my.svg", "checkpoints/shape_000099.checkpoint/a"})
    EXPECT_EQ(content(run / file), "mine") << file;
  EXPECT_TRUE(fs::is_directory(run / stop_file));
}

TEST_F(UsersFolder, ARunWhoseFilesWereReplacedByLinksIsNotResumed) {
  write(place() / "c.toml", small_case(3));
  write(place() / "precious", "mine");
  ASSERT_EQ(wheelwright(place(), "run c.toml --iterations 1"), exit_done) << printed();
  for (const char* name : {"history.csv", "shape.svg", "run.lock"}) {
    fs::rename(place() / "run" / name, place() / "aside");
    fs::create_symlink(place() / "precious", place() / "run" / name);
    expect_refused("resume run --iterations 3", {name});
    fs::remove(place() / "run" / name);
    fs::rename(place() / "aside", place() / "run" / name);
  }
  fs::rename(place() / "run/checkpoints", place() / "aside");
  fs::create_directory_symlink(place() / "aside", place() / "run/checkpoints");
  expect_refused("resume run --iterations 3", {"checkpoints"});
  fs::remove(place() / "run/checkpoints");
  fs::rename(place() / "aside", place() / "run/checkpoints");
  EXPECT_EQ(wheelwright(place(), "resume run --iterations 3"), exit_done) << printed();
}

// What a checkpoint proves is the run's; the rest may be anybody's.
TEST_F(UsersFolder, RunWithRemovedListContinuesWithoutItsPictures) {
  write(place() / "c.toml", small_case(3));
  const fs::path run = place() / "run";
  ASSERT_EQ(wheelwright(place(), "run c.toml --iterations 1"), exit_done) << printed();
  fs::remove(run / list_of_written_files);
  EXPECT_EQ(wheelwright(place(), "resume run --iterations 3"), exit_refused);
  EXPECT_NE(printed().find("shape.svg"), std::string::npos) << printed();
  EXPECT_EQ(printed().find("history.csv"), std::string::npos) << printed();
  const std::vector<std::string> kept{"case.toml", "history.csv", "run.lock", "checkpoints",
                                      list_of_written_files};
  for (const std::string_view name : names_in_a_run_folder)
    if (std::ranges::count(kept, name) == 0) fs::remove_all(run / name);
  EXPECT_EQ(wheelwright(place(), "resume run --iterations 3"), exit_done) << printed();
  EXPECT_TRUE(fs::exists(run / "comparison.svg"));
}

TEST_F(UsersFolder, RunsAndAnalysesKeepEachOthersPictures) {
  write(place() / "c.toml", small_case(1));
  ASSERT_EQ(wheelwright(place(), "run c.toml"), exit_done) << printed();
  expect_refused("analyze c.toml --positions 2 --output run", {"stress.svg"});
  ASSERT_EQ(wheelwright(place(), "analyze c.toml --positions 2 --output analysis"), exit_done) << printed();
  expect_refused("run c.toml --output analysis", {"analysis.json"});
}

// The folder itself is what the user says.
TEST_F(UsersFolder, TheFolderOfARunMayBeALink) {
  write(place() / "c.toml", small_case(1));
  fs::create_directories(folder() / "large-disk");
  fs::create_directory_symlink(folder() / "large-disk", place() / "run");
  ASSERT_EQ(wheelwright(place(), "run c.toml"), exit_done) << printed();
  EXPECT_TRUE(fs::exists(folder() / "large-disk/comparison.svg"));
  EXPECT_EQ(wheelwright(place(), "resume run --iterations 2"), exit_done) << printed();
}

TEST_F(UsersFolder, RunDeclaresEveryFileItWrites) {
  write(place() / "c.toml", small_case(2, "pictures_every = 1\n"));
  ASSERT_EQ(wheelwright(place(), "run c.toml"), exit_done) << printed();
  for (const auto& entry : fs::directory_iterator(place() / "run")) {
    const std::string name = entry.path().filename().string();
    const bool is_named = std::ranges::count(names_in_a_run_folder, name) > 0;
    EXPECT_TRUE(is_named || name == list_of_written_files)
        << name << " is missing in run/checkpoints/run_files.h";
  }
}

TEST_F(UsersFolder, AnAnalysisReplacesNothing) {
  write(place() / "c.toml", small_case(1));
  const std::string analyze = "analyze c.toml --positions 2 --loads 1000 --output ";
  ASSERT_EQ(wheelwright(place(), analyze + "out"), exit_done) << printed();
  for (const auto& entry : fs::directory_iterator(place() / "out")) {
    const std::string name = entry.path().filename().string();
    const fs::path only = place() / ("only-" + name);
    write(only / name, "mine");
    expect_refused(analyze + only.filename().string(), {name});
  }
  expect_refused(analyze + "out", {"out"});
  const std::string compare = "compare c.toml c.toml --positions 2 --output ";
  ASSERT_EQ(wheelwright(place(), compare + "both"), exit_done) << printed();
  expect_refused(compare + "both", {"comparison.txt", "comparison.json", "comparison.svg"});
  write(place() / "mine/comparison.svg", "mine");
  expect_refused(compare + "mine", {"comparison.svg"});
}

TEST_F(UsersFolder, RemovedLockFileStillLocks) {
  write(place() / "c.toml", small_case(1));
  ASSERT_EQ(wheelwright(place(), "run c.toml"), exit_done) << printed();
  const auto lock = FolderLock::acquire(place() / "run");
  ASSERT_TRUE(lock);
  fs::remove(place() / "run/run.lock");
  EXPECT_FALSE(FolderLock::acquire(place() / "run"));
  expect_refused("resume run --iterations 2", {});
}

}  // namespace
}  // namespace wheelwright::testing
