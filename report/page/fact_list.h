#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/markup.h"

namespace regrasp::report {

/// Names and values, beside each other on a page.
class FactList {
 public:
  /// @param style  a class of the style sheet, "digest" for long lines; may be empty.
  void Add(std::string_view name, std::string_view value, const std::string& style = "") {
    const Attributes attributes = style.empty() ? Attributes() : Attributes{{"class", style}};
    facts_.emplace_back("div", attributes, Element("dt", {}, name), Element("dd", {}, value));
  }
  [[nodiscard]] Element Make() const { return Element("dl", {{"class", "facts"}}, facts_); }

 private:
  std::vector<Element> facts_;
};

}  // namespace regrasp::report
