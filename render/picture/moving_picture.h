#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "render/picture/image.h"

namespace regrasp::render {

/// The files that moving pictures are written as.
enum class MovingFormat {
  kMp4,   ///< H.264 with halved colour resolution, as browsers and slides play it
  kGif,   ///< 255 colours, for whatever plays nothing else
  kWebp,  ///< animated WebP, which browsers show as an image
};

/// By the ending of the file's name; none for another ending.
[[nodiscard]] std::optional<MovingFormat> MovingFormatOf(const std::filesystem::path& file);

/// As web pages name it, "video/mp4".
[[nodiscard]] std::string_view MediaType(MovingFormat format);

/// Durations are multiples of this: pictures come 20 a second.
inline constexpr int kTick_ms = 50;

/// A moving picture in the making: images one after the other, each for its time.
///
/// Same images, same bytes. WebP and GIF repeat for ever.
class MovingPicture {
 public:
  virtual ~MovingPicture() = default;

  /// @param duration_ms  how long the image is shown, a positive multiple of kTick_ms.
  /// @throws std::invalid_argument  another size than the first one's, or no such duration.
  virtual void Add(const Image& image, int duration_ms) = 0;

  /// The bytes of the file; nothing can be added any more.
  /// @pre  an image was added.
  [[nodiscard]] virtual std::string Finish() = 0;
};

/// @param width, height  of all images. Those of an MP4 are even: a side that is odd is a pixel
///                       longer.
/// @param examples       images that have the colours of all others, of which a GIF chooses its
///                       own; other formats need none.
/// @throws std::invalid_argument  a size that the format cannot have, or a GIF without example.
/// @throws EnvironmentError       the libraries of ffmpeg have no encoder for it.
[[nodiscard]] std::unique_ptr<MovingPicture> MakeMovingPicture(MovingFormat format, int width,
                                                               int height,
                                                               std::span<const Image> examples);

/// An image as a WebP file, lossy: a tenth of the bytes of a PNG, for pages and mail.
/// @param width  the image is scaled down to this many pixels where it is wider.
/// @throws std::invalid_argument  the image is empty or wider or higher than WebP can hold (16383),
///                                or width < 1.
[[nodiscard]] std::string EncodeWebp(const Image& image, int width);

/// An animated WebP, lossy.
/// @throws std::invalid_argument  a size that WebP cannot hold.
[[nodiscard]] std::unique_ptr<MovingPicture> MakeWebpAnimation(int width, int height);

}  // namespace regrasp::render
