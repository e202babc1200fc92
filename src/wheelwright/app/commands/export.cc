#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "wheelwright/app/case_input.h"
#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/number_list.h"
#include "wheelwright/app/shared_options.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/app/wheel_input.h"
#include "wheelwright/base/text.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/output/export/formats.h"
#include "wheelwright/output/export/plugin.h"
#include "wheelwright/run/results/faces_wheel.h"
#include "wheelwright/run/results/fitted_wheel.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/results/turned_wheel.h"
#include "wheelwright/run/study/roughness_warning.h"
#include "wheelwright/shape/geometry/invariance.h"
#include "wheelwright/shape/geometry/section.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

constexpr const char *default_formats = "dxf,svg,stl", *default_formats_3d = "stl",
                     *formats_of_sections = "dxf,svg";
constexpr double default_tolerance = 0.01, default_tolerance_3d = 0.1, min_tolerance = 0.001,
                 max_tolerance = 1000;  // [mm]
constexpr double finest_share = 1e-6;   // smallest tolerance, as a fraction of the outer radius

using Formats = std::vector<const ExportFormat*>;
/// Their paths and contents.
using Files = std::vector<std::pair<fs::path, std::string>>;

bool can_hold(const ExportFormat& format, const WheelModel*) { return format.of_plane != nullptr; }
bool can_hold(const ExportFormat& format, const FacesModel*) { return format.of_faces != nullptr; }
bool can_hold(const ExportFormat& format, const SurfaceModel*) {
  return format.of_surface != nullptr || format.of_faces != nullptr;
}
bool can_hold(const ExportFormat& format, const TurnedModel*) { return format.of_profile != nullptr; }
std::string file(const ExportFormat& format, const WheelModel& wheel) { return format.of_plane(wheel); }
std::string file(const ExportFormat& format, const SurfaceModel& wheel) { return format.of_surface(wheel); }
std::string file(const ExportFormat& format, const FacesModel& wheel) { return format.of_faces(wheel); }
std::string file(const ExportFormat& format, const TurnedModel& wheel) { return format.of_profile(wheel); }

std::string names_of_formats(bool (*is_named)(const ExportFormat&)) {
  std::string names;
  for (const ExportFormat& format : export_formats())
    if (is_named(format)) names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

std::string names_of_formats() {
  return names_of_formats([](const ExportFormat&) { return true; });
}

/// The formats that can hold a wheel of this kind.
template <class Model>
std::string names_of_formats_for() {
  return names_of_formats(
      [](const ExportFormat& format) { return can_hold(format, static_cast<const Model*>(nullptr)); });
}

/// The formats in a list like "dxf,svg", without duplicates; nothing if one is unknown or the list is empty.
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
  return parse_formats(list) ? "" : fmt::format("must be a comma-separated list of {}", names_of_formats());
}

std::optional<double> parse_tolerance(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_number = end != text.c_str() && *end == '\0';
  if (!is_number || !(value >= min_tolerance && value <= max_tolerance)) return {};
  return value;
}

std::string check_tolerance(const std::string& text) {
  return parse_tolerance(text)
             ? ""
             : fmt::format("must be a length from {} to {} mm", min_tolerance, max_tolerance);
}

std::string check_sections(const std::string& text) {
  return parse_number_list(text) ? "" : "must be z in mm: A,B,..., or FROM:TO:N";
}

/// A model and the name of its files, without the extension.
template <class Model>
struct Named {
  std::string stem;
  Model model;
};

class ExportCommand : public Subcommand {
 public:
  ExportCommand()
      : Subcommand("export",
                   "Export a shape to CAD, workshop and printing formats: DXF, STEP, STL and others") {}

  void declare(Options& options) override {
    add_wheel(options, input_);
    options.text(
        "--format", "NAME,NAME,...", formats_, check_formats,
        fmt::format("Any of {}; without it {}, for a wheel in 3D that is neither extruded nor turned {}",
                    names_of_formats(), default_formats, default_formats_3d));
    options.text("--tolerance", "MM", tolerance_, check_tolerance,
                 fmt::format("Maximum distance of the curves, in 3D of the triangles, from the shape's edges "
                             "[mm]; default {}, in 3D {}",
                             default_tolerance, default_tolerance_3d));
    add_output(options, output_, "Folder for the files; default: the current one");
    options.text(
        "--sections", "Z,Z,...", sections_, check_sections,
        "Also write sections of a wheel in 3D by planes across the axle as DXF and SVG; z is measured "
        "from its side face at z = 0 [mm]; FROM:TO:N stands for N planes evenly spaced");
    options.flag("--by-layer", by_layer_,
                 "Also write each layer of a wheel of several materials to files of its own");
    options.flag("--force", force_, "Overwrite files that exist");
  }

