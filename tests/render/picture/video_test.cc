#include "render/picture/animation.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace regrasp::render {
namespace video_test {

constexpr Color kTeal = {61, 179, 158};
constexpr Color kRed = {214, 16, 32};

Image MakeFlat(int width, int height, Color color) {
  Image image = MakeImage(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    image.rgb[i] = color.r;
    image.rgb[i + 1] = color.g;
    image.rgb[i + 2] = color.b;
  }
  return image;
}

/// Return a white image with a red column at `x`, two pixels wide.
Image MakeLine(int width, int height, int x) {
  Image image = MakeImage(width, height);
  for (int y = 0; y < height; ++y) {
    for (int i = x; i < x + 2; ++i) {
      unsigned char* rgb = image.rgb.data() + 3 * (y * width + i);
      rgb[0] = kRed.r;
      rgb[1] = kRed.g;
      rgb[2] = kRed.b;
    }
  }
  return image;
}

struct Shown {
  Image image;
  int begin_ms, duration_ms;
};

/// The read position in the bytes of a file.
struct Source {
  const std::string& bytes;
  std::size_t at = 0;
};

int ReadSource(void* opaque, std::uint8_t* out, int size) {
  auto& source = *static_cast<Source*>(opaque);
  const std::size_t count = std::min<std::size_t>(size, source.bytes.size() - source.at);
  if (count == 0) return AVERROR_EOF;
  std::memcpy(out, source.bytes.data() + source.at, count);
  source.at += count;
  return static_cast<int>(count);
}

std::int64_t SeekSource(void* opaque, std::int64_t offset, int whence) {
  auto& source = *static_cast<Source*>(opaque);
  if (whence == AVSEEK_SIZE) return static_cast<std::int64_t>(source.bytes.size());
  if (whence == SEEK_CUR) offset += static_cast<std::int64_t>(source.at);
  if (whence == SEEK_END) offset += static_cast<std::int64_t>(source.bytes.size());
  source.at = offset;
  return offset;
}

/// Convert the frame formats of both decoders: Y'CbCr of BT.709 in limited range, and BGRA.
Image ToImage(const AVFrame& frame) {
  Image image = MakeImage(frame.width, frame.height, 0);
  const bool bgra = frame.format == AV_PIX_FMT_BGRA;
  EXPECT_TRUE(bgra || frame.format == AV_PIX_FMT_YUV420P);
  EXPECT_TRUE(bgra || frame.colorspace == AVCOL_SPC_BT709);
  const auto at = [&frame](int plane, int x, int y) {
    return static_cast<double>(frame.data[plane][frame.linesize[plane] * y + x]);
  };
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      std::array<double, 3> rgb = {};
      for (int c = 0; bgra && c < 3; ++c) rgb[c] = at(0, 4 * x + 2 - c, y);
      if (!bgra) {
        const double luma = 255 * (at(0, x, y) - 16) / 219;
        rgb[2] = luma + 1.8556 * 255 * (at(1, x / 2, y / 2) - 128) / 224;
        rgb[0] = luma + 1.5748 * 255 * (at(2, x / 2, y / 2) - 128) / 224;
        rgb[1] = (luma - 0.2126 * rgb[0] - 0.0722 * rgb[2]) / 0.7152;
      }
      for (int c = 0; c < 3; ++c) {
        image.rgb[3 * (y * frame.width + x) + c] =
            static_cast<unsigned char>(std::clamp(std::lround(rgb[c]), 0L, 255L));
      }
    }
  }
  return image;
}

std::vector<Shown> Decode(const std::string& bytes) {
  constexpr int kBuffer = 4096;
  Source source = {bytes};
  auto* buffer = static_cast<std::uint8_t*>(av_malloc(kBuffer));
  AVIOContext* io =
      avio_alloc_context(buffer, kBuffer, 0, &source, &ReadSource, nullptr, &SeekSource);
  AVFormatContext* demuxer = avformat_alloc_context();
  demuxer->pb = io;
  EXPECT_EQ(avformat_open_input(&demuxer, nullptr, nullptr, nullptr), 0);
  EXPECT_EQ(demuxer->nb_streams, 1u);
  const AVStream& stream = *demuxer->streams[0];
  AVCodecContext* codec = avcodec_alloc_context3(avcodec_find_decoder(stream.codecpar->codec_id));
  avcodec_parameters_to_context(codec, stream.codecpar);
  EXPECT_EQ(avcodec_open2(codec, nullptr, nullptr), 0);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  std::vector<Shown> shown;
  const auto ms = [&](std::int64_t time) {
    return static_cast<int>(av_rescale_q(time, stream.time_base, {1, 1000}));
  };
  const auto drain = [&](const AVPacket* sent) {
    avcodec_send_packet(codec, sent);
    while (avcodec_receive_frame(codec, frame) == 0) {
      shown.push_back({ToImage(*frame), ms(frame->pts), ms(frame->pkt_duration)});
    }
  };
  while (av_read_frame(demuxer, packet) == 0) {
    drain(packet);
    av_packet_unref(packet);
  }
  drain(nullptr);
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&codec);
  avformat_close_input(&demuxer);
  av_free(io->buffer);
  avio_context_free(&io);
  return shown;
}

