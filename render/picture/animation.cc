#include "render/picture/animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <new>
#include <stdexcept>
#include <utility>

#include "planner/base/file.h"
#include "render/picture/image.h"

namespace regrasp::render {

std::optional<AnimationFormat> FindAnimationFormat(const std::filesystem::path& file) {
  const std::string ending = LowerSuffix(file);
  if (ending == ".mp4") return AnimationFormat::kMp4;
  if (ending == ".gif") return AnimationFormat::kGif;
  if (ending == ".webp") return AnimationFormat::kWebp;
  return std::nullopt;
}

std::string_view MediaType(AnimationFormat format) {
  switch (format) {
    case AnimationFormat::kMp4:
      return "video/mp4";
    case AnimationFormat::kGif:
      return "image/gif";
    case AnimationFormat::kWebp:
      return "image/webp";
  }
  throw std::invalid_argument("MediaType: format not supported");
}

std::unique_ptr<Animation> MakeAnimation(AnimationFormat format, int width, int height,
                                         std::span<const Image> examples) {
  switch (format) {
    case AnimationFormat::kMp4:
      return MakeMp4(width, height);
    case AnimationFormat::kGif:
      return MakeGif(width, height, ChooseColors(examples, kGifColors));
    case AnimationFormat::kWebp:
      return MakeWebpAnimation(width, height);
  }
  throw std::invalid_argument("MakeAnimation: format not supported");
}

namespace {

/// Quality of lossy WebP, 0 to 100: thin edges and small digits stay sharp.
constexpr float kQuality = 82;
constexpr int kWebpBytesPerPixel = 3;
/// Maximum number of frames between two key frames. Other frames contain only pixels that changed
/// by more than a few levels, so slow shading would otherwise never reach its final value.
constexpr int kMaxKeyDistance = 10;

WebPConfig MakeConfig() {
  WebPConfig config;
  const bool good = WebPConfigPreset(&config, WEBP_PRESET_DRAWING, kQuality) != 0;
  assert(good && "libwebp: version differs from its header");
  static_cast<void>(good);
  return config;
}

void CheckSize(int width, int height) {
  if (width < 1 || height < 1 || width > WEBP_MAX_DIMENSION || height > WEBP_MAX_DIMENSION) {
    throw std::invalid_argument("WebP: image size not supported");
  }
}

/// Throw std::bad_alloc after a failed call. If sizes are valid, libwebp fails only for lack of
/// memory.
void RequireWebp(bool good) {
  if (!good) throw std::bad_alloc();
}

/// Owner of a WebPPicture.
class WebpImage {
 public:
  explicit WebpImage(const Image& image) {
    const bool good = WebPPictureInit(&picture_) != 0;
    assert(good && "libwebp: version differs from its header");
    static_cast<void>(good);
    picture_.use_argb = 1;  // libwebp scales and splits frames in RGB
    picture_.width = image.width;
    picture_.height = image.height;
    RequireWebp(
        WebPPictureImportRGB(&picture_, image.rgb.data(), kWebpBytesPerPixel * image.width) != 0);
  }
  ~WebpImage() { WebPPictureFree(&picture_); }
  WebpImage(const WebpImage&) = delete;
  WebpImage& operator=(const WebpImage&) = delete;

  [[nodiscard]] WebPPicture* get() { return &picture_; }

 private:
  WebPPicture picture_;
};

class WebpAnimation : public Animation {
 public:
  WebpAnimation(int width, int height) : width_(width), height_(height), config_(MakeConfig()) {
    CheckSize(width, height);
    WebPAnimEncoderOptions options;
    const bool good = WebPAnimEncoderOptionsInit(&options) != 0;
    assert(good && "libwebpmux: version differs from its header");
    static_cast<void>(good);
    options.kmin = kMaxKeyDistance - 1;  // frames in between need not be encoded twice
    options.kmax = kMaxKeyDistance;
    encoder_ = WebPAnimEncoderNew(width, height, &options);
    RequireWebp(encoder_ != nullptr);
  }
  ~WebpAnimation() override { WebPAnimEncoderDelete(encoder_); }
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;

  void Add(const Image& image, int frames) override {
    if (image.width != width_ || image.height != height_ || frames < 1) {
      throw std::invalid_argument(
          "WebpAnimation: images must have one size and a positive duration");
    }
    WebpImage webp_image(image);
    RequireWebp(WebPAnimEncoderAdd(encoder_, webp_image.get(), time_ms(), &config_) != 0);
    frames_ += frames;
  }

  std::string Finish() override {
    assert(frames_ > 0);
    // A null image marks the end of the last frame.
    RequireWebp(WebPAnimEncoderAdd(encoder_, nullptr, time_ms(), nullptr) != 0);
    WebPData data;
    WebPDataInit(&data);
    const bool good = WebPAnimEncoderAssemble(encoder_, &data) != 0;
    const std::string bytes(reinterpret_cast<const char*>(data.bytes), good ? data.size : 0);
    WebPDataClear(&data);
    RequireWebp(good);
    return bytes;
  }

