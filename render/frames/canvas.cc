#include "render/frames/canvas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "render/frames/offscreen_context.h"
#include "render/frames/shape_painter.h"

namespace regrasp::render {

namespace {

/// Maximum number of samples per band. A frame is drawn in bands to bound its memory (64 MB).
constexpr int kMaxBandSamples = 1 << 24;

/// Weights of layers are multiples of 1 / kOne.
constexpr int kOne = 256;
constexpr int kFullAlpha = 255;

/// Reduction of a veil's opacity in the middle of a window, and width of the transition per radius.
constexpr double kWindowClearness = 0.7;
constexpr double kWindowRim = 0.55;

/// Opacity of the rims of a veil behind a solid.
constexpr double kHiddenRimOpacity = 0.35;

void ClearAll() {
  SetMask(true, true);
  gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

/// Draw the shapes together with more shapes, which are opaque. The alpha of a sample is the
/// opacity of one of these if it is visible there, and 0 otherwise.
void DrawPass(const ShapePainter& painter, const Drawing& drawing, std::span<const Shape> more) {
  ClearAll();
  SetMask(true, false);
  painter.DrawOpaque(drawing.shapes);
  SetMask(true, true);
  for (const Shape& shape : more) painter.Draw(shape);
  painter.BlendTranslucent(drawing.shapes);
  SetMask(false, false);
  for (const MeshInstance& mesh : drawing.hiding) painter.Draw(mesh);
  SetMask(true, false);
  painter.DrawOpaque(drawing.outline);
  gl().Finish();
}

/// Draw a solid alone, in front of its translucent shapes. The alpha of its samples is 1, and 0
/// elsewhere.
void DrawSolid(const ShapePainter& painter, const Solid& solid) {
  ClearAll();
  painter.BlendTranslucent(solid.shapes);
  SetMask(true, true);
  painter.DrawOpaque(solid.shapes);
}

/// Draw a solid and the shapes over it even if it hides them. The alpha of its samples is 0 at
/// opaque shapes and 1 otherwise.
void DrawXray(const ShapePainter& painter, const Drawing& drawing) {
  DrawSolid(painter, *drawing.solid);
  gl().Clear(GL_DEPTH_BUFFER_BIT);
  painter.DrawOpaque(drawing.shapes, /*alpha=*/false);
  painter.BlendTranslucent(drawing.shapes);
  gl().Finish();
}

/// Draw a solid with the shapes in front of it. The alpha of visible samples of the solid is 1, and
/// 0 elsewhere.
void DrawWithSolid(const ShapePainter& painter, const Drawing& drawing) {
  DrawSolid(painter, *drawing.solid);
  SetMask(true, true);
  painter.DrawOpaque(drawing.shapes, /*alpha=*/false);
  painter.BlendTranslucent(drawing.shapes);
  gl().Finish();
}

/// Return an opacity whose alpha is odd for a rim that shines through and even for other shapes.
double MarkedOpacity(double opacity, bool is_rim) {
  const auto alpha = static_cast<int>(std::lround(kFullAlpha * opacity));
  const bool is_odd = alpha % 2 != 0;
  const int marked = is_odd == is_rim ? alpha : alpha > 0 ? alpha - 1 : 1;
  return static_cast<double>(marked) / kFullAlpha;
}

bool IsRim(const unsigned char* sample) { return sample[3] % 2 != 0; }

/// Draw a veil alone. The alpha of its samples is their opacity, which marks rims that shine
/// through (MarkedOpacity), and 0 elsewhere.
void DrawVeil(const ShapePainter& painter, const Veil& veil) {
  ClearAll();
  SetMask(true, true);
  const auto draw = [&](Shape shape, bool is_rim) {
    shape.opacity = MarkedOpacity(shape.opacity, is_rim);
    painter.Draw(shape);
  };
  for (const Shape& shape : veil.shapes) draw(shape, false);
  // The shapes hide nearly all of the rims, which need no colours there.
  gl().DepthFunc(GL_LESS);
  for (const Shape& shape : veil.rims) draw(shape, false);
  for (const Shape& shape : veil.xray_rims) draw(shape, true);
  gl().DepthFunc(GL_LEQUAL);
  gl().Finish();
}

/// Set the alpha of a veil, which is the present image, to 0 where opaque shapes or the solid hide
/// it.
void HideVeil(const ShapePainter& painter, const Drawing& drawing) {
  SetMask(false, true);
  gl().DepthFunc(GL_LESS);
  // Surfaces with colours of their own have an alpha of 1 in any case.
  gl().BlendFunc(GL_ZERO, GL_ZERO);
  gl().Enable(GL_BLEND);
  painter.DrawOpaque(drawing.solid->shapes);
  painter.DrawOpaque(drawing.shapes);
  gl().Disable(GL_BLEND);
  gl().BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl().DepthFunc(GL_LEQUAL);
  SetMask(true, true);
  gl().Finish();
}

/// Return the weights of the image without layer and of the images with each layer. Their sum is
/// kOne.
std::vector<int> WeightsOf(const std::vector<Layer>& layers) {
  std::vector<int> weights;
  int left = kOne;
  for (std::size_t i = layers.size(); i > 0; --i) {
    const auto weight = static_cast<int>(std::lround(left * layers[i - 1].opacity));
    weights.insert(weights.begin(), weight);
    left -= weight;
  }
  weights.insert(weights.begin(), left);
  return weights;
}

/// Add a band of RGBA samples, from bottom to top, to the sums of their pixels.
void AddSamples(const unsigned char* samples, int width, int rows, int factor, int weight,
                std::vector<std::uint32_t>& sums) {
  const int row = 4 * width;
  std::vector<std::uint16_t> column(row);  // sums over the sample rows of one pixel row
  std::uint32_t* out = sums.data();
  for (int bottom = rows; bottom > 0; bottom -= factor) {
    std::ranges::fill(column, 0);
    for (int k = 1; k <= factor; ++k) {
      const unsigned char* in = samples + std::size_t(row) * (bottom - k);
      for (int i = 0; i < row; ++i) column[i] += in[i];
    }
    for (int x = 0; x < row; out += 3) {
      for (int i = 0; i < factor; ++i, x += 4) {
        for (int channel = 0; channel < 3; ++channel) out[channel] += weight * column[x + channel];
      }
    }
  }
}

/// A band of samples that starts at row `top` of the image, stored from the last row up.
struct SampleBand {
  int width, top, rows, factor;
};

/// Columns and rows of samples: the first ones, and those after the last.
struct SampleBox {
  int left, bottom, right, top;
  [[nodiscard]] bool empty() const { return left >= right || bottom >= top; }
};

/// Return the smallest box that contains all samples whose alpha is not 0.
SampleBox VisibleBox(const std::vector<unsigned char>& samples, const SampleBand& band) {
  SampleBox box = {band.width, band.rows, 0, 0};
  for (int y = 0; y < band.rows; ++y) {
    const unsigned char* row = samples.data() + std::size_t{4} * band.width * y;
    int left = 0;
    while (left < band.width && row[4 * left + 3] == 0) ++left;
    if (left == band.width) continue;
    int right = band.width;
    while (row[4 * right - 1] == 0) --right;
    box = {std::min(box.left, left), std::min(box.bottom, y), std::max(box.right, right), y + 1};
  }
  return box;
}

/// Blend two channels of a sample, each in the lower byte of half a word, rounded to the nearest.
std::uint32_t MixPair(std::uint32_t color, std::uint32_t sample, std::uint32_t alpha) {
  // For 0 ≤ x ≤ 255², round(x / 255) = (t + t / 256) / 256 with t = x + 128.
  constexpr std::uint32_t kPair = 0x00ff00ff, kHalf = 0x00800080;
  const std::uint32_t t = color * alpha + sample * (kFullAlpha - alpha) + kHalf;
  return ((t + ((t >> 8) & kPair)) >> 8) & kPair;
}

/// Lay a colour over a sample, whose alpha changes too.
void Lay(const unsigned char* color, int alpha, unsigned char* sample) {
  constexpr std::uint32_t kPair = 0x00ff00ff;
  std::uint32_t over = 0, below = 0;
  std::memcpy(&over, color, sizeof(over));
  std::memcpy(&below, sample, sizeof(below));
  const std::uint32_t mixed = MixPair(over & kPair, below & kPair, alpha) |
                              MixPair((over >> 8) & kPair, (below >> 8) & kPair, alpha) << 8;
  std::memcpy(sample, &mixed, sizeof(mixed));
}

/// Lay an image with its own alpha over samples.
void LayVisible(const std::vector<unsigned char>& image, std::vector<unsigned char>& samples) {
  for (std::size_t i = 0; i < samples.size(); i += 4) {
    if (image[i + 3] != 0) Lay(&image[i], image[i + 3], &samples[i]);
  }
}

/// Reduce the opacity of samples inside windows.
void FadeInWindows(const std::vector<Window>& windows, const SampleBand& band,
                   std::vector<unsigned char>& samples) {
  for (const Window& window : windows) {
    const Eigen::Vector2d centre = band.factor * window.centre - Eigen::Vector2d(0, band.top);
    const double radius = band.factor * window.radius;
    const auto clamp = [](double value, int most) {
      return static_cast<int>(std::clamp<double>(value, 0, most));
    };
    const int last_x = clamp(centre.x() + radius + 1, band.width);
    const int last_y = clamp(centre.y() + radius + 1, band.rows);
    for (int y = clamp(centre.y() - radius, band.rows); y < last_y; ++y) {
      for (int x = clamp(centre.x() - radius, band.width); x < last_x; ++x) {
        const double away = (Eigen::Vector2d(x, y) - centre).norm() / radius;
        if (away >= 1) continue;
        const double fade = std::min(1.0, (1 - away) / kWindowRim);
        const double share = 1 - kWindowClearness * window.strength * fade * fade * (3 - 2 * fade);
        unsigned char& alpha = samples[4 * (std::size_t(band.width) * (band.rows - 1 - y) + x) + 3];
        alpha = static_cast<unsigned char>(std::lround(share * alpha));
      }
    }
  }
}

}  // namespace

class Canvas::Impl {
 public:
  Impl(const std::vector<ShadedMesh>& meshes, int width, int height, int supersampling)
      : width_(width),
        height_(height),
        factor_(supersampling),
        band_rows_(std::clamp(kMaxBandSamples / (width * factor_ * factor_), 1, height)),
        meshes_(std::make_shared<const std::vector<VertexArrays>>(meshes.begin(), meshes.end())),
        context_(width * factor_, band_rows_ * factor_) {
    Init();
  }
  Impl(const Impl& other)
      : width_(other.width_),
        height_(other.height_),
        factor_(other.factor_),
        band_rows_(other.band_rows_),
        meshes_(other.meshes_),
        context_(width_ * factor_, band_rows_ * factor_) {
    Init();
  }
  Impl& operator=(const Impl&) = delete;

