#pragma once

#include <cairo.h>

#include <cstdint>
#include <memory>

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
  struct SurfaceDeleter {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  };
  struct ContextDeleter {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };

  [[nodiscard]] std::uint32_t* Row(int y) const;

  int width_, height_;
  std::unique_ptr<cairo_surface_t, SurfaceDeleter> surface_;
  std::unique_ptr<cairo_t, ContextDeleter> context_;
};

}  // namespace regrasp::render
