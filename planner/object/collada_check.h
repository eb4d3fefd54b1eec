#pragma once

#include <optional>
#include <string_view>

namespace regrasp::object {

/// Check that a COLLADA document holds nothing that assimp would misread, before assimp reads it.
///
/// Refused are free-form surfaces, polygons with holes, controllers (skins and morphs), the
/// transformations `lookat` and `skew`, several different units, and references to other files.
/// @param bytes  bytes of the document.
/// @returns its unit in metres; nullopt if it names none, which means metres.
/// @throws InputError  without the file's name: line, element and problem.
[[nodiscard]] std::optional<double> CheckCollada(std::string_view bytes);

}  // namespace regrasp::object
