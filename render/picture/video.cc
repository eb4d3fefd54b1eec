#include "render/picture/animation.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>

#include "planner/base/error.h"
#include "planner/base/shared_library.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

constexpr int kBytesPerPixel = 3;
constexpr int kLongestSide = 16384;  ///< maximum side that both formats support, pixels

/// Rate factor of libx264, 0 to 51: thin lines and small digits stay sharp.
constexpr char kRateFactor[] = "18";
/// Frames between two key frames: players can seek to every second second.
constexpr int kFramesBetweenKeys = 40;

/// Time unit of GIF.
constexpr int kGifTicksPerSecond = 100;

/// Functions of the ffmpeg libraries that are used, by library.
// clang-format off
#define REGRASP_AVCODEC_FUNCTIONS(F) \
  F(av_packet_alloc) F(av_packet_free) F(av_packet_rescale_ts) F(avcodec_alloc_context3) \
  F(avcodec_find_encoder) F(avcodec_find_encoder_by_name) F(avcodec_free_context) \
  F(avcodec_open2) F(avcodec_parameters_from_context) F(avcodec_receive_packet) \
  F(avcodec_send_frame)
#define REGRASP_AVFORMAT_FUNCTIONS(F) \
  F(av_interleaved_write_frame) F(av_write_trailer) F(avformat_alloc_output_context2) \
  F(avformat_free_context) F(avformat_new_stream) F(avformat_write_header) F(avio_alloc_context) \
  F(avio_close_dyn_buf) F(avio_context_free) F(avio_get_dyn_buf) F(avio_open_dyn_buf)
#define REGRASP_AVUTIL_FUNCTIONS(F) \
  F(av_frame_alloc) F(av_frame_free) F(av_frame_get_buffer) F(av_frame_make_writable) F(av_free) \
  F(av_log_set_level) F(av_memdup) F(av_opt_set) F(av_opt_set_int) F(av_strerror)
// clang-format on

/// Functions of the ffmpeg libraries, loaded at the first call of ffmpeg().
struct Ffmpeg {
#define REGRASP_AV_MEMBER(name) decltype(&::name) name = nullptr;
  REGRASP_AVCODEC_FUNCTIONS(REGRASP_AV_MEMBER)
  REGRASP_AVFORMAT_FUNCTIONS(REGRASP_AV_MEMBER)
  REGRASP_AVUTIL_FUNCTIONS(REGRASP_AV_MEMBER)
#undef REGRASP_AV_MEMBER
};

/// Load an ffmpeg library in the version of the headers.
SharedLibrary LibraryOf(const char* name, int version) {
  return SharedLibrary({"lib" + std::string(name) + ".so." + std::to_string(version)});
}

Ffmpeg LoadFfmpeg() {
  const SharedLibrary codec = LibraryOf("avcodec", LIBAVCODEC_VERSION_MAJOR);
  const SharedLibrary format = LibraryOf("avformat", LIBAVFORMAT_VERSION_MAJOR);
  const SharedLibrary util = LibraryOf("avutil", LIBAVUTIL_VERSION_MAJOR);
  Ffmpeg functions;
#define REGRASP_AV_FIND_CODEC(name) codec.Find(#name, functions.name);
#define REGRASP_AV_FIND_FORMAT(name) format.Find(#name, functions.name);
#define REGRASP_AV_FIND_UTIL(name) util.Find(#name, functions.name);
  REGRASP_AVCODEC_FUNCTIONS(REGRASP_AV_FIND_CODEC)
  REGRASP_AVFORMAT_FUNCTIONS(REGRASP_AV_FIND_FORMAT)
  REGRASP_AVUTIL_FUNCTIONS(REGRASP_AV_FIND_UTIL)
#undef REGRASP_AV_FIND_CODEC
#undef REGRASP_AV_FIND_FORMAT
#undef REGRASP_AV_FIND_UTIL
  return functions;
}

const Ffmpeg& ffmpeg() {
  static const Ffmpeg functions = LoadFfmpeg();
  return functions;
}

