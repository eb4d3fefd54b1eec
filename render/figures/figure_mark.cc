#include "render/figures/figure_mark.h"

#include <zlib.h>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace regrasp::render {

namespace {

using namespace std::literals;

/// PNG specification, 5.2 and 5.3: the signature, then the header chunk.
constexpr std::size_t kEndOfPngHeader = 8 + 4 + 4 + 13 + 4;

std::string SvgMark() { return "<!-- Creator: " + std::string(kFigureMaker) + " -->\n"; }

std::string PdfMark() { return "/Creator (" + std::string(kFigureMaker) + ")"; }

/// The type of a text chunk, and its data: the registered keyword, a zero, the text.
std::string PngMark() { return "tEXtSoftware"s + '\0' + kFigureMaker; }

/// PNG's integers have their highest byte first.
std::string FourBytes(std::uint32_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

/// A chunk's length leaves out its type, its check sum does not.
std::string PngChunk(const std::string& typed) {
  constexpr std::uint32_t kType = 4;
  const auto size = static_cast<std::uint32_t>(typed.size());
  const auto sum =
      static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(typed.data()), size));
  return FourBytes(size - kType) + typed + FourBytes(sum);
}

}  // namespace

void MarkFigure(FigureFormat format, std::string& bytes) {
  switch (format) {
    case FigureFormat::kSvg:
      bytes.insert(bytes.find('\n') + 1, SvgMark());
      break;
    case FigureFormat::kPng:
      assert(bytes.size() > kEndOfPngHeader);
      bytes.insert(kEndOfPngHeader, PngChunk(PngMark()));
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
