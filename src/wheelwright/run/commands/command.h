#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "wheelwright/run/commands/run_control.h"

namespace wheelwright {

/// What was done, one line; empty if there is nothing to report.
using CommandResult = Expected<std::string, Refusal>;

/// Where the value of a field is. Numbers must be finite, integers at most 1e6; an optional field may be
/// absent.
using FieldPlace =
    std::variant<double*, int*, std::string*, Fill*, std::array<double, 2>*,
                 std::vector<std::array<double, 2>>*, std::optional<double>*, std::optional<int>*,
                 std::optional<std::string>*, std::optional<std::array<double, 2>>*>;

/// A field of a command: from it follow how the command is read, written and explained.
struct CommandField {
  std::string key;      ///< with its unit, e.g. "radius_m"
  std::string meaning;  ///< half a line
  FieldPlace place;
  bool has_default = false;  ///< whether it may be absent although its type is not optional
};
using CommandFields = std::vector<CommandField>;

/// A command: a struct with default values that has a name, e.g. "move_hole", a meaning, execute(), and
/// fields() if it has any. fields() returns places in the object itself.
template <class C>
concept DeclaredCommand = requires(const C& command, RunControl& run) {
  { C::name } -> std::convertible_to<std::string_view>;
  { C::meaning } -> std::convertible_to<std::string_view>;
  { command.execute(run) } -> std::convertible_to<CommandResult>;
}
&&std::copyable<C>&& std::default_initializable<C>;

template <DeclaredCommand C>
CommandFields fields_of(C& command) {
  if constexpr (requires { command.fields(); })
    return command.fields();
  else
    return {};
}

/// Any declared command.
class Command {
 public:
  template <DeclaredCommand C>
  Command(C command) : content_(std::make_shared<const Content<C>>(std::move(command))) {}

  std::string_view name() const { return content_->name(); }
  CommandResult execute(RunControl& run) const { return content_->execute(run); }
  /// Calls `see` with the fields of a copy.
  void show_fields(const std::function<void(const CommandFields&)>& see) const { content_->show_fields(see); }

  /// The command, if it is of this kind.
  template <DeclaredCommand C>
  const C* get_if() const {
    const auto* content = dynamic_cast<const Content<C>*>(content_.get());
    return content ? &content->command : nullptr;
  }
  template <DeclaredCommand C>
  bool is() const {
    return get_if<C>() != nullptr;
  }
  /// Whether this is a copy of the other one, not only an equal command.
  bool is_copy_of(const Command& other) const { return content_ == other.content_; }

 private:
  struct AnyContent {
    virtual ~AnyContent() = default;
    virtual std::string_view name() const = 0;
    virtual CommandResult execute(RunControl& run) const = 0;
    virtual void show_fields(const std::function<void(const CommandFields&)>& see) const = 0;
  };
  template <class C>
  struct Content : AnyContent {
    C command;

    explicit Content(C c) : command(std::move(c)) {}
    std::string_view name() const override { return C::name; }
    CommandResult execute(RunControl& run) const override { return command.execute(run); }
    void show_fields(const std::function<void(const CommandFields&)>& see) const override {
      C copy = command;
      see(fields_of(copy));
    }
  };

  std::shared_ptr<const AnyContent> content_;
};

/// A kind of commands that can be read.
struct CommandKind {
  std::string_view name, meaning;
  /// Makes one from default values, which `fill` may change.
  std::function<Command(const std::function<void(const CommandFields&)>& fill)> make;
};
using CommandKinds = std::vector<CommandKind>;

/// `usual` has the default values.
template <DeclaredCommand C>
CommandKind command_kind(const C& usual = {}) {
  return {C::name, C::meaning, [usual](const std::function<void(const CommandFields&)>& fill) {
            C command = usual;
            fill(fields_of(command));
            return Command(std::move(command));
          }};
}

}  // namespace wheelwright
