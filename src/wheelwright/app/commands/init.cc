#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/text.h"
#include "wheelwright/case/presets.h"
#include "wheelwright/case/write.h"

namespace wheelwright {
namespace {

/// Whether all of the text was written; closes the file.
bool write_and_close(int file, const std::string& text) {
  std::FILE* stream = fdopen(file, "w");
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  return std::fclose(stream) == 0 && written;
}

class InitCommand : public Subcommand {
 public:
  InitCommand() : Subcommand("init", "Write a commented case file to start from") {}

  void declare(Options& options) override {
    options.optional_argument("FILE", file_, "File to write; an existing file is never overwritten");
    options.text(
        "--preset", "NAME", preset_,
        [](const std::string& name) { return find_preset(name) ? "" : unknown(name); },
        "Write this wheel instead of the template with all keys");
    options.flag("--list", list_, "List the presets, and write nothing");
  }

  int run() override {
    if (list_) {
      for (const Preset& preset : presets()) fmt::print("{:<17}{}\n", preset.name, preset.meaning);
      return exit_done;
    }
    const int file = open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) {
      const int reason = errno;
      print_err("{}: {}\n", file_, std::strerror(reason));
      return reason == EEXIST ? exit_refused : exit_input_output;
    }
    if (!write_and_close(file, preset_ ? std::string(find_preset(*preset_)->text) : case_template())) {
      unlink(file_.c_str());  // incomplete, and newly created
      print_err("{}: cannot be written\n", file_);
      return exit_input_output;
    }
    print("wrote {0}; next: wheelwright check {0}\n", file_);
    return exit_done;
  }

 private:
  /// The message for an unknown preset.
  static std::string unknown(const std::string& name) {
    std::vector<std::string_view> names;
    for (const Preset& preset : presets()) names.push_back(preset.name);
    return fmt::format("there is no preset {}; known: {}", without_control_characters(name),
                       fmt::join(names, ", "));
  }

  std::string file_ = "case.toml";
  std::optional<std::string> preset_;
  bool list_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_init() { return std::make_unique<InitCommand>(); }

}  // namespace wheelwright
