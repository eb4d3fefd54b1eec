#pragma once

#include <string>
#include <string_view>

namespace regrasp {

/// The bytes as lower-case hexadecimal digits, two each.
[[nodiscard]] std::string Hexadecimal(std::string_view bytes);

}  // namespace regrasp
