#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regrasp::report {

/// Escape text for HTML, XML, SVG and quoted attributes.
/// The characters & < > " ' are escaped. Bytes that are not UTF-8, and invisible characters
/// (IsInvisible) other than tab and line feed, become U+FFFD. The result has only characters that
/// XML 1.0 allows (its production Char).
[[nodiscard]] std::string EscapeMarkup(std::string_view text);

/// Names and values, in output order.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// An element of HTML, SVG or XML: its tag, its attributes and its content.
///
/// Text and values are escaped when they are added, so that no input becomes markup. The output is
/// well-formed XML and valid HTML: void elements of HTML (meta, img, …) are closed in their own
/// tag, all other elements by an end tag.
class Element {
 public:
  /// @param tag, attributes  tag and attributes; names are not escaped.
  /// @param children         children in output order, of any type that Add accepts.
  template <typename... Children>
  explicit Element(std::string_view tag, const Attributes& attributes = {},
                   const Children&... children)
      : tag_(tag), attributes_(FormatAttributes(attributes)) {
    (Add(children), ...);
  }

  void Add(std::string_view text);
  void Add(const Element& child);
  /// Add elements, each on its own line.
  void Add(const std::vector<Element>& children);
  /// Add text without escaping, such as a style sheet; never text from input.
  void AddVerbatim(std::string_view text);

  [[nodiscard]] std::string Format() const;

 private:
  static std::string FormatAttributes(const Attributes& attributes);

  std::string tag_, attributes_, content_;
};

}  // namespace regrasp::report