/// Return the result of an ffmpeg call, or throw if it is an error code.
int Require(int result) {
  if (result >= 0) return result;
  if (result == AVERROR(ENOMEM)) throw std::bad_alloc();
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text = {};
  ffmpeg().av_strerror(result, text.data(), text.size());
  throw EnvironmentError("ffmpeg: " + std::string(text.data()));
}

template <class T>
T* RequireMemory(T* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

template <auto free>
struct Free {
  template <class T>
  void operator()(T* pointer) const {
    (ffmpeg().*free)(&pointer);
  }
};
using Codec = std::unique_ptr<AVCodecContext, Free<&Ffmpeg::avcodec_free_context>>;
using Frame = std::unique_ptr<AVFrame, Free<&Ffmpeg::av_frame_free>>;
using Packet = std::unique_ptr<AVPacket, Free<&Ffmpeg::av_packet_free>>;

/// A muxer that writes into memory.
class Muxer {
 public:
  explicit Muxer(const char* format) {
    Require(ffmpeg().avformat_alloc_output_context2(&context_, nullptr, format, nullptr));
    context_->flags |= AVFMT_FLAG_BITEXACT;
    context_->io_open = &OpenWritten;
    context_->io_close2 = &Close;
  }
  ~Muxer() {
    TakeBytes();
    ffmpeg().avformat_free_context(context_);
  }
  Muxer(const Muxer&) = delete;
  Muxer& operator=(const Muxer&) = delete;

  void Begin(const AVCodecContext& codec) {
    AVStream* stream = RequireMemory(ffmpeg().avformat_new_stream(context_, nullptr));
    stream->time_base = codec.time_base;
    stream->avg_frame_rate = codec.framerate;
    Require(ffmpeg().avcodec_parameters_from_context(stream->codecpar, &codec));
    Require(ffmpeg().avio_open_dyn_buf(&context_->pb));
    Require(ffmpeg().avformat_write_header(context_, nullptr));
  }
  void Write(AVPacket& packet, AVRational time_base) {
    ffmpeg().av_packet_rescale_ts(&packet, time_base, context_->streams[0]->time_base);
    Require(ffmpeg().av_interleaved_write_frame(context_, &packet));
  }
  std::string Finish() {
    Require(ffmpeg().av_write_trailer(context_));
    return TakeBytes();
  }
  [[nodiscard]] AVFormatContext& context() { return *context_; }

 private:
  /// Open the bytes written so far for reading while writing continues. The MP4 muxer needs this to
  /// move its index.
  static int OpenWritten(AVFormatContext* context, AVIOContext** io, const char* /*url*/,
                         int /*flags*/, AVDictionary** /*options*/) {
    std::uint8_t* written = nullptr;
    const int size = ffmpeg().avio_get_dyn_buf(context->pb, &written);
    auto* bytes = static_cast<std::uint8_t*>(ffmpeg().av_memdup(written, size));
    if (bytes == nullptr) return AVERROR(ENOMEM);
    // Without a read function the context reads only this buffer.
    *io = ffmpeg().avio_alloc_context(bytes, size, 0, nullptr, nullptr, nullptr, nullptr);
    if (*io == nullptr) {
      ffmpeg().av_free(bytes);
      return AVERROR(ENOMEM);
    }
    return 0;
  }
  static int Close(AVFormatContext* /*context*/, AVIOContext* io) {
    ffmpeg().av_free(io->buffer);
    ffmpeg().avio_context_free(&io);
    return 0;
  }

  std::string TakeBytes() {
    if (context_->pb == nullptr) return "";
    std::uint8_t* bytes = nullptr;
    const int size = ffmpeg().avio_get_dyn_buf(context_->pb, &bytes);
    std::string text(reinterpret_cast<const char*>(bytes), size);
    // avio_close_dyn_buf truncates at the last write position, which is not the end of an MP4.
    ffmpeg().avio_close_dyn_buf(context_->pb, &bytes);
    context_->pb = nullptr;
    ffmpeg().av_free(bytes);
    return text;
  }

  AVFormatContext* context_ = nullptr;
};

/// An encoder of libavcodec with its muxer. Uses one thread, so that bytes are the same everywhere.
class Encoder {
 public:
  struct Settings {
    const char* format;
    const AVCodec* codec;
    AVPixelFormat pixels;
    int width, height;
    int ticks_per_second;  ///< inverse of the time unit
    /// Whether an MP4 has its index at the start, so that a player can start before the whole file
    /// is loaded.
    bool index_first = false;
    /// Private options of the codec.
    std::vector<std::pair<const char*, const char*>> options = {};
  };

  explicit Encoder(const Settings& settings)
      : muxer_(settings.format),
        codec_(RequireMemory(ffmpeg().avcodec_alloc_context3(settings.codec))),
        frame_(RequireMemory(ffmpeg().av_frame_alloc())),
        packet_(RequireMemory(ffmpeg().av_packet_alloc())) {
    codec_->width = settings.width;
    codec_->height = settings.height;
    codec_->pix_fmt = settings.pixels;
    codec_->time_base = {1, settings.ticks_per_second};
    codec_->framerate = av_inv_q(codec_->time_base);
    codec_->gop_size = kFramesBetweenKeys;
    codec_->thread_count = 1;
    codec_->flags |= AV_CODEC_FLAG_BITEXACT;
    if ((muxer_.context().oformat->flags & AVFMT_GLOBALHEADER) != 0) {
      codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    if (settings.pixels == AV_PIX_FMT_YUV420P) SetColors();
    for (const auto& [name, value] : settings.options) {
      Require(ffmpeg().av_opt_set(codec_->priv_data, name, value, 0));
    }
    Require(ffmpeg().avcodec_open2(codec_.get(), settings.codec, nullptr));
    if (settings.index_first) {
      Require(ffmpeg().av_opt_set(muxer_.context().priv_data, "movflags", "+faststart", 0));
    }
    muxer_.Begin(*codec_);
    frame_->width = settings.width;
    frame_->height = settings.height;
    frame_->format = settings.pixels;
    Require(ffmpeg().av_frame_get_buffer(frame_.get(), 0));
  }

  /// Return the frame that is encoded next, writable.
  AVFrame& NextFrame() {
    Require(ffmpeg().av_frame_make_writable(frame_.get()));
    return *frame_;
  }
  /// Encode the frame with display time `time`, ticks.
  void Encode(std::int64_t time) {
    frame_->pts = time;
    Send(frame_.get());
  }
  std::string Finish() {
    Send(nullptr);
    return muxer_.Finish();
  }
  [[nodiscard]] Muxer& muxer() { return muxer_; }

 private:
  /// Set the colour space that Convert uses.
  void SetColors() {
    codec_->color_range = AVCOL_RANGE_MPEG;
    codec_->colorspace = AVCOL_SPC_BT709;
    codec_->color_primaries = AVCOL_PRI_BT709;
    codec_->color_trc = AVCOL_TRC_BT709;
  }
  void Send(const AVFrame* frame) {
    Require(ffmpeg().avcodec_send_frame(codec_.get(), frame));
    for (;;) {
      const int result = ffmpeg().avcodec_receive_packet(codec_.get(), packet_.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
      Require(result);
      packet_->duration = 1;
      muxer_.Write(*packet_, codec_->time_base);
    }
  }

  Muxer muxer_;
  Codec codec_;
  Frame frame_;
  Packet packet_;
};

int Even(int side) { return side + side % 2; }

/// Factors of red, green and blue times 2^kFractionBits.
using Factors = std::array<int, kBytesPerPixel>;
constexpr int kFractionBits = 16;

constexpr Factors FactorsOf(double red, double green, double blue) {
  constexpr double kScale = 1 << kFractionBits;
  Factors factors = {};
  const double values[] = {red, green, blue};
  for (int i = 0; i < kBytesPerPixel; ++i) {
    factors[i] = static_cast<int>(kScale * values[i] + (values[i] < 0 ? -0.5 : 0.5));
  }
  return factors;
}

// Y'CbCr of ITU-R BT.709 from channels of 0 to 255, in the limited range.
constexpr double kRedLuma = 0.2126, kGreenLuma = 0.7152, kBlueLuma = 0.0722;
constexpr double kLumaRange = 219.0 / 255, kChromaRange = 224.0 / 255 / 2;
constexpr int kBlackLuma = 16, kGreyChroma = 128;
constexpr Factors kLumaFactors =
    FactorsOf(kLumaRange * kRedLuma, kLumaRange* kGreenLuma, kLumaRange* kBlueLuma);
constexpr double kBlueRange = kChromaRange / (1 - kBlueLuma);
constexpr Factors kBlueFactors =
    FactorsOf(-kBlueRange * kRedLuma, -kBlueRange* kGreenLuma, kChromaRange);
constexpr double kRedRange = kChromaRange / (1 - kRedLuma);
constexpr Factors kRedFactors =
    FactorsOf(kChromaRange, -kRedRange* kGreenLuma, -kRedRange* kBlueLuma);

/// Return zero + the linear combination of sums of 2^bits channel values, rounded.
std::uint8_t Combined(const Factors& factors, const std::array<int, kBytesPerPixel>& sums, int bits,
                      int zero) {
  const int shift = kFractionBits + bits;
  int value = (zero << shift) + (1 << (shift - 1));
  for (int c = 0; c < kBytesPerPixel; ++c) value += factors[c] * sums[c];
  return static_cast<std::uint8_t>(value >> shift);
}

/// Fill a frame with Y'CbCr (BT.709, limited range), with one chroma value per 2 × 2 pixels. Border
/// pixels are repeated outside the image.
void Convert(const Image& image, AVFrame& frame) {
  const auto row_of = [&](int y) {
    return image.rgb.data() +
           std::ptrdiff_t{kBytesPerPixel} * image.width * std::min(y, image.height - 1);
  };
  const auto out_of = [&](int plane, int y) {
    return frame.data[plane] + std::ptrdiff_t{frame.linesize[plane]} * y;
  };
  const auto at = [&](int x) { return kBytesPerPixel * std::min(x, image.width - 1); };
  for (int y = 0; y < frame.height; ++y) {
    const unsigned char* in = row_of(y);
    std::uint8_t* out = out_of(0, y);
    for (int x = 0; x < frame.width; ++x) {
      const unsigned char* rgb = in + at(x);
      out[x] = Combined(kLumaFactors, {rgb[0], rgb[1], rgb[2]}, 0, kBlackLuma);
    }
  }
  for (int y = 0; y < frame.height / 2; ++y) {
    const unsigned char *upper = row_of(2 * y), *lower = row_of(2 * y + 1);
    std::uint8_t *blue = out_of(1, y), *red = out_of(2, y);
    for (int x = 0; x < frame.width / 2; ++x) {
      const int left = at(2 * x), right = at(2 * x + 1);
      std::array<int, kBytesPerPixel> sums;
      for (int c = 0; c < kBytesPerPixel; ++c) {
        sums[c] = upper[left + c] + upper[right + c] + lower[left + c] + lower[right + c];
      }
      blue[x] = Combined(kBlueFactors, sums, 2, kGreyChroma);
      red[x] = Combined(kRedFactors, sums, 2, kGreyChroma);
    }
  }
}

/// Common part of MP4 and GIF: checks sizes and adds up durations.
class Video : public Animation {
 public:
  Video(int width, int height) : width_(width), height_(height) {
    if (width < 1 || height < 1 || width > kLongestSide || height > kLongestSide) {
      throw std::invalid_argument("video: image size not supported");
    }
    ffmpeg().av_log_set_level(AV_LOG_QUIET);  // a library must not print
  }

  void Add(const Image& image, int frames) final {
    if (image.width != width_ || image.height != height_ || frames < 1) {
      throw std::invalid_argument("video: images must have one size and a supported duration");
    }
    AddImage(image, frames);
    begin_ += frames;
  }

 protected:
  virtual void AddImage(const Image& image, int frames) = 0;
  /// Start time of the next image, frames.
  [[nodiscard]] int begin() const { return begin_; }

 private:
  int width_, height_;
  int begin_ = 0;
};

const AVCodec* FindX264() {
  const AVCodec* codec = ffmpeg().avcodec_find_encoder_by_name("libx264");
  if (codec == nullptr) {
    throw EnvironmentError(
        "H.264 encoder (libx264) not found in libavcodec; help: write .webp or .gif");
  }
  return codec;
}

class Mp4 : public Video {
 public:
  Mp4(int width, int height)
      : Video(width, height),
        encoder_({"mp4",
                  FindX264(),
                  AV_PIX_FMT_YUV420P,
                  Even(width),
                  Even(height),
                  kFramesPerSecond,
                  /*index_first=*/true,
                  // "mbtree" uses floating-point estimates that depend on the processor.
                  {{"preset", "faster"},
                   {"tune", "animation"},
                   {"mbtree", "0"},
                   // Half of the time of the encoder, without a smaller file.
                   {"x264-params", "trellis=0"},
                   {"crf", kRateFactor}}}) {}

  std::string Finish() override { return encoder_.Finish(); }

 private:
  /// Encode an image once per frame. Repetitions need few bytes, and programs for slides and
  /// editing expect a constant frame rate.
  void AddImage(const Image& image, int frames) override {
    Convert(image, encoder_.NextFrame());
    for (int i = 0; i < frames; ++i) encoder_.Encode(begin() + i);
  }

  Encoder encoder_;
};

class Gif : public Video {
 public:
  Gif(int width, int height, const std::vector<Color>& colors)
      : Video(width, height),
        colors_(colors),
        encoder_({"gif", ffmpeg().avcodec_find_encoder(AV_CODEC_ID_GIF), AV_PIX_FMT_PAL8, width,
                  height, kGifTicksPerSecond}) {}

  std::string Finish() override {
    Require(ffmpeg().av_opt_set_int(encoder_.muxer().context().priv_data, "final_delay",
                                    Ticks(begin()) - Ticks(last_begin_), 0));
    return encoder_.Finish();
  }

 private:
  void AddImage(const Image& image, int /*frames*/) override {
    AVFrame& frame = encoder_.NextFrame();
    SetPalette(reinterpret_cast<std::uint32_t*>(frame.data[1]));
    const unsigned char* in = image.rgb.data();
    for (int y = 0; y < image.height; ++y) {
      std::uint8_t* out = frame.data[0] + std::ptrdiff_t{frame.linesize[0]} * y;
      for (int x = 0; x < image.width; ++x, in += kBytesPerPixel) {
        out[x] = colors_.Nearest({in[0], in[1], in[2]});
      }
    }
    encoder_.Encode(Ticks(begin()));
    last_begin_ = begin();
  }
  [[nodiscard]] static int Ticks(int frames) {
    return frames * kGifTicksPerSecond / kFramesPerSecond;
  }
  /// Write the ARGB palette. Unused entries are transparent and mark pixels that do not change.
  void SetPalette(std::uint32_t* argb) const {
    std::fill_n(argb, AVPALETTE_COUNT, 0);
    std::ranges::transform(colors_.colors(), argb, [](Color color) {
      return 0xff000000U | (color.r << 16) | (color.g << 8) | color.b;
    });
  }

  ColorTable colors_;
  Encoder encoder_;
  int last_begin_ = 0;
};

}  // namespace

std::unique_ptr<Animation> MakeMp4(int width, int height) {
  return std::make_unique<Mp4>(width, height);
}

std::unique_ptr<Animation> MakeGif(int width, int height, const std::vector<Color>& colors) {
  if (colors.empty() || colors.size() > kGifColors) {
    throw std::invalid_argument("MakeGif: number of colours not supported");
  }
  return std::make_unique<Gif>(width, height, colors);
}

}  // namespace regrasp::render
