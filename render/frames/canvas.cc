#include "render/frames/canvas.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "render/frames/offscreen_context.h"
#include "render/frames/samples.h"
#include "render/frames/shape_painter.h"

namespace regrasp::render {

namespace {

/// Maximum number of samples per band. A frame is drawn in bands to bound its memory (64 MB).
constexpr int kMaxBandSamples = 1 << 24;

/// Margin around the projected bounds of a drawing, pixels: antialiased edges and rounding.
constexpr double kBoxMargin = 3;

/// Weights of layers are multiples of 1 / kOne.
constexpr int kOne = 256;

/// Opacity of the rims of a veil behind a solid.
constexpr double kHiddenRimOpacity = 0.35;

/// Clear all samples. With a scissor box it would be much slower.
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
}

/// Draw a solid in front of its translucent shapes. The alpha of its samples is 1.
void DrawSolid(const ShapePainter& painter, const Solid& solid) {
  painter.BlendTranslucent(solid.shapes);
  SetMask(true, true);
  painter.DrawOpaque(solid.shapes);
}

/// Draw, in a box, a solid and the shapes over it even if it hides them. The alpha of its samples
/// is 0 at opaque shapes and 1 otherwise.
void DrawXray(const ShapePainter& painter, const Drawing& drawing, const PixelBox& box) {
  ClearAll();
  gl().Scissor(box.left, box.bottom, box.right - box.left, box.top - box.bottom);
  gl().Enable(GL_SCISSOR_TEST);
  gl().DepthRange(0.5, 1);
  DrawSolid(painter, *drawing.solid);
  gl().DepthRange(0, 0.5);
  painter.DrawOpaque(drawing.shapes, /*alpha=*/false);
  painter.BlendTranslucent(drawing.shapes);
  gl().DepthRange(0, 1);
  gl().Disable(GL_SCISSOR_TEST);
}

/// Draw a solid with the shapes in front of it. The alpha of visible samples of the solid is 1, and
/// 0 elsewhere.
void DrawWithSolid(const ShapePainter& painter, const Drawing& drawing) {
  ClearAll();
  DrawSolid(painter, *drawing.solid);
  SetMask(true, true);
  painter.DrawOpaque(drawing.shapes, /*alpha=*/false);
  painter.BlendTranslucent(drawing.shapes);
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

/// Return for each mesh triangles with the corners of its bounding box.
std::vector<ShadedMesh> BoundsOf(const std::vector<ShadedMesh>& meshes) {
  std::vector<ShadedMesh> bounds(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Eigen::AlignedBox3d box;
    for (const auto& corners : meshes[i].triangles) {
      for (const Eigen::Vector3d& p : corners) box.extend(p);
    }
    if (box.isEmpty()) continue;
    const auto corner = [&box](int k) {
      return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    };
    bounds[i].triangles = {{corner(0), corner(1), corner(2)},
                           {corner(3), corner(4), corner(5)},
                           {corner(6), corner(7), corner(7)}};
  }
  return bounds;
}

}  // namespace

class Canvas::Impl {
 public:
  Impl(const std::vector<ShadedMesh>& meshes, int width, int height, int supersampling)
      : width_(width),
        height_(height),
        factor_(supersampling),
        band_rows_(std::clamp(kMaxBandSamples / (width * factor_ * factor_), 1, height)),
        bounds_(BoundsOf(meshes)),
        meshes_(std::make_shared<const std::vector<VertexArrays>>(meshes.begin(), meshes.end())),
        context_(width * factor_, band_rows_ * factor_) {
    Init();
  }
  Impl(const Impl& other)
      : width_(other.width_),
        height_(other.height_),
        factor_(other.factor_),
        band_rows_(other.band_rows_),
        bounds_(other.bounds_),
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
      DrawBand(camera, drawing, {top, std::min(band_rows_, height_ - top), height_}, paper, image);
    }
    return image;
  }

 private:
  /// Read the present samples of a band into a buffer.
  static void Read(const SampleBand& band, std::vector<unsigned char>& samples) {
    Read(band, {0, 0, band.width, band.rows}, samples);
  }
  /// Read the present samples of a box into a buffer of the size of the band.
  static void Read(const SampleBand& band, const PixelBox& box,
                   std::vector<unsigned char>& samples) {
    samples.resize(std::size_t{4} * band.width * band.rows);
    ReadPixels(box, band.width, samples.data());
  }

  /// Compose the samples of a drawing with a solid, in the box that contains the drawing.
  const std::vector<unsigned char>& ComposeSolid(const ShapePainter& painter,
                                                 const Drawing& drawing, const SampleBand& band,
                                                 const PixelBox& box) {
    DrawWithSolid(painter, drawing);
    Read(band, box, samples_);
    const PixelBox solid = VisibleBox(samples_, band, box);
    if (!solid.empty()) {
      DrawXray(painter, drawing, solid);
      Read(band, solid, xray_);
    }
    if (drawing.veil) {
      DrawVeil(painter, *drawing.veil);
      Read(band, solid, rims_);
      HideVeil(painter, drawing);
      Read(band, box, veil_);
      FadeInWindows(drawing.veil->windows, band, box, veil_);
    }
    LayXray(drawing, band, solid);
    if (drawing.veil) LayVisible(veil_, band, box, samples_);
    return samples_;
  }

  /// Return the pixels of a band that a drawing with a solid can change, as samples.
  [[nodiscard]] PixelBox BoxOf(const Camera& camera, const Drawing& drawing,
                               const SampleBand& band) const {
    ProjectedExtent extent(camera.axes, bounds_);
    const auto add = [&extent](const std::vector<Shape>& shapes) {
      for (const Shape& shape : shapes) extent.Add(shape.form);
    };
    add(drawing.shapes);
    add(drawing.solid->shapes);
    if (drawing.veil) {
      for (const auto* shapes :
           {&drawing.veil->shapes, &drawing.veil->rims, &drawing.veil->xray_rims}) {
        add(*shapes);
      }
    }
    Eigen::AlignedBox2d pixels;
    for (const Eigen::Vector3d& p : extent.points()) {
      // A point next to or behind the eye has no useful projection.
      const bool is_seen = camera.projection == Projection::kOrthographic || camera.Depth(p) > 0;
      const Eigen::Vector2d pixel = camera.Project(p);
      if (!is_seen || !pixel.allFinite()) return {0, 0, band.width, band.rows};
      pixels.extend(pixel);
    }
    if (pixels.isEmpty()) return {0, 0, 0, 0};
    const int top = band.top / factor_, rows = band.rows / factor_;
    const auto clamp = [](double value, int most) {
      return static_cast<int>(std::clamp<double>(value, 0, most));
    };
    const Eigen::Vector2d first = pixels.min().array().floor() - kBoxMargin;
    const Eigen::Vector2d last = pixels.max().array().ceil() + kBoxMargin;
    PixelBox box = {clamp(first.x(), width_), rows - clamp(last.y() - top, rows),
                    clamp(last.x(), width_), rows - clamp(first.y() - top, rows)};
    for (int* limit : {&box.left, &box.bottom, &box.right, &box.top}) *limit *= factor_;
    return box;
  }

  /// Lay the X-ray image over the visible samples of the solid. It has rims of a veil
  /// (Veil::xray_rims), even if the solid hides them.
  void LayXray(const Drawing& drawing, const SampleBand& band, const PixelBox& box) {
    const auto share = static_cast<int>(std::lround(kFullAlpha * drawing.solid->xray));
    const auto rim = static_cast<int>(std::lround(kFullAlpha * kHiddenRimOpacity));
    for (int y = box.bottom; y < box.top; ++y) {
      const std::size_t row = std::size_t(y) * band.width;
      for (std::size_t i = 4 * (row + box.left); i < 4 * (row + box.right); i += 4) {
        if (samples_[i + 3] == 0) continue;
        const bool has_rim = drawing.veil && xray_[i + 3] != 0 && IsRim(&rims_[i]);
        if (has_rim) Lay(&rims_[i], rim, &xray_[i]);
        Lay(&xray_[i], share, &samples_[i]);
      }
    }
  }

  /// Compose the samples of layers with a veil.
  const std::vector<unsigned char>& ComposeLayers(const ShapePainter& painter,
                                                  const Drawing& drawing, const SampleBand& band) {
    std::vector<Shape> all = drawing.veil->rims;
    all.insert(all.end(), drawing.veil->xray_rims.begin(), drawing.veil->xray_rims.end());
    all.insert(all.end(), drawing.veil->shapes.begin(), drawing.veil->shapes.end());
    DrawPass(painter, drawing, all);
    Read(band, veil_);
    FadeInWindows(drawing.veil->windows, band, {0, 0, band.width, band.rows}, veil_);
    // Samples in front of the covers keep their alpha.
    SetMask(false, true);
    gl().Color4ub(0, 0, 0, 0);
    for (const MeshInstance& cover : drawing.veil->covers) painter.Draw(cover);
    SetMask(true, true);
    Read(band, layer_);
    std::vector<bool> over(veil_.size() / 4);
    for (std::size_t i = 0; i < over.size(); ++i) over[i] = layer_[4 * i + 3] != 0;
    DrawPass(painter, drawing, {});
    Read(band, samples_);
    const auto lay_veil = [&](bool where_over) {
      for (std::size_t i = 0; i < over.size(); ++i) {
        if (over[i] == where_over) Lay(&veil_[4 * i], veil_[4 * i + 3], &samples_[4 * i]);
      }
    };
    lay_veil(false);
    for (const Layer& layer : drawing.layers) {
      DrawPass(painter, drawing, layer.shapes);
      Read(band, layer_);
      const auto opacity = static_cast<int>(std::lround(kFullAlpha * layer.opacity));
      for (std::size_t i = 0; i < over.size(); ++i) {
        if (layer_[4 * i + 3] != 0) Lay(&layer_[4 * i], opacity, &samples_[4 * i]);
      }
    }
    lay_veil(true);
    return samples_;
  }

  void Init() {
    const OffscreenContext::Use use(context_);
    InitState();
  }

  void DrawBand(const Camera& camera, const Drawing& drawing, const Band& band, Color paper,
                Image& image) {
    const SampleBand samples = {width_ * factor_, band.top * factor_, band.rows * factor_, factor_};
    gl().Viewport(0, 0, samples.width, samples.rows);
    SetCamera(camera, band);
    const ShapePainter painter(camera, *meshes_);
    std::vector<std::uint32_t> sums(std::size_t{3} * width_ * band.rows);
    const auto add = [&](const unsigned char* from, int weight) {
      AddSamples(from, samples, {0, 0, samples.width, samples.rows}, weight, sums);
    };
    if (drawing.solid) {
      const std::uint32_t full = kOne * factor_ * factor_;
      const PixelBox box = BoxOf(camera, drawing, samples);
      FillOutside(box, samples, {full * paper.r, full * paper.g, full * paper.b}, sums);
      if (!box.empty()) {
        AddSamples(ComposeSolid(painter, drawing, samples, box).data(), samples, box, kOne, sums);
      }
    } else if (drawing.veil) {
      add(ComposeLayers(painter, drawing, samples).data(), kOne);
    } else {
      const std::vector<int> weights = WeightsOf(drawing.layers);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        DrawPass(painter, drawing,
                 i == 0 ? std::span<const Shape>() : drawing.layers[i - 1].shapes);
        Read(samples, layer_);
        add(layer_.data(), weights[i]);
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
  std::vector<ShadedMesh> bounds_;  ///< a triangle per three corners of the bounding box of a mesh
  std::shared_ptr<const std::vector<VertexArrays>>
      meshes_;  ///< vertex arrays of the meshes, shared with copies
  OffscreenContext context_;
  // Buffers of samples.
  std::vector<unsigned char> samples_, veil_, rims_, xray_, layer_;
};

Canvas::Canvas(const std::vector<ShadedMesh>& meshes, int width, int height, int supersampling)
    : impl_(std::make_unique<Impl>(meshes, width, height, supersampling)) {}
Canvas::Canvas(const Canvas& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Canvas::~Canvas() = default;

Image Canvas::Draw(const Camera& camera, const Drawing& drawing, Color paper) {
  return impl_->Draw(camera, drawing, paper);
}

}  // namespace regrasp::render
