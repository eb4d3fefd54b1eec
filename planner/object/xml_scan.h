#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace regrasp::object {

/// Start tag of an XML document, valid only during the callback.
class XmlTag {
 public:
  /// @param qualified   namespace and local name, as expat has them.
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
