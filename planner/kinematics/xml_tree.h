#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regrasp::kinematics {

/// An element of an XML file; text between elements is not kept.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< in the order of the file
  std::vector<XmlElement> children;
  std::string file;  ///< where it stands, for messages
  int line = 0;

  /// @returns nullptr where it has no such attribute; valid until the attributes change.
  [[nodiscard]] const std::string* Find(std::string_view attribute) const;
  void Set(std::string_view attribute, std::string value);
  void Remove(std::string_view attribute);
  /// @returns nullptr where it has none; the first of several.
  [[nodiscard]] const XmlElement* Child(std::string_view child) const;
};

/// @param file  how messages call it.
/// @throws InputError  it is no XML, or elements are nested deeper than any model's.
[[nodiscard]] XmlElement ParseXml(std::string_view text, const std::string& file);

/// Law: ParseXml of the text gives the same names, attributes and children.
[[nodiscard]] std::string FormatXml(const XmlElement& root);

}  // namespace regrasp::kinematics