  Image Draw(const Camera& camera, const Drawing& drawing, Color paper) {
    const OffscreenContext::Use use(context_);
    constexpr float kFull = 255;
    gl().ClearColor(paper.r / kFull, paper.g / kFull, paper.b / kFull, 0);
    Image image = MakeImage(width_, height_);
    for (int top = 0; top < height_; top += band_rows_) {
      DrawBand(camera, drawing, {top, std::min(band_rows_, height_ - top), height_}, image);
    }
    return image;
  }

 private:
  /// Return a copy of the present samples.
  [[nodiscard]] std::vector<unsigned char> CopySamples(const SampleBand& band) const {
    std::vector<unsigned char> copy;
    CopySamples(band, copy);
    return copy;
  }
  /// Copy the present samples to a buffer, whose memory is used again.
  void CopySamples(const SampleBand& band, std::vector<unsigned char>& copy) const {
    const unsigned char* seen = context_.pixels().data();
    copy.assign(seen, seen + std::size_t{4} * band.width * band.rows);
  }

  /// Compose the samples of a drawing with a solid.
  const std::vector<unsigned char>& ComposeSolid(const ShapePainter& painter,
                                                 const Drawing& drawing, const SampleBand& band) {
    if (drawing.veil) {
      DrawVeil(painter, *drawing.veil);
      CopySamples(band, rims_);
      HideVeil(painter, drawing);
      CopySamples(band, veil_);
      FadeInWindows(drawing.veil->windows, band, veil_);
    }
    DrawWithSolid(painter, drawing);
    CopySamples(band, samples_);
    LayXray(painter, drawing, band);
    if (drawing.veil) LayVisible(veil_, samples_);
    return samples_;
  }

