#pragma once

namespace regrasp::render {

/// The file formats of figures.
enum class FigureFormat { kSvg, kPdf, kPng };

}  // namespace regrasp::render
