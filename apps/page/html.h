#pragma once

#include <string>
#include <string_view>

namespace regrasp {

/// Text as it can stand in HTML, in SVG and in a quoted attribute of either: & < > " ' are escaped;
/// bytes that are not UTF-8, and control characters other than tab and line feed, become U+FFFD.
[[nodiscard]] std::string EscapeHtml(std::string_view text);

/// <name attributes>content</name>.
/// @param attributes  markup, empty or "class=\"wide\" id=\"x\"".
/// @param content     markup: text must have been escaped.
[[nodiscard]] std::string Element(std::string_view name, std::string_view attributes,
                                  std::string_view content);

/// `name="value"`, the value escaped.
[[nodiscard]] std::string Attribute(std::string_view name, std::string_view value);

/// Bytes as a URI that holds them, "data:image/webp;base64,…".
[[nodiscard]] std::string DataUri(std::string_view media_type, std::string_view bytes);

}  // namespace regrasp
