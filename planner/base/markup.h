#pragma once

#include <string>
#include <string_view>

namespace regrasp {

/// Text as it can stand in HTML, XML, SVG and in a quoted attribute: & < > " ' are escaped;
/// bytes that are not UTF-8, and invisible characters (IsInvisible) other than tab and line feed,
/// become U+FFFD. What is left are characters that XML 1.0 allows (its production Char).
[[nodiscard]] std::string EscapeMarkup(std::string_view text);

/// <name attributes>content</name>.
/// @param attributes  markup, empty or "class=\"wide\" id=\"x\"".
/// @param content     markup: text must have been escaped.
[[nodiscard]] std::string Element(std::string_view name, std::string_view attributes,
                                  std::string_view content);

/// `name="value"`, the value escaped.
[[nodiscard]] std::string Attribute(std::string_view name, std::string_view value);

}  // namespace regrasp
