#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "planner/base/index.h"

namespace regrasp {

/// JSON value. Object members keep their order.
using Json = nlohmann::ordered_json;

/// Largest nesting depth of a file; the project's own formats require eight.
inline constexpr int kMaxJsonDepth = 64;

/// Largest number of members of an object; the project's own formats require twenty. `Json` finds a
/// member by linear search, so large objects would take quadratic time.
inline constexpr std::size_t kMaxJsonMembers = 256;

/// Parse JSON strictly.
/// A byte-order mark is skipped. Errors are repeated keys, nesting deeper than `kMaxJsonDepth`,
/// more than `kMaxJsonMembers` members of an object, numbers out of range, invalid UTF-8, NUL
/// bytes, and text after the value.
/// @param name  name of the input in messages, usually the file's path.
/// @throws InputError  if the text is invalid.
[[nodiscard]] Json ParseJson(std::string_view text, const std::string& name);

/// Format JSON with an indentation of 1 and a final newline.
/// Doubles are read back exactly. Bytes that are not UTF-8, which file names can contain, become
/// U+FFFD.
[[nodiscard]] std::string FormatJson(const Json& json);

/// Convert an index to its number.
template <class Tag>
void to_json(Json& json, Index<Tag> index) {
  json = static_cast<int>(index);
}

}  // namespace regrasp
