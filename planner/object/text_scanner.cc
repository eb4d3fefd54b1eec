#include "planner/object/text_scanner.h"

#include <expat.h>

#include <charconv>
#include <exception>
#include <memory>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::object {

namespace {

bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }
bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

bool TextScanner::SkipBlanks(bool across_lines) {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    const std::string_view rest = text_.substr(position_);
    if (rest.starts_with("\\\n") || rest.starts_with("\\\r\n")) {
      position_ = text_.find('\n', position_) + 1;
      ++line_;
    } else if (IsBlank(c)) {
      ++position_;
    } else if (c == '#') {
      while (position_ < text_.size() && !IsLineEnd(text_[position_])) ++position_;
    } else if (IsLineEnd(c) && across_lines) {
      if (c == '\n') ++line_;
      ++position_;
    } else {
      return !IsLineEnd(c);
    }
  }
  return false;
}

std::optional<std::string_view> TextScanner::NextOnLine() {
  if (!SkipBlanks(false)) return std::nullopt;
  const std::size_t first = position_;
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (IsBlank(c) || IsLineEnd(c) || c == '#') break;
    ++position_;
  }
  return text_.substr(first, position_ - first);
}

std::optional<std::string_view> TextScanner::Next() {
  if (!SkipBlanks(true)) return std::nullopt;
  return NextOnLine();
}

void TextScanner::SkipLine() {
  while (NextOnLine()) {
  }
}

std::string_view TextScanner::ReadWord(const std::string& what) {
  const auto word = Next();
  if (!word) Fail("truncated, expected " + what);
  return *word;
}

double TextScanner::ReadDouble(const std::string& what) {
  const std::string_view word = ReadWord(what);
  const auto value = ParseDouble(word);
  if (!value) Fail(what + ": expected a finite number, found " + Quoted(word));
  return *value;
}

long long TextScanner::ReadInteger(const std::string& what) {
  const std::string_view word = ReadWord(what);
  const auto value = ParseInteger(word);
  if (!value) Fail(what + ": expected an integer, found " + Quoted(word));
  return *value;
}

void TextScanner::Expect(std::string_view expected) {
  const std::string what = "\"" + std::string(expected) + "\"";
  const std::string_view word = ReadWord(what);
  if (LowerCase(word) != expected) Fail(Quoted(word) + ", expected " + what);
}

void TextScanner::Fail(const std::string& message) const {
  throw InputError(name_ + ": line " + std::to_string(line_) + ": " + message);
}

std::string Quoted(std::string_view word) {
  constexpr std::size_t kLongest = 24;
  std::string quoted = "\"";
  for (const char c : word.substr(0, kLongest)) {
    const bool printable = c >= 0x20 && c < 0x7f;
    quoted += printable ? c : '?';
  }
  return quoted + (word.size() > kLongest ? "…\"" : "\"");
}

std::string LowerCase(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::optional<long long> ParseInteger(std::string_view word) {
  long long value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end || word.empty()) return std::nullopt;
  return value;
}

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