  int run() override {
    const auto wheel = read_wheel_or_report(input_, {name(), {}});
    if (!wheel) return wheel.failure();
    Files files;
    int code = std::visit([&](const auto& input) { return add_wheel_files(input, files); }, *wheel);
    if (code == exit_done && sections_)
      code = std::visit([&](const auto& input) { return add_sections(input, files); }, *wheel);
    return code == exit_done ? write(files) : code;
  }

 private:
  /// A wheel in 3D that is the same all along the axle has the files of a plane wheel, unless other ones are
  /// asked for.
  bool is_exported_as_plane(const LevelSet<3>& shape) const {
    return is_invariant(shape, Invariance::along_axle) &&
           std::ranges::all_of(formats(default_formats), [](const ExportFormat* format) {
             return can_hold(*format, static_cast<const WheelModel*>(nullptr));
           });
  }

  double tolerance(double without_option) const {
    constexpr double metres_per_millimetre = 1e-3;
    return metres_per_millimetre * (tolerance_ ? *parse_tolerance(*tolerance_) : without_option);
  }

  Formats formats(const char* without_option) const {
    return *parse_formats(formats_ ? *formats_ : without_option);
  }

  /// Whether all formats can hold such a wheel; prints those that cannot.
  template <class Model>
  bool can_hold_or_tell(const Formats& formats) const {
    for (const ExportFormat* format : formats) {
      if (can_hold(*format, static_cast<const Model*>(nullptr))) continue;
      constexpr bool is_solid = std::is_same_v<Model, SurfaceModel>;
      print_err("wheelwright {}: {} cannot hold {}; choose from {}\n", name(), format->name,
                is_solid ? "a wheel in 3D, whose shape changes along the axle" : "a plane wheel",
                names_of_formats_for<Model>());
      return false;
    }
    return true;
  }

  int add_wheel_files(const WheelInput<2>& input, Files& files) const {
    return add_files_of_shape(input, files);
  }

  int add_wheel_files(const WheelInput<3>& input, Files& files) const {
    if (is_exported_as_plane(input.shape)) {
      fmt::print("{:<16} the same all along the axle, exported as a plane wheel\n", "shape");
      return add_files_of_shape(
          WheelInput<2>{input.source, mid_plane_section(input.shape), input.name, input.which}, files);
    }
    if (is_invariant(input.shape, Invariance::about_axle)) return add_files_of_turned(input, files);
    return add_files_of_shape(input, files);
  }

  int add_files_of_shape(const WheelInput<2>& input, Files& files) const {
    const Formats chosen = formats(default_formats);
    if (!can_hold_or_tell<WheelModel>(chosen)) return exit_usage;
    const double accuracy = tolerance(default_tolerance);
    if (is_too_fine(accuracy, input.source)) return exit_usage;
    const auto wheel = fitted(input, accuracy);
    if (!wheel) return refuse(wheel.failure());
    return add_files(input.name, *wheel, chosen, files);
  }

  int add_files_of_shape(const WheelInput<3>& input, Files& files) const {
    const Formats chosen = formats(default_formats_3d);
    if (!can_hold_or_tell<SurfaceModel>(chosen)) return exit_usage;
    return add_files_of_surface(input, chosen, files);
  }

  /// Adds the surface of a shape in the formats that hold triangles, and its faces in the others.
  int add_files_of_surface(const WheelInput<3>& input, const Formats& chosen, Files& files) const {
    const double accuracy = tolerance(default_tolerance_3d);
    const auto wheel = fitted(input, accuracy);
    if (!wheel) return refuse(wheel.failure());
    const auto [of_faces, of_triangles] = divided<FacesModel>(chosen);
    if (!of_faces.empty())
      if (const int code = add_files_of_faces(input.name, *wheel, of_faces, accuracy, files);
          code != exit_done)
        return code;
    return add_files(input.name, *wheel, of_triangles, files);
  }

