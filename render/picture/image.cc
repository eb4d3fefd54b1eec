#include "render/picture/image.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>

#include "planner/base/file.h"

namespace regrasp::render {

Color FingerColor(FingerIndex finger) {
  static constexpr std::array<Color, 5> kColors = {{
      {0, 101, 165},   // blue
      {240, 176, 0},   // amber
      {61, 179, 158},  // teal
      {136, 34, 85},   // wine
      {208, 88, 0},    // vermilion
  }};
  const int size = static_cast<int>(kColors.size());
  return kColors[((finger % size) + size) % size];
}

std::string PngInteger(std::uint32_t number) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

std::string PngChunk(const std::string& type, const std::string& data) {
  const std::string typed = type + data;
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(typed.data()), typed.size());
  return PngInteger(static_cast<std::uint32_t>(data.size())) + typed +
         PngInteger(static_cast<std::uint32_t>(sum));
}

Image MakeImage(int width, int height, unsigned char brightness) {
  const std::size_t bytes = std::size_t{3} * width * height;
  return {width, height, std::vector<unsigned char>(bytes, brightness)};
}

Image Shrink(const Image& image, int factor) {
  if (factor < 1 || image.width % factor != 0 || image.height % factor != 0) {
    throw std::invalid_argument("Shrink: the factor must divide the image's sides");
  }
  if (factor == 1) return image;
  Image small = MakeImage(image.width / factor, image.height / factor);
  const int row = 3 * image.width;
  const int count = factor * factor;
  std::vector<int> sums(row);
  const unsigned char* in = image.rgb.data();
  unsigned char* out = small.rgb.data();
  for (int y = 0; y < small.height; ++y) {
    std::fill(sums.begin(), sums.end(), 0);
    for (int dy = 0; dy < factor; ++dy, in += row) {
      for (int i = 0; i < row; ++i) sums[i] += in[i];
    }
    for (int x = 0; x < row; x += 3 * factor) {
      for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int dx = 0; dx < factor; ++dx) sum += sums[x + 3 * dx + channel];
        *out++ = static_cast<unsigned char>((sum + count / 2) / count);
      }
    }
  }
  return small;
}

Image MakeTransparent(Image on_white, const Image& on_black) {
  if (on_white.width != on_black.width || on_white.height != on_black.height) {
    throw std::invalid_argument("MakeTransparent: both images must have one size");
  }
  on_white.alpha.resize(on_white.rgb.size() / 3);
  for (std::size_t i = 0; i < on_white.alpha.size(); ++i) {
    // In every channel, the difference between white and black is the share of the background.
    int ground = 255;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      ground = std::min(ground, std::max(0, on_white.rgb[k] - on_black.rgb[k]));
    }
    on_white.alpha[i] = static_cast<unsigned char>(255 - ground);
  }
  return on_white;
}

namespace {

/// Return RGBA pixels, with the colours unblended from white.
std::vector<unsigned char> Interleave(const Image& image) {
  std::vector<unsigned char> rgba;
  rgba.reserve(4 * image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    const int alpha = image.alpha[i];
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const int own = alpha == 0 ? 0 : (255 * (image.rgb[k] - (255 - alpha)) + alpha / 2) / alpha;
      rgba.push_back(static_cast<unsigned char>(std::clamp(own, 0, 255)));
    }
    rgba.push_back(image.alpha[i]);
  }
  return rgba;
}

// PNG specification, 11.2.1.
constexpr char kBitDepth = 8, kRgb = 2, kRgba = 6;

/// Most pixels of a frame have the same colour. Filters double the time and do not reduce the size.
constexpr char kNoFilter = 0;
/// Lowest level with lazy matching: as small as the default 6 with filters.
constexpr int kCompressionLevel = 4;

/// Return the compressed rows of pixels of a PNG file.
std::string CompressRows(const std::vector<unsigned char>& pixels, int height) {
  const std::size_t row = pixels.size() / height;
  std::string rows;
  rows.reserve(pixels.size() + height);
  for (auto begin = pixels.begin(); begin != pixels.end();
       begin += static_cast<std::ptrdiff_t>(row)) {
    rows += kNoFilter;
    rows.append(begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  uLong size = compressBound(rows.size());
  std::string compressed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(compressed.data()), &size,
                reinterpret_cast<const Bytef*>(rows.data()), rows.size(),
                kCompressionLevel) != Z_OK) {
    throw std::bad_alloc();  // no other error is possible
  }
  compressed.resize(size);
  return compressed;
}

}  // namespace

std::string EncodePng(const Image& image) {
  const bool opaque = image.alpha.empty();
  const std::vector<unsigned char> rgba = opaque ? std::vector<unsigned char>() : Interleave(image);
  const std::vector<unsigned char>& pixels = opaque ? image.rgb : rgba;
  const std::string kind = {kBitDepth, opaque ? kRgb : kRgba, 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" +
         PngChunk("IHDR", PngInteger(image.width) + PngInteger(image.height) + kind) +
         PngChunk("IDAT", CompressRows(pixels, image.height)) + PngChunk("IEND", "");
}

void WritePng(const std::filesystem::path& path, const Image& image) {
  WriteFile(path, EncodePng(image), Durability::kCached);
}

}  // namespace regrasp::render
