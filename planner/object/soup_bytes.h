#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// A soup as bytes, to be sent between two processes of this machine.
[[nodiscard]] std::string SoupToBytes(const PolygonSoup& soup);

/// The inverse. @returns nullopt where the bytes are not those of a whole soup.
[[nodiscard]] std::optional<PolygonSoup> SoupFromBytes(std::string_view bytes);

}  // namespace regrasp::object
