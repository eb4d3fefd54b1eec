#pragma once

#include <string>

#include "render/figures/figure_format.h"

namespace regrasp::render {

/// Who made a figure, as its file says: the creator of a PDF, the software of a PNG, the name of
/// the root of a glTF scene.
inline constexpr char kFigureMaker[] = "regrasp figure";

/// Writes the maker into the bytes of an SVG or a PNG, where their programs look for it: a comment
/// after the first line, a text chunk after the header. A PDF gets it from Cairo as it is made.
/// @param bytes  a whole file of the format.
void MarkFigure(FigureFormat format, std::string& bytes);

/// Whether these are the bytes of a marked figure of any format.
[[nodiscard]] bool IsMarkedFigure(const std::string& bytes);

}  // namespace regrasp::render
