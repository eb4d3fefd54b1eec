#pragma once

#include <cstdint>
#include <string>

namespace regrasp::render {

/// PNG's integers have their highest byte first.
[[nodiscard]] std::string PngInteger(std::uint32_t number);

/// A chunk of a PNG file (PNG specification, 5.3).
/// @param type  four letters.
[[nodiscard]] std::string PngChunk(const std::string& type, const std::string& data);

}  // namespace regrasp::render
