#pragma once

#include <memory>
#include <string>

#include "render/picture/image.h"

namespace regrasp::render {

/// An image as a WebP file, lossy: a tenth of the bytes of a PNG, for pages and mail.
/// @param width  the image is scaled down to this many pixels where it is wider.
/// @throws std::invalid_argument  the image is empty or wider or higher than WebP can hold (16383),
///                                or width < 1.
[[nodiscard]] std::string EncodeWebp(const Image& image, int width);

/// Builds a moving picture as an animated WebP file, lossy, that repeats for ever.
///
/// Same images, same bytes.
class WebpAnimation {
 public:
  /// @throws std::invalid_argument  a size that WebP cannot hold.
  WebpAnimation(int width, int height);
  ~WebpAnimation();
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;

  /// @param duration_ms  how long the image is shown, > 0.
  /// @throws std::invalid_argument  another size than that of the animation, or no duration.
  void Add(const Image& image, int duration_ms);

  /// The bytes of the file; nothing can be added any more.
  /// @pre  an image was added.
  [[nodiscard]] std::string Finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::render
