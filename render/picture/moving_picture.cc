#include "render/picture/moving_picture.h"

#include <stdexcept>

#include "render/picture/color_table.h"
#include "render/picture/video.h"
#include "render/picture/webp.h"

namespace regrasp::render {

std::optional<MovingFormat> MovingFormatOf(const std::filesystem::path& file) {
  const std::filesystem::path ending = file.extension();
  if (ending == ".mp4") return MovingFormat::kMp4;
  if (ending == ".gif") return MovingFormat::kGif;
  if (ending == ".webp") return MovingFormat::kWebp;
  return std::nullopt;
}

std::string_view MediaType(MovingFormat format) {
  switch (format) {
    case MovingFormat::kMp4:
      return "video/mp4";
    case MovingFormat::kGif:
      return "image/gif";
    case MovingFormat::kWebp:
      return "image/webp";
  }
  throw std::invalid_argument("MediaType: no such format");
}

std::unique_ptr<MovingPicture> MakeMovingPicture(MovingFormat format, int width, int height,
                                                 std::span<const Image> examples) {
  switch (format) {
    case MovingFormat::kMp4:
      return MakeMp4(width, height);
    case MovingFormat::kGif:
      return MakeGif(width, height, ChooseColors(examples, kGifColors));
    case MovingFormat::kWebp:
      return MakeWebpAnimation(width, height);
  }
  throw std::invalid_argument("MakeMovingPicture: no such format");
}

}  // namespace regrasp::render
