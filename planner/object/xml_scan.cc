#include "planner/object/xml_scan.h"

#include <expat.h>

#include <exception>
#include <memory>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::object {

namespace {

/// Separator of namespace and local name; no name contains it.
constexpr char kSeparator = '\n';

struct QualifiedName {
  std::string_view space, name;
};

QualifiedName SplitName(std::string_view qualified) {
  const std::size_t at = qualified.find(kSeparator);
  if (at == std::string_view::npos) return {"", qualified};
  return {qualified.substr(0, at), qualified.substr(at + 1)};
}

/// State shared with expat. Exceptions must not pass through it, because it is a C library.
struct Scan {
  XML_Parser parser;
  const std::function<void(const XmlTag&)>& begin;
  std::map<std::string, std::string> prefixes;
  std::string failure;

  static void Declare(void* data, const char* prefix, const char* space) {
    if (prefix != nullptr && space != nullptr) static_cast<Scan*>(data)->prefixes[prefix] = space;
  }
  static void Begin(void* data, const char* name, const char** attributes) {
    auto& scan = *static_cast<Scan*>(data);
    if (!scan.failure.empty()) return;
    try {
      scan.begin(XmlTag(name, attributes, scan.prefixes));
    } catch (const std::exception& error) {
      scan.failure = error.what();
      XML_StopParser(scan.parser, XML_FALSE);
    }
  }
};

}  // namespace

XmlTag::XmlTag(const char* qualified, const char** attributes,
               const std::map<std::string, std::string>& prefixes)
    : space_(SplitName(qualified).space),
      name_(SplitName(qualified).name),
      attributes_(attributes),
      prefixes_(prefixes) {}

std::optional<std::string> XmlTag::Find(std::string_view attribute, std::string_view space) const {
  for (const char** pair = attributes_; *pair != nullptr; pair += 2) {
    const QualifiedName name = SplitName(pair[0]);
    if (name.name == attribute && name.space == space) return pair[1];
  }
  return std::nullopt;
}

std::string XmlTag::Text(std::string_view attribute) const {
  if (auto text = Find(attribute)) return *std::move(text);
  throw InputError(std::string(name_) + ": lacks " + std::string(attribute));
}

double XmlTag::Number(std::string_view attribute) const {
  if (const auto value = ParseDouble(Text(attribute))) return *value;
  throw InputError(std::string(name_) + ": " + std::string(attribute) + " must be a finite number");
}

void ScanXml(std::string_view text, const std::string& part,
             const std::function<void(const XmlTag&)>& begin) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(
      XML_ParserCreateNS(nullptr, kSeparator), XML_ParserFree);
  Scan scan{parser.get(), begin, {}, {}};
  XML_SetUserData(parser.get(), &scan);
  XML_SetStartElementHandler(parser.get(), Scan::Begin);
  XML_SetStartNamespaceDeclHandler(parser.get(), Scan::Declare);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) ==
      XML_STATUS_ERROR) {
    throw InputError(
        (part.empty() ? "" : part + ": ") + "line " +
        std::to_string(XML_GetCurrentLineNumber(parser.get())) + ": " +
        (scan.failure.empty() ? XML_ErrorString(XML_GetErrorCode(parser.get())) : scan.failure));
  }
}

}  // namespace regrasp::object
