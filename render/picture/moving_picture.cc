#include "render/picture/moving_picture.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>
#include <stdexcept>

#include "render/picture/color_table.h"
#include "render/picture/video.h"

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

namespace {

/// Of 100: thin edges and small numbers stay sharp.
constexpr float kQuality = 82;
constexpr int kWebpBytesPerPixel = 3;
/// After so many pictures one stands whole. Others hold what changed by more than a few levels
/// since the one before; without it slow shading would never come right.
constexpr int kKeyPictures = 10;

WebPConfig MakeConfig() {
  WebPConfig config;
  const bool good = WebPConfigPreset(&config, WEBP_PRESET_DRAWING, kQuality) != 0;
  assert(good && "libwebp of another version than its header");
  static_cast<void>(good);
  return config;
}

void CheckSize(int width, int height) {
  if (width < 1 || height < 1 || width > WEBP_MAX_DIMENSION || height > WEBP_MAX_DIMENSION) {
    throw std::invalid_argument("WebP: an image of a size that it cannot hold");
  }
}

/// What fails although sizes are right is out of memory.
void RequireWebp(bool good) {
  if (!good) throw std::bad_alloc();
}

/// A WebPPicture that frees itself.
class Picture {
 public:
  explicit Picture(const Image& image) {
    const bool good = WebPPictureInit(&picture_) != 0;
    assert(good && "libwebp of another version than its header");
    static_cast<void>(good);
    picture_.use_argb = 1;  // scaled and cut into frames in RGB
    picture_.width = image.width;
    picture_.height = image.height;
    RequireWebp(
        WebPPictureImportRGB(&picture_, image.rgb.data(), kWebpBytesPerPixel * image.width) != 0);
  }
  ~Picture() { WebPPictureFree(&picture_); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  [[nodiscard]] WebPPicture* get() { return &picture_; }

 private:
  WebPPicture picture_;
};

class WebpAnimation : public MovingPicture {
 public:
  WebpAnimation(int width, int height) : width_(width), height_(height), config_(MakeConfig()) {
    CheckSize(width, height);
    WebPAnimEncoderOptions options;
    const bool good = WebPAnimEncoderOptionsInit(&options) != 0;
    assert(good && "libwebpmux of another version than its header");
    static_cast<void>(good);
    options.kmin = kKeyPictures / 2 + 1;
    options.kmax = kKeyPictures;
    encoder_ = WebPAnimEncoderNew(width, height, &options);
    RequireWebp(encoder_ != nullptr);
  }
  ~WebpAnimation() override { WebPAnimEncoderDelete(encoder_); }
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;

  void Add(const Image& image, int duration_ms) override {
    if (image.width != width_ || image.height != height_ || duration_ms < 1) {
      throw std::invalid_argument("WebpAnimation: an image of another size, or no duration");
    }
    Picture picture(image);
    RequireWebp(WebPAnimEncoderAdd(encoder_, picture.get(), time_ms_, &config_) != 0);
    time_ms_ += duration_ms;
  }

  std::string Finish() override {
    assert(time_ms_ > 0);
    // A null picture says when the last one ends.
    RequireWebp(WebPAnimEncoderAdd(encoder_, nullptr, time_ms_, nullptr) != 0);
    WebPData data;
    WebPDataInit(&data);
    const bool good = WebPAnimEncoderAssemble(encoder_, &data) != 0;
    const std::string bytes(reinterpret_cast<const char*>(data.bytes), good ? data.size : 0);
    WebPDataClear(&data);
    RequireWebp(good);
    return bytes;
  }

 private:
  int width_, height_;
  WebPConfig config_;
  WebPAnimEncoder* encoder_ = nullptr;
  int time_ms_ = 0;
};

}  // namespace

std::string EncodeWebp(const Image& image, int width) {
  CheckSize(image.width, image.height);
  if (width < 1) throw std::invalid_argument("EncodeWebp: no width");
  Picture picture(image);
  if (width < image.width) {
    const double height = std::round(static_cast<double>(image.height) * width / image.width);
    RequireWebp(WebPPictureRescale(picture.get(), width, std::max(1, static_cast<int>(height))) !=
                0);
  }
  WebPConfig config = MakeConfig();
  config.use_sharp_yuv = 1;  // thin coloured lines keep their colour
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.get()->writer = WebPMemoryWrite;
  picture.get()->custom_ptr = &writer;
  const bool good = WebPEncode(&config, picture.get()) != 0;
  const std::string bytes(reinterpret_cast<const char*>(writer.mem), good ? writer.size : 0);
  WebPMemoryWriterClear(&writer);
  RequireWebp(good);
  return bytes;
}

std::unique_ptr<MovingPicture> MakeWebpAnimation(int width, int height) {
  return std::make_unique<WebpAnimation>(width, height);
}

}  // namespace regrasp::render
