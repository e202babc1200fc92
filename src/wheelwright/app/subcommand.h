#pragma once

#include <string>

#include "wheelwright/app/options.h"

namespace wheelwright {

/// A command of the program, as in `wheelwright check CASE`.
class Subcommand {
 public:
  Subcommand(std::string name, std::string meaning) : name_(std::move(name)), meaning_(std::move(meaning)) {}
  virtual ~Subcommand() = default;

  const std::string& name() const { return name_; }
  /// One line for --help.
  const std::string& meaning() const { return meaning_; }

  /// Declares the options, whose values are members of the command; the parser sets them.
  virtual void declare(Options&) {}

  /// Runs the command with the values of its options; returns an ExitCode. Throws the exceptions that
  /// guarded() handles.
  virtual int run() = 0;

 private:
  std::string name_, meaning_;
};

}  // namespace wheelwright