 private:
  [[nodiscard]] int time_ms() const { return 1000 * frames_ / kFramesPerSecond; }

  int width_, height_;
  WebPConfig config_;
  WebPAnimEncoder* encoder_ = nullptr;
  int frames_ = 0;  ///< duration up to now
};

}  // namespace

std::string EncodeWebp(const Image& image, int width) {
  CheckSize(image.width, image.height);
  if (width < 1) throw std::invalid_argument("EncodeWebp: the width must be positive");
  WebpImage webp_image(image);
  if (width < image.width) {
    const double height = std::round(static_cast<double>(image.height) * width / image.width);
    RequireWebp(
        WebPPictureRescale(webp_image.get(), width, std::max(1, static_cast<int>(height))) != 0);
  }
  WebPConfig config = MakeConfig();
  config.use_sharp_yuv = 1;  // thin coloured lines keep their colour
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  webp_image.get()->writer = WebPMemoryWrite;
  webp_image.get()->custom_ptr = &writer;
  const bool good = WebPEncode(&config, webp_image.get()) != 0;
  const std::string bytes(reinterpret_cast<const char*>(writer.mem), good ? writer.size : 0);
  WebPMemoryWriterClear(&writer);
  RequireWebp(good);
  return bytes;
}

std::unique_ptr<Animation> MakeWebpAnimation(int width, int height) {
  return std::make_unique<WebpAnimation>(width, height);
}

namespace {

constexpr int kChannels = 3;
constexpr std::size_t kMostColors = 256;

using Channels = std::array<unsigned char, kChannels>;

struct Weighted {
  Channels color;
  double weight;
};
using Box = std::span<Weighted>;

struct Spread {
  std::array<double, kChannels> mean = {};
  int channel = 0;   ///< channel with the largest error
  double error = 0;  ///< weighted sum of squared distances from the mean in that channel
};

Spread SpreadOf(Box box) {
  Spread spread;
  double weight = 0;
  for (const Weighted& entry : box) weight += entry.weight;
  for (int c = 0; c < kChannels; ++c) {
    double sum = 0;
    for (const Weighted& entry : box) sum += entry.weight * entry.color[c];
    spread.mean[c] = sum / weight;
    double error = 0;
    for (const Weighted& entry : box) {
      error += entry.weight * std::pow(entry.color[c] - spread.mean[c], 2);
    }
    if (error <= spread.error) continue;
    spread.channel = c;
    spread.error = error;
  }
  return spread;
}

std::vector<Weighted> WeighColors(std::span<const Image> images) {
  std::map<Channels, double> counts;
  for (const Image& image : images) {
    for (std::size_t i = 0; i + kChannels <= image.rgb.size(); i += kChannels) {
      ++counts[{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]}];
    }
  }
  std::vector<Weighted> weighted;
  for (const auto& [color, count] : counts) weighted.push_back({color, std::sqrt(count)});
  return weighted;
}

Color Rounded(const std::array<double, kChannels>& mean) {
  const auto channel = [](double value) { return static_cast<unsigned char>(std::lround(value)); };
  return {channel(mean[0]), channel(mean[1]), channel(mean[2])};
}

}  // namespace

std::vector<Color> ChooseColors(std::span<const Image> images, int count) {
  std::vector<Weighted> weighted = WeighColors(images);
  if (weighted.empty() || count < 1)
    throw std::invalid_argument("ChooseColors: expected at least one colour");
  struct Node {
    Box box;
    Spread spread;
  };
  std::vector<Node> nodes = {{weighted, SpreadOf(weighted)}};
  while (static_cast<int>(nodes.size()) < count) {
    Node& node = *std::ranges::max_element(
        nodes, {}, [](const Node& candidate) { return candidate.spread.error; });
    if (node.spread.error == 0) break;
    const int channel = node.spread.channel;
    const auto upper = std::ranges::stable_partition(node.box, [&](const Weighted& entry) {
      return entry.color[channel] <= node.spread.mean[channel];
    });
    const Box lower(node.box.begin(), upper.begin());
    node = {lower, SpreadOf(lower)};
    nodes.push_back({upper, SpreadOf(upper)});
  }
  std::vector<Color> colors;
  for (const Node& node : nodes) colors.push_back(Rounded(node.spread.mean));
  return colors;
}

ColorTable::ColorTable(std::vector<Color> colors) : colors_(std::move(colors)) {
  assert(!colors_.empty() && colors_.size() <= kMostColors);
}

std::uint8_t ColorTable::Nearest(Color color) {
  const std::uint32_t key = (color.r << 16) | (color.g << 8) | color.b;
  const auto [known, is_new] = known_.try_emplace(key);
  if (!is_new) return known->second;
  const auto distance = [color](const Color& other) {
    const int r = other.r - color.r, g = other.g - color.g, b = other.b - color.b;
    return r * r + g * g + b * b;
  };
  const auto nearest = std::ranges::min_element(colors_, {}, distance);
  return known->second = static_cast<std::uint8_t>(nearest - colors_.begin());
}

}  // namespace regrasp::render
