#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace wheelwright {

/// Declares the arguments and options of one command to the parser. Each value is a reference to where the
/// parser writes it; the parser refuses a command line with a value that is not allowed. This hides the
/// parser's header, which takes seconds to compile.
class Options {
 public:
  /// What is wrong with a text; empty if nothing is.
  using Check = std::function<std::string(const std::string&)>;
  /// The least and the greatest number that are allowed.
  struct Limits {
    int low, high;
  };

  explicit Options(CLI::App& app) : app_(app) {}

  /// An argument that the command needs.
  void argument(const std::string& name, std::string& value, const std::string& meaning);
  void argument(const std::string& name, std::string& value, const Check& check, const std::string& meaning);
  /// At least `least` arguments.
  void arguments(const std::string& name, std::vector<std::string>& values, int least,
                 const std::string& meaning);
  /// An argument that may be left out; --help shows the value that stands without it.
  void optional_argument(const std::string& name, std::string& value, const std::string& meaning);

  /// --help shows the value that stands without the option.
  void number(const std::string& name, int& value, Limits limits, const std::string& meaning);
  void number(const std::string& name, std::optional<int>& value, Limits limits, const std::string& meaning);
  /// `form` says in --help what the text looks like.
  void text(const std::string& name, const std::string& form, std::optional<std::string>& value,
            const Check& check, const std::string& meaning);
  void flag(const std::string& name, bool& value, const std::string& meaning);

 private:
  CLI::App& app_;
};

}  // namespace wheelwright