  /// Lay the X-ray image over the visible samples of the solid. It is drawn only there. It has
  /// rims of a veil (Veil::xray_rims), even if the solid hides them.
  void LayXray(const ShapePainter& painter, const Drawing& drawing, const SampleBand& band) {
    const SampleBox box = VisibleBox(samples_, band);
    if (box.empty()) return;
    gl().Scissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
    gl().Enable(GL_SCISSOR_TEST);
    DrawXray(painter, drawing);
    gl().Disable(GL_SCISSOR_TEST);
    const unsigned char* seen = context_.pixels().data();
    const auto share = static_cast<int>(std::lround(kFullAlpha * drawing.solid->xray));
    const auto rim = static_cast<int>(std::lround(kFullAlpha * kHiddenRimOpacity));
    for (int y = box.bottom; y < box.top; ++y) {
      const std::size_t row = std::size_t(y) * band.width;
      for (std::size_t i = 4 * (row + box.left); i < 4 * (row + box.right); i += 4) {
        if (samples_[i + 3] == 0) continue;
        std::array<unsigned char, 4> xray;
        std::copy_n(&seen[i], xray.size(), xray.begin());
        const bool has_rim = drawing.veil && xray[3] != 0 && IsRim(&rims_[i]);
        if (has_rim) Lay(&rims_[i], rim, xray.data());
        Lay(xray.data(), share, &samples_[i]);
      }
    }
  }

