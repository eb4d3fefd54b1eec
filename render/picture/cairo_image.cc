#include "render/picture/cairo_image.h"

#include <cstddef>
#include <stdexcept>

namespace regrasp::render {

CairoImage::CairoImage(const Image& image)
    : width_(image.width),
      height_(image.height),
      surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_, height_)),
      context_(cairo_create(surface_.get())) {
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(cairo_status_to_string(cairo_status(context_.get())));
  }
  const unsigned char* in = image.rgb.data();
  for (int y = 0; y < height_; ++y) {
    std::uint32_t* out = Row(y);
    for (int x = 0; x < width_; ++x, in += 3) {
      out[x] = std::uint32_t{in[0]} << 16 | std::uint32_t{in[1]} << 8 | in[2];
    }
  }
  cairo_surface_mark_dirty(surface_.get());
}

Image CairoImage::ToImage() const {
  cairo_surface_flush(surface_.get());
  Image image = MakeImage(width_, height_);
  unsigned char* out = image.rgb.data();
  for (int y = 0; y < height_; ++y) {
    const std::uint32_t* in = Row(y);
    for (int x = 0; x < width_; ++x) {
      for (const int shift : {16, 8, 0}) *out++ = static_cast<unsigned char>(in[x] >> shift);
    }
  }
  return image;
}

std::uint32_t* CairoImage::Row(int y) const {
  unsigned char* data = cairo_image_surface_get_data(surface_.get());
  const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface_.get());
  return reinterpret_cast<std::uint32_t*>(data + y * stride);
}

}  // namespace regrasp::render
