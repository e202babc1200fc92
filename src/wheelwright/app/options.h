#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace wheelwright {

/// Declares the arguments and options of one command to the parser. The parser writes each value to the given
/// reference, and rejects a command line with a value that is not allowed. This hides the parser's header,
/// which takes seconds to compile.
class Options {
 public:
  /// Returns what is wrong with a text; empty if it is valid.
  using Check = std::function<std::string(const std::string&)>;
  /// The minimum and maximum allowed number.
  struct Limits {
    int low, high;
  };

  explicit Options(CLI::App& app) : app_(app) {}

  /// A required argument.
  void argument(const std::string& name, std::string& value, const std::string& meaning);
  void argument(const std::string& name, std::string& value, const Check& check, const std::string& meaning);
  /// At least `least` arguments.
  void arguments(const std::string& name, std::vector<std::string>& values, int minimum,
                 const std::string& meaning);
  /// An optional argument; --help shows the current value as the default.
  void optional_argument(const std::string& name, std::string& value, const std::string& meaning);

  /// --help shows the current value as the default.
  void number(const std::string& name, int& value, Limits limits, const std::string& meaning);
  void number(const std::string& name, std::optional<int>& value, Limits limits, const std::string& meaning);
  /// `form` describes the syntax in --help.
  void text(const std::string& name, const std::string& form, std::optional<std::string>& value,
            const Check& check, const std::string& meaning);
  void flag(const std::string& name, bool& value, const std::string& meaning);

 private:
  CLI::App& app_;
};

}  // namespace wheelwright
