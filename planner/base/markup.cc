#include "planner/base/markup.h"

#include "planner/base/utf8.h"

namespace regrasp {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

}  // namespace

std::string EscapeMarkup(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Utf8Character character = TakeCharacter(text);
    switch (character.code) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      case '\t':
      case '\n':
        out += character.bytes;
        break;
      default:
        out += !character.is_valid || IsInvisible(character.code) ? kReplacement : character.bytes;
    }
  }
  return out;
}

std::string Element(std::string_view name, std::string_view attributes, std::string_view content) {
  std::string out = "<" + std::string(name);
  if (!attributes.empty()) out += " " + std::string(attributes);
  return out + ">" + std::string(content) + "</" + std::string(name) + ">";
}

std::string Attribute(std::string_view name, std::string_view value) {
  return std::string(name) + "=\"" + EscapeMarkup(value) + "\"";
}

}  // namespace regrasp
