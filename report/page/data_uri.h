#pragma once

#include <string>
#include <string_view>

namespace regrasp::report {

/// Bytes as a URI that holds them, "data:image/webp;base64,…".
[[nodiscard]] std::string DataUri(std::string_view media_type, std::string_view bytes);

}  // namespace regrasp::report
