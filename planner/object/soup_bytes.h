#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// Serialize a soup for another process on the same machine.
[[nodiscard]] std::string SoupToBytes(const PolygonSoup& soup);

/// Deserialize a soup. @returns nullopt if the bytes are not those of a complete soup.
[[nodiscard]] std::optional<PolygonSoup> SoupFromBytes(std::string_view bytes);

}  // namespace regrasp::object
