#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "planner/base/index.h"

namespace regrasp {

/// JSON as this project reads it. Keys keep the order in which they are written.
using Json = nlohmann::ordered_json;

/// Deepest nesting that a file may have; our own formats need eight.
inline constexpr int kMaxJsonDepth = 64;

/// Most members that an object may have; our own formats need twenty. A member of `Json` is found
/// by going through those before it, so without a limit an object takes the square of its size.
inline constexpr std::size_t kMaxJsonMembers = 256;

/// Parses JSON strictly: a byte-order mark is skipped; a repeated key, nesting deeper than
/// `kMaxJsonDepth`, an object of more than `kMaxJsonMembers`, a number out of range, invalid UTF-8,
/// a NUL byte and text behind the value are errors.
/// @param name  how messages call the input, usually the file's path.
/// @throws InputError
[[nodiscard]] Json ParseJson(std::string_view text, const std::string& name);

/// Writes JSON with an indent of 1 and a final newline; doubles read back as the same bits. Bytes
/// that are not UTF-8, which a file's name may have, become U+FFFD.
[[nodiscard]] std::string FormatJson(const Json& json);

/// An index is its number.
template <class Tag>
void to_json(Json& json, Index<Tag> index) {
  json = static_cast<int>(index);
}

}  // namespace regrasp
