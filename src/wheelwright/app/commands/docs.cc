#include <fmt/format.h>

#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/open_browser.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/files/path_queries.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// The folder of the installed documents. It lies beside the program, so that an installation can be moved.
fs::path documents_folder() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  return (program.parent_path() / WHEELWRIGHT_DOCUMENTS_FROM_PROGRAM).lexically_normal();
}

class DocsCommand : public Subcommand {
 public:
  DocsCommand() : Subcommand("docs", "Open the documents in a browser") {}

  void declare(Options& options) override {
    options.flag("--print", only_print_, "Print their path instead");
  }

  int run() override {
    const fs::path folder = documents_folder();
    const fs::path site = folder / "html" / "index.html", text = folder / "README.md";
    if (is_there(site)) return show(site);
    if (!is_there(text)) {
      print_err(
          "wheelwright docs: no documents are installed in {}; in the sources of the program, "
          "scripts/build-docs makes the site, and docs/ has its texts\n",
          folder.string());
      return exit_refused;
    }
    if (!only_print_)
      print_err(
          "wheelwright docs: the site of the documents is not installed; their texts begin with this "
          "file:\n");
    print("{}\n", text.string());
    return exit_done;
  }

 private:
  int show(const fs::path& page) const {
    if (!only_print_ && open_browser(page)) return exit_done;
    if (!only_print_) print_err("wheelwright docs: there is no browser to open; open this page:\n");
    print("{}\n", page.string());
    return exit_done;
  }

  bool only_print_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_docs() { return std::make_unique<DocsCommand>(); }

}  // namespace wheelwright
