#include "errors.h"

#include "wheelwright/files/output_error.h"
#include "wheelwright/output/export/plugin.h"

namespace wheelwright::python {
namespace {

const char* word(Diagnostic::Kind kind) {
  constexpr const char* words[] = {"unreadable", "empty",        "syntax",   "unknown_key", "missing_key",
                                   "wrong_type", "out_of_range", "conflict", "drawing"};
  return words[static_cast<int>(kind)];
}

}  // namespace

void raise(const Failure& failure) { raise("ComputationError", to_string(failure.reason), failure.detail); }

void raise(const std::vector<Diagnostic>& problems) {
  const py::object type = py::module_::import("wheelwright.errors").attr("Problem");
  py::list list;
  for (const Diagnostic& problem : problems)
    list.append(type(word(problem.kind), problem.file, problem.line, problem.column, problem.key,
                     problem.value, problem.problem, problem.remedy, problem.text()));
  raise("CaseError", list);
}

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    const auto set = [](const char* name, const py::tuple& arguments) {
      const py::object type = py::module_::import("wheelwright.errors").attr(name);
      PyErr_SetObject(type.ptr(), type(*arguments).ptr());
    };
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const OutputError& error) {
      set("OutputError", py::make_tuple(error.error(), error.what(), error.path().string()));
    } catch (const MissingPlugin& error) {
      set("Error", py::make_tuple(error.what()));
    }
  });
}

}  // namespace wheelwright::python