  /// With smooth faces if these make a valid solid, otherwise with facets.
  int add_files_of_faces(const std::string& name, const SurfaceModel& wheel, const Formats& chosen,
                         double accuracy, Files& files) const {
    for (const FaceKind kind : {FaceKind::smooth, FaceKind::facets}) {
      const auto solid = fitted_faces_wheel(wheel, kind, accuracy);
      if (!solid) return refuse(solid.failure());
      try {
        const int code = add_files(name, solid->model, chosen, files);
        if (code == exit_done) fmt::print("{}", text(*solid));
        return code;
      } catch (const InvalidSolid&) {
        if (kind == FaceKind::facets) throw;
      }
    }
    return exit_refused;
  }

  /// The formats that can hold a model, and the others.
  template <class Model>
  static std::pair<Formats, Formats> divided(const Formats& all) {
    std::pair<Formats, Formats> result;
    for (const ExportFormat* format : all)
      (can_hold(*format, static_cast<const Model*>(nullptr)) ? result.first : result.second)
          .push_back(format);
    return result;
  }

  /// Adds the profile of a body of revolution in the formats that hold profiles, and its surface in the
  /// others.
  int add_files_of_turned(const WheelInput<3>& input, Files& files) const {
    const double accuracy = tolerance(default_tolerance);
    if (is_too_fine(accuracy, input.source)) return exit_usage;
    const auto [of_profile, of_surface] = divided<TurnedModel>(formats(default_formats));
    if (!of_profile.empty()) {
      const auto wheel = fitted_profile(input, accuracy);
      if (!wheel) return refuse(wheel.failure());
      if (const int code = add_files(input.name, *wheel, of_profile, files); code != exit_done) return code;
    }
    return of_surface.empty() ? exit_done : add_files_of_surface(input, of_surface, files);
  }

  int add_sections(const WheelInput<2>&, Files&) const {
    print_err("wheelwright {}: --sections is for wheels in 3D\n", name());
    return exit_usage;
  }

  int add_sections(const WheelInput<3>& input, Files& files) const {
    const double accuracy = tolerance(default_tolerance);
    if (is_too_fine(accuracy, input.source)) return exit_usage;
    const auto planes = parse_number_list(*sections_);
    for (const double z : *planes) {
      if (!(z >= 0 && z * 1e-3 <= input.source.wheel.width * (1 + 1e-9))) {
        print_err("wheelwright {}: --sections: no section at {} mm; the wheel extends from 0 to {:g} mm\n",
                  name(), z, input.source.wheel.width * 1e3);
        return exit_usage;
      }
      const WheelInput<2> section{input.source, section_at(input.shape, z * 1e-3),
                                  fmt::format("{}-z{:g}", input.name, z),
                                  fmt::format("{}, section at z = {:g} mm", input.which, z)};
      const auto fitted_section = fitted(section, accuracy, Pieces::of_a_section);
      if (!fitted_section) return refuse(fitted_section.failure());
      const Formats drawings = *parse_formats(formats_of_sections);
      if (const int code = add_files(section.name, *fitted_section, drawings, files); code != exit_done)
        return code;
    }
    return exit_done;
  }

  /// Whether curves cannot be fitted that accurately; says so.
  bool is_too_fine(double accuracy, const Case& source) const {
    const double finest = finest_share * source.wheel.outer_radius;
    if (accuracy >= finest) return false;
    print_err("wheelwright {}: the tolerance must be at least {:.3g} mm for a wheel of this size\n", name(),
              finest * 1e3);
    return true;
  }

  using Faults = std::vector<cad::OutlineFault>;

  /// Pieces of a section may be connected in other planes.
  enum class Pieces { of_a_wheel, of_a_section };

