#include "render/figures/figure_format.h"

#include <cassert>
#include <cstddef>
#include <string_view>

#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using namespace std::literals;

/// Length of the signature and the header chunk (PNG specification, 5.2 and 5.3).
constexpr std::size_t kEndOfPngHeader = 8 + 4 + 4 + 13 + 4;

std::string SvgMark() { return "<!-- Creator: " + std::string(kFigureMaker) + " -->\n"; }

std::string PdfMark() { return "/Creator (" + std::string(kFigureMaker) + ")"; }

/// A text chunk contains a registered keyword, a zero byte and the text.
std::string PngMark() { return PngChunk("tEXt", "Software"s + '\0' + kFigureMaker); }

}  // namespace

void MarkFigure(FigureFormat format, std::string& bytes) {
  switch (format) {
    case FigureFormat::kSvg:
      bytes.insert(bytes.find('\n') + 1, SvgMark());
      break;
    case FigureFormat::kPng:
      assert(bytes.size() > kEndOfPngHeader);
      bytes.insert(kEndOfPngHeader, PngMark());
      break;
    case FigureFormat::kPdf:
      break;
  }
}

bool IsMarkedFigure(const std::string& bytes) {
  const auto holds = [&](std::string_view beginning, const std::string& mark) {
    return bytes.starts_with(beginning) && bytes.find(mark) != std::string::npos;
  };
  return holds("<?xml"sv, SvgMark()) || holds("%PDF-"sv, PdfMark()) ||
         holds("\x89PNG"sv, PngMark()) ||
         holds("glTF"sv, "\"name\":\"" + std::string(kFigureMaker) + "\"");
}

}  // namespace regrasp::render
