#include "render/picture/image.h"

#include <png.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::render {

Image MakeImage(int width, int height, unsigned char brightness) {
  const std::size_t bytes = std::size_t{3} * width * height;
  return {width, height, std::vector<unsigned char>(bytes, brightness)};
}

Image Shrink(const Image& image, int factor) {
  if (factor < 1 || image.width % factor != 0 || image.height % factor != 0) {
    throw std::invalid_argument("Shrink: the factor does not divide the image's sides");
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

std::string EncodePng(const Image& image) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = image.width;
  header.height = image.height;
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&header, bytes.data(), &size, /*convert_to_8bit=*/0,
                                image.rgb.data(), /*row_stride=*/0, /*colormap=*/nullptr) == 0) {
    const std::string message = header.message;
    png_image_free(&header);
    throw EnvironmentError("PNG: " + message);
  }
  bytes.resize(size);
  return bytes;
}

void WritePng(const std::filesystem::path& path, const Image& image) {
  WriteFile(path, EncodePng(image), Durability::kCached);
}

}  // namespace regrasp::render
