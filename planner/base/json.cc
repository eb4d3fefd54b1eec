#include "planner/base/json.h"

#include <algorithm>
#include <set>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/text_encoding.h"

namespace regrasp {

Json ParseJson(std::string_view text, const std::string& name) {
  text = TextOf(text, name);
  // nlohmann::json stops at a NUL byte.
  if (text.find('\0') != std::string_view::npos)
    throw InputError(name + ": not valid JSON: contains a NUL byte");
  // nlohmann::json silently keeps the last of two equal keys, destroys values recursively at any
  // depth, and compares each key with all previous ones. The callback rejects such input before.
  std::vector<std::set<std::string>> keys;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    using Event = Json::parse_event_t;
    if (event == Event::object_start || event == Event::array_start) {
      if (depth >= kMaxJsonDepth) {
        throw InputError(name + ": nested deeper than " + std::to_string(kMaxJsonDepth) +
                         " levels");
      }
    }
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(value.get<std::string>()).second) {
      const std::string key = value.dump(-1, ' ', /*ensure_ascii=*/true);
      throw InputError(name + ": key " + key + ": repeated");
    }
    if (event == Event::key && keys.back().size() > kMaxJsonMembers) {
      throw InputError(name + ": object with more than " + std::to_string(kMaxJsonMembers) +
                       " members");
    }
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), watch);
  } catch (const Json::exception& error) {
    // Format of the message: "[json.exception.parse_error.101] parse error at line 1, column 2:
    // syntax error …"
    std::string what = error.what();
    if (const auto bracket = what.find("] "); bracket != std::string::npos) {
      what.erase(0, bracket + 2);
    }
    // The message quotes the last token, including invalid UTF-8 and the delete character.
    std::ranges::replace_if(
        what, [](char c) { return static_cast<unsigned char>(c) >= 0x7f; }, '?');
    throw InputError(name + ": not valid JSON: " + what);
  }
}

std::string FormatJson(const Json& json) {
  return json.dump(1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace regrasp
