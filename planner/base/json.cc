#include "planner/base/json.h"

#include <algorithm>
#include <set>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp {
namespace {

/// Return the text after the first `mark`, and remove both from `text`; empty if there is none.
std::string CutAfter(std::string& text, std::string_view mark) {
  const auto at = text.find(mark);
  if (at == std::string::npos) return "";
  std::string after = text.substr(at + mark.size());
  text.erase(at);
  return after;
}

/// Reword a token of the parser, such as "number literal".
std::string TokenText(const std::string& token) {
  if (token == "string literal") return "a string";
  if (token == "number literal") return "a number";
  if (token == "'[', '{', or a literal") return "a value";
  // The parser expects the end of an array or object only after a value.
  if (token == "']'") return "',' or ']'";
  if (token == "'}'") return "',' or '}'";
  return token;
}

/// Longest number in messages.
constexpr std::size_t kLongestNumber = 60;

/// Return the place of the first number with this text, outside strings.
/// @returns "line 1, column 2", the place of its first character
std::string PlaceOfNumber(std::string_view text, std::string_view number) {
  std::size_t line = 1, line_begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      while (++i < text.size() && text[i] != '"') i += text[i] == '\\' ? 1 : 0;
    } else if (text[i] == '\n') {
      ++line;
      line_begin = i + 1;
    } else if (text[i] == '-' || (text[i] >= '0' && text[i] <= '9')) {
      const std::size_t end = std::min(text.find_first_not_of("0123456789+-.eE", i), text.size());
      if (text.substr(i, end - i) == number) {
        return "line " + std::to_string(line) + ", column " + std::to_string(i - line_begin + 1);
      }
      i = end - 1;
    }
  }
  return "";
}

/// Reword the parser's error of a number that is not finite as a double. It has no place.
/// @param problem  "number overflow parsing 'NUMBER'"
std::string OverflowText(std::string_view text, std::string problem) {
  std::string number = CutAfter(problem, "parsing '");
  CutAfter(number, "'");
  const std::string place = PlaceOfNumber(text, number);
  if (number.size() > kLongestNumber) number = number.substr(0, kLongestNumber) + "...";
  return (place.empty() ? "" : place + ": ") + "number too large, found " + number;
}

/// Reword an error of the parser.
/// @param text  "parse error at line 1, column 2: syntax error while parsing value - PROBLEM",
///     followed by the token that was read last, or by the token that is expected, or both.
/// @returns "line 1, column 2: not valid JSON, expected a value".
std::string SyntaxErrorText(std::string text) {
  std::string place = text;
  std::string problem = CutAfter(place, " - ");
  if (problem.empty()) return "not valid JSON: " + text;
  CutAfter(place, ": syntax error");
  place = CutAfter(place, "parse error at ");
  const std::string last_read = CutAfter(problem, "; last read: ");
  const bool is_unexpected = problem.starts_with("unexpected ");
  std::string expected;
  if (is_unexpected) {
    expected = CutAfter(problem, "; expected ");
  } else if (const auto at = last_read.rfind("'; expected "); at != std::string::npos) {
    expected = last_read.substr(at + std::string_view("'; expected ").size());
  }
  const std::string start = place + ": not valid JSON";
  if (is_unexpected) {
    const std::string found = problem.substr(std::string_view("unexpected ").size());
    const bool is_closed = found == "']'" || found == "'}'";
    return start + ", expected " + (expected.empty() ? "a value" : TokenText(expected)) +
           ", found " + (is_closed ? found : TokenText(found));
  }
  if (problem == "invalid literal") {
    return start + ", expected " + (expected.empty() ? "a value" : TokenText(expected));
  }
  std::ranges::replace(problem, ';', ',');
  return start + ": " + problem;
}

}  // namespace

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
    // The message begins with its identifier, such as "[json.exception.parse_error.101] ".
    std::string what = error.what();
    if (const auto bracket = what.find("] "); bracket != std::string::npos) {
      what.erase(0, bracket + 2);
    }
    // The message quotes the last token, including invalid UTF-8 and the delete character.
    std::ranges::replace_if(
        what, [](char c) { return static_cast<unsigned char>(c) >= 0x7f; }, '?');
    constexpr int kNumberOverflow = 406;
    throw InputError(
        name + ": " +
        (error.id == kNumberOverflow ? OverflowText(text, what) : SyntaxErrorText(what)));
  }
}

std::string FormatJson(const Json& json) {
  return json.dump(1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
}

}  // namespace regrasp
