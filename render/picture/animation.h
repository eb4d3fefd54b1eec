#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "render/picture/image.h"

namespace regrasp::render {

/// File formats of animations.
enum class AnimationFormat {
  kMp4,   ///< H.264 in MP4 with halved colour resolution, for browsers and slides
  kGif,   ///< GIF with 255 colours, for programs that support no other format
  kWebp,  ///< animated WebP, displayed by browsers like an image
};

/// Return the animation format that a file's extension names.
/// @returns the format; nullopt for any other extension.
[[nodiscard]] std::optional<AnimationFormat> FindAnimationFormat(const std::filesystem::path& file);

/// Return the media type of a format, for example "video/mp4".
[[nodiscard]] std::string_view MediaType(AnimationFormat format);

/// Frames per second of animations. The duration of an image is a number of frames.
inline constexpr int kFramesPerSecond = 30;

/// An animation that is being written: a sequence of images with a duration each.
///
/// Deterministic: the same images give the same bytes. WebP and GIF files repeat forever.
class Animation {
 public:
  virtual ~Animation() = default;

  /// Append an image.
  /// @param frames  display time of the image, frames, ≥ 1.
  /// @throws std::invalid_argument  if the size differs from that of the first image, or if the
  ///                                duration is invalid.
  virtual void Add(const Image& image, int frames) = 0;

  /// Return the bytes of the file and end the animation. Nothing can be added afterwards.
  /// @pre  at least one image was added.
  [[nodiscard]] virtual std::string Finish() = 0;
};

/// Start an animation.
/// @param width, height  size of all images, pixels. An MP4 pads an odd side by one pixel.
/// @param examples       images that contain the colours of all frames. A GIF chooses its palette
///                       from them; other formats ignore them.
/// @throws std::invalid_argument  if the format does not support the size, or if a GIF has no
///                                example.
/// @throws EnvironmentError       if the ffmpeg libraries have no encoder for the format.
[[nodiscard]] std::unique_ptr<Animation> MakeAnimation(AnimationFormat format, int width,
                                                       int height, std::span<const Image> examples);

/// Encode an image as a lossy WebP file, about a tenth of the size of a PNG file.
/// @param width  maximum width, pixels. Wider images are scaled down.
/// @throws std::invalid_argument  if the image is empty, if a side exceeds the 16383 pixels that
///                                WebP supports, or if width < 1.
[[nodiscard]] std::string EncodeWebp(const Image& image, int width);

/// Start an animated, lossy WebP file.
/// @throws std::invalid_argument  if WebP does not support the size.
[[nodiscard]] std::unique_ptr<Animation> MakeWebpAnimation(int width, int height);

/// Start an MP4 file with H.264 video, kFramesPerSecond, using the ffmpeg libraries.
/// @throws std::invalid_argument  if the size is not supported.
/// @throws EnvironmentError       if libavcodec has no libx264.
[[nodiscard]] std::unique_ptr<Animation> MakeMp4(int width, int height);

/// Number of colours in a GIF palette. The 256th entry marks pixels that do not change.
inline constexpr int kGifColors = 255;

/// Start a GIF with one palette for all frames, using the ffmpeg libraries.
///
/// Each pixel gets the nearest palette colour, without dithering. Times are rounded to 10 ms.
/// @param colors  palette of 1 to kGifColors colours.
/// @throws std::invalid_argument  if the size or the number of colours is not supported.
[[nodiscard]] std::unique_ptr<Animation> MakeGif(int width, int height,
                                                 const std::vector<Color>& colors);

/// Choose at most `count` colours that represent all colours of the images.
///
/// Repeatedly splits the box of colours that has the largest squared error. The split is at the
/// mean of the channel with the largest spread (Wan, Wong, Prusinkiewicz 1988). Each colour has the
/// square root of its number of pixels as weight. Thin lines therefore keep their colour in front
/// of a large background, and a colour that is alone in its box is exact. Deterministic.
/// @throws std::invalid_argument  if no image has a pixel, or if count < 1.
[[nodiscard]] std::vector<Color> ChooseColors(std::span<const Image> images, int count);

/// A palette with a search for the nearest colour.
class ColorTable {
 public:
  /// Create a palette.
  /// @param colors  1 to 256 colours.
  explicit ColorTable(std::vector<Color> colors);

  /// Return the index of the colour with the smallest squared RGB distance; the first one on ties.
  [[nodiscard]] std::uint8_t Nearest(Color color);

  [[nodiscard]] const std::vector<Color>& colors() const { return colors_; }

 private:
  std::vector<Color> colors_;
  std::unordered_map<std::uint32_t, std::uint8_t> known_;
};

}  // namespace regrasp::render