  /// Compose the samples of layers with a veil.
  std::vector<unsigned char> ComposeLayers(const ShapePainter& painter, const Drawing& drawing,
                                           const SampleBand& band) const {
    std::vector<Shape> all = drawing.veil->rims;
    all.insert(all.end(), drawing.veil->xray_rims.begin(), drawing.veil->xray_rims.end());
    all.insert(all.end(), drawing.veil->shapes.begin(), drawing.veil->shapes.end());
    DrawPass(painter, drawing, all);
    std::vector<unsigned char> veil = CopySamples(band);
    FadeInWindows(drawing.veil->windows, band, veil);
    // Samples in front of the covers keep their alpha.
    SetMask(false, true);
    gl().Color4ub(0, 0, 0, 0);
    for (const MeshInstance& cover : drawing.veil->covers) painter.Draw(cover);
    SetMask(true, true);
    gl().Finish();
    const unsigned char* seen = context_.pixels().data();
    std::vector<bool> over(veil.size() / 4);
    for (std::size_t i = 0; i < over.size(); ++i) over[i] = seen[4 * i + 3] != 0;
    DrawPass(painter, drawing, {});
    std::vector<unsigned char> samples = CopySamples(band);
    const auto lay_veil = [&](bool where_over) {
      for (std::size_t i = 0; i < over.size(); ++i) {
        if (over[i] == where_over) Lay(&veil[4 * i], veil[4 * i + 3], &samples[4 * i]);
      }
    };
    lay_veil(false);
    for (const Layer& layer : drawing.layers) {
      DrawPass(painter, drawing, layer.shapes);
      const auto opacity = static_cast<int>(std::lround(kFullAlpha * layer.opacity));
      for (std::size_t i = 0; i < over.size(); ++i) {
        if (seen[4 * i + 3] != 0) Lay(&seen[4 * i], opacity, &samples[4 * i]);
      }
    }
    lay_veil(true);
    return samples;
  }

  void Init() {
    const OffscreenContext::Use use(context_);
    InitState();
  }

  void DrawBand(const Camera& camera, const Drawing& drawing, const Band& band, Image& image) {
    const SampleBand samples = {width_ * factor_, band.top * factor_, band.rows * factor_, factor_};
    gl().Viewport(0, 0, samples.width, samples.rows);
    SetCamera(camera, band);
    const ShapePainter painter(camera, *meshes_);
    std::vector<std::uint32_t> sums(std::size_t{3} * width_ * band.rows);
    const auto add = [&](const unsigned char* from, int weight) {
      AddSamples(from, samples.width, samples.rows, factor_, weight, sums);
    };
    if (drawing.solid) {
      add(ComposeSolid(painter, drawing, samples).data(), kOne);
    } else if (drawing.veil) {
      add(ComposeLayers(painter, drawing, samples).data(), kOne);
    } else {
      const std::vector<int> weights = WeightsOf(drawing.layers);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        DrawPass(painter, drawing,
                 i == 0 ? std::span<const Shape>() : drawing.layers[i - 1].shapes);
        add(context_.pixels().data(), weights[i]);
      }
    }
    const auto write = [&](const auto& mean) {
      std::ranges::transform(sums, image.rgb.begin() + std::ptrdiff_t{3} * width_ * band.top, mean);
    };
    const std::uint32_t all = kOne * factor_ * factor_;
    const int shift = std::countr_zero(all);
    if (std::has_single_bit(all)) {
      write(
          [=](std::uint32_t sum) { return static_cast<unsigned char>((sum + all / 2) >> shift); });
    } else {
      write([=](std::uint32_t sum) { return static_cast<unsigned char>((sum + all / 2) / all); });
    }
  }

  int width_, height_, factor_;
  int band_rows_;
  std::shared_ptr<const std::vector<VertexArrays>>
      meshes_;  ///< vertex arrays of the meshes, shared with copies
  OffscreenContext context_;
  std::vector<unsigned char> samples_, veil_, rims_;  ///< buffers of ComposeSolid
};

Canvas::Canvas(const std::vector<ShadedMesh>& meshes, int width, int height, int supersampling)
    : impl_(std::make_unique<Impl>(meshes, width, height, supersampling)) {}
Canvas::Canvas(const Canvas& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Canvas::~Canvas() = default;

Image Canvas::Draw(const Camera& camera, const Drawing& drawing, Color paper) {
  return impl_->Draw(camera, drawing, paper);
}

}  // namespace regrasp::render
