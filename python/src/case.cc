#include <pybind11/stl.h>

#include "errors.h"
#include "held_case.h"
#include "module.h"
#include "own_functional.h"
#include "wheelwright/case/key_text.h"
#include "wheelwright/case/presets.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/study/case_report.h"

namespace wheelwright::python {
namespace {

HeldCase held_case(const std::string& text, const std::string& file, const py::list& functionals) {
  Vocabulary vocabulary;
  for (const py::handle functional : functionals)
    vocabulary.quantities.add(own_quantity(py::reinterpret_borrow<py::object>(functional)));
  const CaseResult read = parse_case(text, file, vocabulary);
  if (!read.value) raise(read.problems);
  return {*read.value, read.given_cells, file};
}

std::string with_keys(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [path, value] : values) {
    auto changed = with_key(text, path, value);
    if (!changed) raise("UnknownKeyError", changed.failure().text);
    text = *std::move(changed);
  }
  return text;
}

}  // namespace

void bind_case(py::module_& m) {
  py::class_<HeldCase>(m, "Case")
      .def(py::init(&held_case))
      .def("key",
           [](const HeldCase& held, const std::string& path) {
             const auto text = key_text(held.value, path);
             if (!text) raise("UnknownKeyError", text.failure().text);
             return *text;
           })
      .def("warnings", [](const HeldCase& held) { return warnings(held.value); })
      .def_property_readonly("resolved", [](const HeldCase& held) { return to_toml(held.value); })
      .def_property_readonly("dimension", [](const HeldCase& held) { return held.value.wheel.dimension; })
      .def_property_readonly("folder", [](const HeldCase& held) { return held.value.output.folder; });
  m.def("with_keys", &with_keys);
  m.def("presets", [] {
    std::vector<std::pair<std::string, std::string>> all;
    for (const Preset& preset : presets()) all.emplace_back(preset.name, preset.meaning);
    return all;
  });
  m.def("preset", [](const std::string& name) {
    const Preset* preset = find_preset(name);
    if (!preset) throw py::key_error("there is no preset named " + name);
    return std::string(preset->text);
  });
}

}  // namespace wheelwright::python
