#include "report/markup.h"

#include <algorithm>
#include <array>

#include "planner/base/text_table.h"

namespace regrasp::report {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// The void elements of the HTML standard (section "Elements").
constexpr std::array<std::string_view, 13> kVoidTags = {"area",   "base",  "br",    "col",  "embed",
                                                        "hr",     "img",   "input", "link", "meta",
                                                        "source", "track", "wbr"};

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

void Element::Add(std::string_view text) { content_ += EscapeMarkup(text); }

void Element::Add(const Element& child) { content_ += child.Format(); }

void Element::Add(const std::vector<Element>& children) {
  for (const Element& child : children) {
    if (!content_.ends_with('\n')) content_ += "\n";
    content_ += child.Format() + "\n";
  }
}

void Element::AddVerbatim(std::string_view text) { content_ += text; }

std::string Element::Format() const {
  const std::string open = "<" + tag_ + attributes_;
  if (content_.empty() && std::ranges::find(kVoidTags, tag_) != kVoidTags.end())
    return open + " />";
  return open + ">" + content_ + "</" + tag_ + ">";
}

std::string Element::FormatAttributes(const Attributes& attributes) {
  std::string text;
  for (const auto& [name, value] : attributes) {
    text += " " + name + "=\"" + EscapeMarkup(value) + "\"";
  }
  return text;
}

}  // namespace regrasp::report
