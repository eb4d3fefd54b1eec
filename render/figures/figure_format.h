#pragma once

namespace regrasp {

/// The file formats of figures.
enum class FigureFormat { kSvg, kPdf, kPng };

}  // namespace regrasp
