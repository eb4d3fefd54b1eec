#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/base/angle.h"
#include "planner/base/json.h"

namespace regrasp::report {

/// The value, or null where there is none.
template <class Value>
[[nodiscard]] Json OrNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// The text; an empty one is null.
[[nodiscard]] inline Json TextOrNull(std::string_view text) {
  return text.empty() ? Json(nullptr) : Json(std::string(text));
}

/// The number of an entry or a finger; null where it is negative: none.
[[nodiscard]] inline Json IndexOrNull(int index) { return index < 0 ? Json(nullptr) : Json(index); }

/// An angle in radians as degrees, or null.
[[nodiscard]] inline Json DegreesOrNull(const std::optional<double>& angle) {
  return angle ? Json(Degrees(*angle)) : Json(nullptr);
}

}  // namespace regrasp::report
