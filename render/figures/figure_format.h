#pragma once

#include <string>

namespace regrasp::render {

/// File formats of figures.
enum class FigureFormat { kSvg, kPdf, kPng };

/// Widths of figures in journals, points: one column (85 mm) and two (174 mm).
inline constexpr double kPointsPerMillimetre = 72 / 25.4;
inline constexpr double kColumnWidth = 85 * kPointsPerMillimetre;
inline constexpr double kTwoColumnWidth = 174 * kPointsPerMillimetre;

/// Program name in the metadata of a figure: creator of a PDF, software of a PNG, root node of a
/// glTF scene.
inline constexpr char kFigureMaker[] = "regrasp figure";

/// Write the program name into an SVG (as a comment after the first line) or a PNG (as a text chunk
/// after the header). Cairo writes it into a PDF.
/// @param bytes  complete file of the format.
void MarkFigure(FigureFormat format, std::string& bytes);

/// Return whether the bytes are those of a marked figure of any format.
[[nodiscard]] bool IsMarkedFigure(const std::string& bytes);

}  // namespace regrasp::render
