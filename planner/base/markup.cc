#include "planner/base/markup.h"

#include "planner/base/json.h"

namespace regrasp {

namespace {

constexpr char kReplacement[] = "\xEF\xBF\xBD";  // U+FFFD

/// Valid UTF-8: the JSON library replaces what is not.
std::string RepairUtf8(std::string_view text) {
  const std::string json =
      Json(std::string(text))
          .dump(/*indent=*/-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
  return Json::parse(json).get<std::string>();
}

bool IsControl(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n') || byte == 0x7F;
}

}  // namespace

std::string EscapeMarkup(std::string_view text) {
  std::string out;
  for (const char c : RepairUtf8(text)) {
    switch (c) {
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
      default:
        IsControl(c) ? out += kReplacement : out += c;
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