/// Return the maximum difference of a pixel's channels from a colour.
int DistanceAt(const Image& image, int x, int y, Color color) {
  const unsigned char* rgb = image.rgb.data() + 3 * (y * image.width + x);
  return std::max(
      {std::abs(rgb[0] - color.r), std::abs(rgb[1] - color.g), std::abs(rgb[2] - color.b)});
}

int RoundedMs(int frames) {
  return static_cast<int>(std::lround(1000.0 * frames / kFramesPerSecond));
}

std::vector<int> Begins(const std::vector<Shown>& shown) {
  std::vector<int> begins;
  for (const Shown& picture : shown) begins.push_back(picture.begin_ms);
  return begins;
}

TEST(VideoTest, AnMp4HasAFramePerTickAndShowsEveryImageForItsDuration) {
  const auto video = MakeMp4(64, 48);
  video->Add(MakeFlat(64, 48, kTeal), 2);
  video->Add(MakeFlat(64, 48, kRed), 10);
  const std::vector<Shown> shown = Decode(video->Finish());
  ASSERT_EQ(shown.size(), 12u);
  std::vector<int> expected(12);
  for (int i = 0; i < 12; ++i) expected[i] = RoundedMs(i);
  EXPECT_EQ(Begins(shown), expected);
  EXPECT_EQ(shown.back().duration_ms, RoundedMs(1));
  for (int i = 0; i < 12; ++i) {
    EXPECT_LE(DistanceAt(shown[i].image, 30, 20, i < 2 ? kTeal : kRed), 4) << i;
  }
}

/// Return the types of the boxes of an MP4 file.
std::vector<std::string> Boxes(const std::string& bytes) {
  std::vector<std::string> types;
  for (std::size_t at = 0; at + 8 <= bytes.size();) {
    std::size_t size = 0;
    for (int i = 0; i < 4; ++i) size = 256 * size + static_cast<unsigned char>(bytes[at + i]);
    types.push_back(bytes.substr(at + 4, 4));
    at += std::max<std::size_t>(size, 8);
    EXPECT_LE(at, bytes.size());
  }
  return types;
}

TEST(VideoTest, TheIndexOfAnMp4PrecedesItsFrames) {
  const auto video = MakeMp4(64, 48);
  video->Add(MakeFlat(64, 48, kTeal), 2);
  video->Add(MakeLine(64, 48, 20), 3);
  const std::string bytes = video->Finish();
  const std::vector<std::string> boxes = Boxes(bytes);
  const auto place = [&boxes](const char* type) { return std::ranges::find(boxes, type); };
  EXPECT_EQ(boxes.front(), "ftyp");
  EXPECT_LT(place("moov"), place("mdat"));
  EXPECT_NE(place("mdat"), boxes.end());
  // The index refers to the final positions.
  const std::vector<Shown> shown = Decode(bytes);
  ASSERT_EQ(shown.size(), 5u);
  EXPECT_LE(DistanceAt(shown[0].image, 30, 20, kTeal), 4);
  EXPECT_LE(DistanceAt(shown[4].image, 20, 20, kRed), 60);
}

TEST(VideoTest, SidesOfAnMp4AreEven) {
  const auto video = MakeMp4(49, 51);
  video->Add(MakeLine(49, 51, 47), 1);
  const std::vector<Shown> shown = Decode(video->Finish());
  ASSERT_EQ(shown.size(), 1u);
  const Image& image = shown[0].image;
  EXPECT_EQ(image.width, 50);
  EXPECT_EQ(image.height, 52);
  // The padding continues the border.
  EXPECT_LE(DistanceAt(image, 49, 51, kRed), 60);
  EXPECT_LE(DistanceAt(image, 20, 51, {255, 255, 255}), 4);
}

TEST(VideoTest, AGifHasItsColoursExactlyAndShowsEveryImageForItsTime) {
  const std::vector<Image> images = {MakeLine(61, 47, 5), MakeLine(61, 47, 40),
                                     MakeFlat(61, 47, kTeal)};
  const auto video = MakeGif(61, 47, {{255, 255, 255}, kRed, kTeal});
  const std::vector<int> durations = {3, 6, 15};
  for (int i = 0; i < 3; ++i) video->Add(images[i], durations[i]);
  const std::string bytes = video->Finish();
  EXPECT_NE(bytes.find("NETSCAPE2.0"), std::string::npos) << "it repeats";
  const std::vector<Shown> shown = Decode(bytes);
  ASSERT_EQ(shown.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(shown[i].image.rgb, images[i].rgb) << i;
    EXPECT_EQ(shown[i].duration_ms, RoundedMs(durations[i])) << i;
  }
  EXPECT_EQ(Begins(shown), (std::vector<int>{0, 100, 300}));
}

TEST(VideoTest, AGifHasTheNearestOfItsColours) {
  const auto video = MakeGif(48, 48, {{255, 255, 255}, kRed});
  video->Add(MakeFlat(48, 48, {230, 40, 40}), 1);
  const std::vector<Shown> shown = Decode(video->Finish());
  ASSERT_EQ(shown.size(), 1u);
  EXPECT_EQ(DistanceAt(shown[0].image, 10, 10, kRed), 0);
}

TEST(VideoTest, TooManyColoursForAGifAreRefused) {
  EXPECT_THROW(static_cast<void>(MakeGif(64, 48, {})), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(MakeGif(64, 48, std::vector<Color>(256))), std::invalid_argument);
}

}  // namespace video_test
}  // namespace regrasp::render
