#include "planner/kinematics/xml_tree.h"

#include <expat.h>

#include <algorithm>
#include <memory>

#include "planner/base/error.h"

namespace regrasp::kinematics {
namespace {

using Attribute = std::pair<std::string, std::string>;

constexpr std::size_t kDeepest = 200;

/// What expat, which is C, is handed and hands back: exceptions do not pass through it.
struct Parsing {
  XML_Parser parser;
  std::string file;
  std::vector<XmlElement> open;  ///< from the root to the innermost
  XmlElement root;
  bool too_deep = false;

  static void Begin(void* data, const char* name, const char** pairs) {
    auto& parsing = *static_cast<Parsing*>(data);
    if (parsing.open.size() == kDeepest) {
      parsing.too_deep = true;
      XML_StopParser(parsing.parser, XML_FALSE);
      return;
    }
    XmlElement element;
    element.name = name;
    element.file = parsing.file;
    element.line = static_cast<int>(XML_GetCurrentLineNumber(parsing.parser));
    for (const char** pair = pairs; *pair != nullptr; pair += 2) {
      element.attributes.emplace_back(pair[0], pair[1]);
    }
    parsing.open.push_back(std::move(element));
  }

  static void End(void* data, const char* /*name*/) {
    auto& parsing = *static_cast<Parsing*>(data);
    if (parsing.open.empty()) return;
    XmlElement element = std::move(parsing.open.back());
    parsing.open.pop_back();
    (parsing.open.empty() ? parsing.root : parsing.open.back().children.emplace_back()) =
        std::move(element);
  }
};

std::string Escaped(const std::string& value) {
  std::string text;
  for (const char c : value) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '"':
        text += "&quot;";
        break;
      case '\n':
      case '\r':
      case '\t':
        text += "&#" + std::to_string(static_cast<int>(c)) + ";";
        break;
      default:
        text += c;
    }
  }
  return text;
}

void Append(const XmlElement& element, int depth, std::string& text) {
  text += std::string(static_cast<std::size_t>(depth), ' ') + "<" + element.name;
  for (const Attribute& attribute : element.attributes) {
    text += " " + attribute.first + "=\"" + Escaped(attribute.second) + "\"";
  }
  if (element.children.empty()) {
    text += "/>\n";
    return;
  }
  text += ">\n";
  for (const XmlElement& child : element.children) Append(child, depth + 1, text);
  text += std::string(static_cast<std::size_t>(depth), ' ') + "</" + element.name + ">\n";
}

}  // namespace

const std::string* XmlElement::Find(std::string_view attribute) const {
  const auto found = std::ranges::find(attributes, attribute, &Attribute::first);
  return found == attributes.end() ? nullptr : &found->second;
}

void XmlElement::Set(std::string_view attribute, std::string value) {
  const auto found = std::ranges::find(attributes, attribute, &Attribute::first);
  if (found != attributes.end()) {
    found->second = std::move(value);
  } else {
    attributes.emplace_back(attribute, std::move(value));
  }
}

void XmlElement::Remove(std::string_view attribute) {
  std::erase_if(attributes, [&](const Attribute& a) { return a.first == attribute; });
}

const XmlElement* XmlElement::Child(std::string_view child) const {
  const auto found = std::ranges::find(children, child, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

XmlElement ParseXml(std::string_view text, const std::string& file) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                       XML_ParserFree);
  Parsing parsing{parser.get(), file, {}, {}};
  XML_SetUserData(parser.get(), &parsing);
  XML_SetElementHandler(parser.get(), Parsing::Begin, Parsing::End);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) ==
      XML_STATUS_ERROR) {
    throw InputError(file + ": line " + std::to_string(XML_GetCurrentLineNumber(parser.get())) +
                     ": " +
                     (parsing.too_deep ? "elements are nested too deep"
                                       : XML_ErrorString(XML_GetErrorCode(parser.get()))));
  }
  return std::move(parsing.root);
}

std::string FormatXml(const XmlElement& root) {
  std::string text;
  Append(root, 0, text);
  return text;
}

}  // namespace regrasp::kinematics
