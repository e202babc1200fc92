#include "wheelwright/app/options.h"

#include <CLI/CLI.hpp>

namespace wheelwright {
namespace {

CLI::Option* add_number(CLI::App& app, const std::string& name, auto& value, Options::Limits limits,
                        const std::string& meaning) {
  return app.add_option(name, value, meaning)->type_name("N")->check(CLI::Range(limits.low, limits.high));
}

}  // namespace

void Options::argument(const std::string& name, std::string& value, const std::string& meaning) {
  app_.add_option(name, value, meaning)->required();
}

void Options::argument(const std::string& name, std::string& value, const Check& check,
                       const std::string& meaning) {
  app_.add_option(name, value, meaning)->required()->check(check);
}

void Options::arguments(const std::string& name, std::vector<std::string>& values, int minimum,
                        const std::string& meaning) {
  constexpr int most = 1000;
  app_.add_option(name, values, meaning)->required()->expected(minimum, most);
}

void Options::optional_argument(const std::string& name, std::string& value, const std::string& meaning) {
  app_.add_option(name, value, meaning)->capture_default_str();
}

void Options::number(const std::string& name, int& value, Limits limits, const std::string& meaning) {
  add_number(app_, name, value, limits, meaning)->capture_default_str();
}

void Options::number(const std::string& name, std::optional<int>& value, Limits limits,
                     const std::string& meaning) {
  add_number(app_, name, value, limits, meaning);
}

void Options::text(const std::string& name, const std::string& form, std::optional<std::string>& value,
                   const Check& check, const std::string& meaning) {
  app_.add_option(name, value, meaning)->type_name(form)->check(check);
}

void Options::flag(const std::string& name, bool& value, const std::string& meaning) {
  app_.add_flag(name, value, meaning);
}

}  // namespace wheelwright
