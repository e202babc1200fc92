#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/base/text.h"
#include "wheelwright/cad/check_outline.h"
#include "wheelwright/cad/fit_outline.h"
#include "wheelwright/case/version.h"
#include "wheelwright/export/formats.h"
#include "wheelwright/export/plugin.h"
#include "wheelwright/files/atomic_file.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_formats = "dxf,svg,stl";
constexpr double default_tolerance = 0.01, least_tolerance = 0.001, greatest_tolerance = 1000;  // [mm]
constexpr double finest_share = 1e-6;  // of the outer radius, that the tolerance may be

using Formats = std::vector<const ExportFormat*>;

std::string names_of_formats() {
  std::string names;
  for (const ExportFormat& format : export_formats())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

/// The formats of a list like "dxf,svg", each once; nothing if one of them is unknown or the list is empty.
std::optional<Formats> parse_formats(std::string_view list) {
  Formats formats;
  while (true) {
    const std::size_t comma = list.find(',');
    const ExportFormat* format = find_export_format(list.substr(0, comma));
    if (format == nullptr) return {};
    if (std::ranges::find(formats, format) == formats.end()) formats.push_back(format);
    if (comma == std::string_view::npos) return formats;
    list.remove_prefix(comma + 1);
  }
}

std::string check_formats(const std::string& list) {
  return parse_formats(list) ? "" : fmt::format("must be some of {}, joined by commas", names_of_formats());
}

std::optional<double> parse_tolerance(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_number = end != text.c_str() && *end == '\0';
  if (!is_number || !(value >= least_tolerance && value <= greatest_tolerance)) return {};
  return value;
}

std::string check_tolerance(const std::string& text) {
  return parse_tolerance(text)
             ? ""
             : fmt::format("must be a length from {} to {} mm", least_tolerance, greatest_tolerance);
}

class ExportCommand : public Subcommand {
 public:
  ExportCommand()
      : Subcommand("export", "Write a shape for CAD, workshop and printing: DXF, STEP, STL and others") {}

  void declare(Options& options) override {
    add_wheel(options, input_);
    options.text("--format", "NAME,NAME,...", formats_, check_formats,
                 fmt::format("Any of {}; without it {}", names_of_formats(), default_formats));
    options.text("--tolerance", "MM", tolerance_, check_tolerance,
                 fmt::format("Largest distance of the curves from the shape's edges [mm]; without it {}",
                             default_tolerance));
    add_output(options, output_, "Folder for the files; without it the current one");
    options.flag("--force", force_, "Overwrite files that exist");
  }

  int run() override {
    const auto wheel = read_plane_wheel_or_tell(input_, {name(), {}});
    if (!wheel) return wheel.failure();
    return export_wheel(*wheel);
  }

 private:
  double tolerance() const {
    constexpr double metres_per_millimetre = 1e-3;
    return metres_per_millimetre * (tolerance_ ? *parse_tolerance(*tolerance_) : default_tolerance);
  }

  int export_wheel(const WheelInput<2>& input) const {
    if (const double finest = finest_share * input.source.wheel.outer_radius; tolerance() < finest) {
      tell("wheelwright {}: the tolerance must be at least {:.3g} mm for a wheel of this size\n", name(),
           finest * 1e3);
      return exit_usage;
    }
    const auto outline = cad::fit_outline(input.shape, tolerance());
    if (!outline) return refuse({outline.failure()});
    const auto report = cad::check_outline(*outline, input.shape, tolerance());
    if (!report) return refuse(report.failure());
    const std::string title =
        without_control_characters(input.source.title.empty() ? input.name : input.source.title);
    const WheelModel wheel{.title = fmt::format("{}, {}", title, input.which),
                           .program = fmt::format("wheelwright {}", version()),
                           .shape = input.shape,
                           .outline = *outline,
                           .width = input.source.wheel.width,
                           .tolerance = tolerance()};
    fmt::print("{:<16} {}\n{}", "wheel", wheel.title, text(*report));
    if (report->bodies > 1)
      print_warning(stderr, fmt::format("the material is not connected: {} pieces", report->bodies));
    return write(wheel, input.name);
  }

  int refuse(const std::vector<cad::OutlineFault>& faults) const {
    for (const cad::OutlineFault& fault : faults) tell("wheelwright {}: {}\n", name(), fault.what);
    tell("Nothing was written.\n");
    return exit_refused;
  }

  /// Makes all files before the first is written.
  int write(const WheelModel& wheel, const std::string& stem) const {
    const fs::path folder = output_ ? fs::path(*output_) : fs::path(".");
    std::vector<std::pair<fs::path, std::string>> files;
    const Formats formats = *parse_formats(formats_ ? *formats_ : default_formats);
    for (const ExportFormat* format : formats) {
      const fs::path path = folder / fmt::format("{}.{}", stem, format->name);
      if (!force_ && fs::exists(fs::symlink_status(path))) {
        tell("{}: exists already; choose another folder, or overwrite it with --force\n", path.string());
        return exit_refused;
      }
      try {
        files.emplace_back(path, format->file(wheel));
      } catch (const MissingPlugin& missing) {
        tell("wheelwright {}: {}: {}\n", name(), format->name, missing.what());
        return exit_refused;
      }
    }
    if (!fs::exists(folder)) make_folder(folder);
    for (const auto& [path, bytes] : files) {
      write_atomically(path, bytes);
      fmt::print("{:<16} {}\n", "written", path.string());
    }
    return exit_done;
  }

  std::string input_;
  std::optional<std::string> formats_, tolerance_, output_;
  bool force_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_export_() { return std::make_unique<ExportCommand>(); }

}  // namespace wheelwright
