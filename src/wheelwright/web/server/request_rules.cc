#include "wheelwright/web/server/request_rules.h"

#include <fmt/format.h>

#include <charconv>

#include "wheelwright/web/server/token.h"

namespace wheelwright {
namespace {

/// %2B is +, and + is a space.
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    unsigned byte = 0;
    const char* const digits = text.data() + k + 1;
    if (text[k] == '%' && k + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      result += static_cast<char>(byte);
      k += 2;
    } else {
      result += text[k] == '+' ? ' ' : text[k];
    }
  }
  return result;
}

/// Removes and returns the text up to a character, which is also removed; all of it if the character is
/// absent.
std::string_view taken_until(char end, std::string_view& text) {
  const std::string_view taken = text.substr(0, text.find(end));
  text.remove_prefix(std::min(taken.size() + 1, text.size()));
  return taken;
}

}  // namespace

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

std::map<std::string, std::string> parameters_of(std::string_view target) {
  std::map<std::string, std::string> parameters;
  taken_until('?', target);
  while (!target.empty()) {
    std::string_view value = taken_until('&', target);
    const std::string_view name = taken_until('=', value);
    parameters.emplace(decoded(name), decoded(value));
  }
  return parameters;
}

bool is_for_this_server(const RequestHead& head, int port) {
  if (!head.host) return false;
  const std::string own[] = {fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)};
  if (*head.host != own[0] && *head.host != own[1]) return false;
  return !head.origin || *head.origin == fmt::format("http://{}", *head.host);
}

bool is_of_own_origin(const RequestHead& head, int port) {
  const std::string site = head.fetch_site.value_or("none");
  return is_for_this_server(head, port) && (site == "same-origin" || site == "none");
}

bool may_open_page(const RequestHead& head, int port) {
  return is_for_this_server(head, port) && head.fetch_mode.value_or("navigate") == "navigate" &&
         head.fetch_dest.value_or("document") == "document";
}

bool has_token(const RequestHead& head, const std::string& token) {
  return head.authorization && equal_in_constant_time(*head.authorization, fmt::format("Bearer {}", token));
}

}  // namespace wheelwright
