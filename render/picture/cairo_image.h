#pragma once

#include <cairo.h>

#include <cstdint>

#include "render/picture/cairo_paint.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// An image that Cairo draws on.
class CairoImage {
 public:
  /// @throws std::runtime_error  Cairo has no memory, or the image is larger than it can hold
  ///                             (32767 pixels a side).
  explicit CairoImage(const Image& image);

  [[nodiscard]] cairo_t* context() const { return context_.get(); }
  [[nodiscard]] cairo_surface_t* surface() const { return surface_.get(); }
  [[nodiscard]] Image ToImage() const;

 private:
  [[nodiscard]] std::uint32_t* Row(int y) const;

  int width_, height_;
  CairoSurface surface_;
  CairoContext context_;
};

}  // namespace regrasp::render
