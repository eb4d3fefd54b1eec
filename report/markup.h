#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regrasp::report {

/// Text as it can stand in HTML, XML, SVG and in a quoted attribute: & < > " ' are escaped;
/// bytes that are not UTF-8, and invisible characters (IsInvisible) other than tab and line feed,
/// become U+FFFD. What is left are characters that XML 1.0 allows (its production Char).
[[nodiscard]] std::string EscapeMarkup(std::string_view text);

/// Names and values, in this order.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// An element of HTML, SVG or XML: its tag, its attributes and what stands in it.
///
/// Text and values are escaped where they are added, so that nothing from outside becomes markup.
/// What is written is well-formed XML, and HTML too: the elements that HTML calls void (meta, img,
/// …) are closed in their own tag, all others by one.
class Element {
 public:
  /// @param tag, attributes  names are taken as they are.
  /// @param children         as Add takes them, in this order.
  template <typename... Children>
  explicit Element(std::string_view tag, const Attributes& attributes = {},
                   const Children&... children)
      : tag_(tag), attributes_(FormatAttributes(attributes)) {
    (Add(children), ...);
  }

  void Add(std::string_view text);
  void Add(const Element& child);
  /// Elements side by side, each on a line of its own.
  void Add(const std::vector<Element>& children);
  /// What follows other rules than markup and comes from no one else: a style sheet.
  void AddVerbatim(std::string_view text);

  [[nodiscard]] std::string Format() const;

 private:
  static std::string FormatAttributes(const Attributes& attributes);

  std::string tag_, attributes_, content_;
};

}  // namespace regrasp::report
