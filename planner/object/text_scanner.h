#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace regrasp::object {

/// Scanner that splits text into words and knows its position for messages.
///
/// The result does not depend on the locale. Words are separated by blanks and line ends (LF, CR LF
/// or CR). '#' starts a comment until the end of the line. A backslash at the end of a line joins
/// it with the next, as in OBJ.
class TextScanner {
 public:
  /// @param text  must outlive the scanner.
  TextScanner(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  /// Return the next word; nullopt at the end of the text.
  std::optional<std::string_view> Next();
  /// Return the next word on this line; nullopt at its end.
  std::optional<std::string_view> NextOnLine();
  /// Skip to the next line.
  void SkipLine();

  /// Read the next word as a number.
  /// @param what  name of the number for messages.
  /// @throws InputError  if the text ends, or the word is not a finite number or not an integer.
  double ReadDouble(const std::string& what);
  long long ReadInteger(const std::string& what);
  /// Read a word that must be `expected`, in any case.
  void Expect(std::string_view expected);

  /// Index of the first character that is not read yet.
  [[nodiscard]] std::size_t position() const { return position_; }

  /// Throw an InputError with name and line: "mesh.obj: line 12: …".
  [[noreturn]] void Fail(const std::string& message) const;

 private:
  bool SkipBlanks(bool across_lines);
  std::string_view ReadWord(const std::string& what);

  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  int line_ = 1;
};

/// Quote a word of a file for a message: shortened, and without control characters of terminals.
[[nodiscard]] std::string Quoted(std::string_view word);

/// Convert ASCII letters to lower case, in any locale.
[[nodiscard]] std::string LowerCase(std::string_view word);

/// Parse a whole word as an integer; nullopt if it is not one.
[[nodiscard]] std::optional<long long> ParseInteger(std::string_view word);

/// Start tag of an XML document, valid only during the callback.
class XmlTag {
 public:
  /// @param qualified   namespace and local name, joined by the separator of expat; only the local
  ///     name if there is no namespace.
  /// @param attributes  pairs of qualified names and values, closed by a null pointer.
  /// @param prefixes    namespaces declared so far, by prefix.
  XmlTag(const char* qualified, const char** attributes,
         const std::map<std::string, std::string>& prefixes);

  [[nodiscard]] std::string_view space() const { return space_; }  ///< namespace; empty: none
  [[nodiscard]] std::string_view name() const { return name_; }  ///< local name, without the prefix
  [[nodiscard]] const std::map<std::string, std::string>& prefixes() const { return prefixes_; }

  /// Return the value of an attribute; nullopt if it is missing.
  /// @param space  namespace of the attribute; empty for an attribute without a prefix.
  [[nodiscard]] std::optional<std::string> Find(std::string_view attribute,
                                                std::string_view space = {}) const;
  /// Return the value of an attribute.
  /// @throws InputError  if the attribute is missing; names element and attribute.
  [[nodiscard]] std::string Text(std::string_view attribute) const;
  /// Return the value of an attribute as a number.
  /// @throws InputError  if the attribute is missing or is not a finite number.
  [[nodiscard]] double Number(std::string_view attribute) const;

 private:
  std::string_view space_, name_;
  const char** attributes_;
  const std::map<std::string, std::string>& prefixes_;
};

/// Parse an XML document and pass each of its start tags to `begin`, in document order.
///
/// Namespaces are resolved, so that prefixes do not matter. UTF-8 and UTF-16 are supported, as XML
/// requires. No external entity is loaded.
/// @param text   bytes of the document.
/// @param part   name of the document for messages; empty if the caller adds it.
/// @param begin  receives each start tag; its exceptions are passed on with the line.
/// @throws InputError  if the document is not well-formed, or if `begin` throws.
void ScanXml(std::string_view text, const std::string& part,
             const std::function<void(const XmlTag&)>& begin);

}  // namespace regrasp::object