  /// The model of a wheel; prints what its outline is worth.
  static Expected<WheelModel, Faults> fitted(const WheelInput<2>& input, double accuracy,
                                             Pieces pieces = Pieces::of_a_wheel) {
    auto wheel = fitted_wheel(input.source, input.shape, title(input), accuracy);
    if (!wheel) return wheel.failure();
    fmt::print("{:<16} {}\n{}", "wheel", wheel->model.title, text(wheel->report));
    if (pieces == Pieces::of_a_wheel) warn_of_pieces(wheel->report.bodies);
    if (const auto warning = roughness_warning(input.source, wheel->report.roughness); !warning.empty())
      print_warning(stderr, warning);
    return std::move(wheel->model);
  }

  static Expected<SurfaceModel, Faults> fitted(const WheelInput<3>& input, double accuracy) {
    auto wheel = fitted_wheel(input.source, input.shape, title(input), accuracy);
    if (!wheel) return wheel.failure();
    fmt::print("{:<16} {}\n{}", "wheel", wheel->model.title, text(wheel->whole));
    warn_of_pieces(wheel->whole.report.bodies);
    const MadeWheel made = made_wheel(input.source, wheel->model.surface);
    if (made.mould || made.print) fmt::print("{:<16} {}\n", made.how, text(made));
    if (const std::string warning = making_warning(made); !warning.empty()) print_warning(stderr, warning);
    return std::move(wheel->model);
  }

  static Expected<TurnedModel, Faults> fitted_profile(const WheelInput<3>& input, double accuracy) {
    auto wheel = fitted_turned_wheel(input.source, input.shape, title(input), accuracy);
    if (!wheel) return wheel.failure();
    fmt::print("{:<16} {}\n{:<16} a body of revolution\n{}", "wheel", wheel->model.title, "shape",
               text(wheel->report));
    warn_of_pieces(wheel->report.bodies);
    return std::move(wheel->model);
  }

  static std::string stem(const std::string& wheel, std::string layer) {
    for (char& c : layer)
      if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    return wheel + "-" + layer;
  }

  template <int dim>
  static std::string title(const WheelInput<dim>& input) {
    const std::string own = input.source.title.empty() ? input.name : input.source.title;
    return fmt::format("{}, {}", without_control_characters(own), input.which);
  }

  static void warn_of_pieces(int bodies) {
    if (bodies > 1) print_warning(stderr, fmt::format("the material is not connected: {} pieces", bodies));
  }

  int refuse(const std::vector<cad::OutlineFault>& faults) const {
    for (const cad::OutlineFault& fault : faults) print_err("wheelwright {}: {}\n", name(), fault.what);
    print_err("Nothing was written.\n");
    return exit_refused;
  }

  /// The contents of the files of a wheel, and on request of its layers as files of their own. All are
  /// created before the first is written.
  template <class Model>
  int add_files(const std::string& name, const Model& wheel, const Formats& formats, Files& files) const {
    std::vector<Named<Model>> models{{name, wheel}};
    if (by_layer_)
      for (const auto& layer : wheel.layers)
        models.push_back({stem(name, layer.name), layer_model(wheel, layer)});
    for (const auto& [stem, model] : models)
      for (const ExportFormat* format : formats)
        if (const int code = add_file(stem, model, *format, files); code != exit_done) return code;
    return exit_done;
  }

  template <class Model>
  int add_file(const std::string& stem, const Model& model, const ExportFormat& format, Files& files) const {
    const fs::path path = folder() / fmt::format("{}.{}", stem, format.name);
    if (!force_ && has_entry(path)) {
      print_err("{}: exists already; choose another folder with --output, or replace it with --force\n",
                path.string());
      return exit_refused;
    }
    try {
      files.emplace_back(path, file(format, model));
    } catch (const MissingPlugin& missing) {
      print_err("wheelwright {}: {}: {}\n", name(), format.name, missing.what());
      return exit_refused;
    }
    return exit_done;
  }

  fs::path folder() const { return output_ ? fs::path(*output_) : fs::path("."); }

  int write(const Files& files) const {
    if (!is_there(folder())) make_folder(folder());
    for (const auto& [path, bytes] : files) {
      write_atomically(path, bytes);
      fmt::print("{:<16} {}\n", "written", path.string());
    }
    return exit_done;
  }

  std::string input_;
  std::optional<std::string> formats_, tolerance_, output_, sections_;
  bool force_ = false, by_layer_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_export_() { return std::make_unique<ExportCommand>(); }

}  // namespace wheelwright
