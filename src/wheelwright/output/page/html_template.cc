#include "wheelwright/output/page/html_template.h"

#include <nlohmann/json.hpp>

namespace wheelwright {

std::string json_in_script(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

std::string filled_template(std::string_view page,
                            const std::vector<std::pair<std::string_view, std::string>>& contents) {
  std::string result;
  for (const auto& [mark, content] : contents) {
    const std::size_t at = page.find(mark);
    result.append(page.substr(0, at)).append(content);
    page.remove_prefix(at + mark.size());
  }
  return result.append(page);
}

}  // namespace wheelwright
