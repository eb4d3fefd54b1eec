#include "render/frames/canvas.h"

#include <GL/osmesa.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "planner/base/error.h"
#include "planner/base/shared_library.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// OpenGL functions that draw frames, without their prefix.
// clang-format off
#define REGRASP_GL_FUNCTIONS(F) \
  F(BlendFunc) F(Clear) F(ClearColor) F(Color4ub) F(ColorMask) F(ColorMaterial) F(DepthFunc) F(DepthMask) \
  F(Disable) F(DrawArrays) F(Enable) F(EnableClientState) F(Finish) F(Frustum) F(LightModelfv) F(Lightfv) \
  F(LoadIdentity) F(LoadMatrixd) F(MatrixMode) F(MultMatrixd) F(NormalPointer) F(Ortho) F(PopMatrix) \
  F(PushMatrix) F(VertexPointer) F(Viewport)
// clang-format on

/// OpenGL functions of OSMesa, loaded at the first call of gl().
struct Gl {
#define REGRASP_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
  REGRASP_GL_FUNCTIONS(REGRASP_GL_MEMBER)
#undef REGRASP_GL_MEMBER
  decltype(&::OSMesaCreateContextExt) CreateContext = nullptr;
  decltype(&::OSMesaDestroyContext) DestroyContext = nullptr;
  decltype(&::OSMesaMakeCurrent) MakeCurrent = nullptr;
};

constexpr int kDepthBits = 24;
constexpr int kBytesPerPixel = 4;

Gl LoadGl() {
  // Mesa 22 (Debian 12) and older versions.
  const SharedLibrary mesa({"libOSMesa.so.8", "libOSMesa.so.6"});
  Gl gl;
#define REGRASP_GL_FIND(name) mesa.Find("gl" #name, gl.name);
  REGRASP_GL_FUNCTIONS(REGRASP_GL_FIND)
#undef REGRASP_GL_FIND
  mesa.Find("OSMesaCreateContextExt", gl.CreateContext);
  mesa.Find("OSMesaDestroyContext", gl.DestroyContext);
  mesa.Find("OSMesaMakeCurrent", gl.MakeCurrent);
  return gl;
}

/// Return the functions of the loaded library.
/// @throws EnvironmentError  if OSMesa is not installed.
const Gl& gl() {
  static const Gl functions = LoadGl();
  return functions;
}

OSMesaContext CreateContext() {
  // Mesa would store shaders in the home folder. The name of this variable depends on its version.
  constexpr char kName[] = "MESA_SHADER_CACHE_DISABLE";
  constexpr char kOldName[] = "MESA_GLSL_CACHE_DISABLE";
  if (std::getenv(kName) == nullptr && std::getenv(kOldName) == nullptr) {
    for (const char* name : {kName, kOldName}) setenv(name, "true", /*overwrite=*/1);
  }
  return gl().CreateContext(OSMESA_RGBA, kDepthBits, 0, 0, nullptr);
}

/// An OSMesa context of OpenGL (compatibility profile) with its buffers: RGBA with 8 bits per
/// channel, rows from bottom to top, and depth.
class OffscreenContext {
 public:
  /// Create a context.
  /// @throws EnvironmentError  if the context cannot be created in this size.
  OffscreenContext(int width, int height);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// A scope in which OpenGL functions of this thread draw into the context. Another thread can use
  /// the context afterwards.
  class Use {
   public:
    explicit Use(OffscreenContext& context) { context.MakeCurrent(); }
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
  };
  /// Return the drawn pixels. Requires a preceding glFinish.
  [[nodiscard]] const std::vector<unsigned char>& pixels() const { return pixels_; }

 private:
  void MakeCurrent();

  int width_, height_;
  std::vector<unsigned char> pixels_;
  OSMesaContext context_;
};

OffscreenContext::OffscreenContext(int width, int height)
    : width_(width),
      height_(height),
      pixels_(std::size_t{kBytesPerPixel} * width * height),
      context_(CreateContext()) {
  if (context_ == nullptr)
    throw EnvironmentError("off-screen rendering context (OSMesa) cannot be created");
  try {
    const Use tried(*this);
  } catch (...) {
    gl().DestroyContext(context_);
    throw;
  }
}

OffscreenContext::~OffscreenContext() { gl().DestroyContext(context_); }

OffscreenContext::Use::~Use() { gl().MakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

void OffscreenContext::MakeCurrent() {
  if (gl().MakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width_, height_) != GL_TRUE) {
    throw EnvironmentError("the off-screen rendering context of " + std::to_string(width_) + "x" +
                           std::to_string(height_) + " pixels cannot be used (OSMesa)");
  }
}

/// Maximum number of samples per band. A frame is drawn in bands to bound its memory (64 MB).
constexpr int kMaxBandSamples = 1 << 24;
/// Limits of the depth range, relative to the distance from camera to origin.
constexpr double kNearFactor = 0.1;
constexpr double kFarFactor = 4;

/// Share of a surface's colour in shade, and the additional share at normal incidence of light.
constexpr float kAmbient = 0.60F;
constexpr float kDiffuse = 0.48F;
/// Direction towards the light, in camera axes.
constexpr float kLightFrom[4] = {-0.45F, 0.75F, 0.8F, 0};

/// Weights of layers are multiples of 1 / kOne.
constexpr int kOne = 256;
constexpr int kFullAlpha = 255;

/// Reduction of a veil's opacity in the middle of a window, and width of the transition per radius.
constexpr double kWindowClearness = 0.7;
constexpr double kWindowRim = 0.55;

/// Vertex arrays of OpenGL.
struct Vertices {
  std::vector<float> points;
  std::vector<float> normals;

  explicit Vertices(const ShadedMesh& mesh) {
    Append(mesh.triangles, points);
    Append(mesh.normals, normals);
  }
  static void Append(const std::vector<std::array<Vector3d, 3>>& corners, std::vector<float>& out) {
    out.reserve(9 * corners.size());
    for (const auto& triangle : corners) {
      for (const Vector3d& p : triangle) {
        for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(p[i]));
      }
    }
  }
  void Draw() const {
    gl().VertexPointer(3, GL_FLOAT, 0, points.data());
    gl().NormalPointer(GL_FLOAT, 0, normals.data());
    gl().DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(points.size() / 3));
  }
};

/// Rows from `top` to `top + rows` of an image with `height` rows.
struct Band {
  int top, rows, height;
};

void SetCamera(const Camera& camera, const Band& band) {
  const double distance = camera.position.norm();
  const double near = kNearFactor * distance;
  const double far = kFarFactor * distance;
  const bool perspective = camera.projection == Projection::kPerspective;
  const double half = camera.half_height * (perspective ? near : 1);
  const double right = half * camera.width / camera.height;
  const double top = half * (1 - 2.0 * band.top / band.height);
  const double bottom = half * (1 - 2.0 * (band.top + band.rows) / band.height);
  gl().MatrixMode(GL_PROJECTION);
  gl().LoadIdentity();
  (perspective ? gl().Frustum : gl().Ortho)(-right, right, bottom, top, near, far);
  gl().MatrixMode(GL_MODELVIEW);
  gl().LoadIdentity();
  const float black[4] = {0, 0, 0, 1};
  const float ambient[4] = {kAmbient, kAmbient, kAmbient, 1};
  const float diffuse[4] = {kDiffuse, kDiffuse, kDiffuse, 1};
  gl().LightModelfv(GL_LIGHT_MODEL_AMBIENT, black);
  gl().Lightfv(GL_LIGHT0, GL_POSITION, kLightFrom);
  gl().Lightfv(GL_LIGHT0, GL_AMBIENT, ambient);
  gl().Lightfv(GL_LIGHT0, GL_DIFFUSE, diffuse);
  Eigen::Isometry3d camera_pose = Eigen::Isometry3d::Identity();
  camera_pose.linear() = camera.axes;
  camera_pose.translation() = camera.position;
  gl().LoadMatrixd(camera_pose.inverse().data());
}

void SetColor(Color color, double opacity) {
  gl().Color4ub(color.r, color.g, color.b, static_cast<GLubyte>(std::lround(255 * opacity)));
}

/// Draws shapes in the current colour.
class FormPainter {
 public:
  FormPainter(const Camera& camera, const std::vector<Vertices>& meshes)
      : camera_(camera), meshes_(meshes) {}

  void operator()(const Sphere& sphere) const {
    Vertices(MakeCapsule(sphere.centre, sphere.centre, sphere.radius)).Draw();
  }
  void operator()(const Capsule& capsule) const {
    Vertices(MakeCapsule(capsule.from, capsule.to, capsule.radius)).Draw();
  }
  void operator()(const Line& line) const {
    gl().Disable(GL_LIGHTING);
    const Vector3d back = camera_.ToEye((line.from + line.to) / 2);
    Vertices(MakeBand(line.from, line.to, line.radius, back)).Draw();
    gl().Enable(GL_LIGHTING);
  }
  void operator()(const MeshInstance& instance) const {
    gl().PushMatrix();
    gl().MultMatrixd(instance.pose.data());
    meshes_[instance.mesh].Draw();
    gl().PopMatrix();
  }
  void Draw(const std::vector<Shape>& shapes, bool opaque) const {
    for (const Shape& shape : shapes) {
      if ((shape.opacity == 1) == opaque) Draw(shape);
    }
  }
  void Draw(const Shape& shape) const {
    SetColor(shape.color, shape.opacity);
    std::visit(*this, shape.form);
  }

 private:
  const Camera& camera_;
  const std::vector<Vertices>& meshes_;
};

/// Return the translucent shapes in order of decreasing distance.
std::vector<Shape> SortTranslucent(const Camera& camera, const std::vector<Shape>& shapes) {
  struct Middle {
    Vector3d operator()(const Sphere& sphere) const { return sphere.centre; }
    Vector3d operator()(const Capsule& capsule) const { return (capsule.from + capsule.to) / 2; }
    Vector3d operator()(const Line& line) const { return (line.from + line.to) / 2; }
    Vector3d operator()(const MeshInstance& mesh) const { return mesh.pose.translation(); }
  };
  std::vector<Shape> sorted;
  std::ranges::copy_if(shapes, std::back_inserter(sorted),
                       [](const Shape& shape) { return shape.opacity < 1; });
  std::ranges::stable_sort(sorted, std::greater(), [&](const Shape& shape) {
    return camera.Depth(std::visit(Middle(), shape.form));
  });
  return sorted;
}

void InitState() {
  for (const GLenum on : {GL_DEPTH_TEST, GL_CULL_FACE, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL}) {
    gl().Enable(on);
  }
  gl().ColorMaterial(GL_FRONT, GL_AMBIENT_AND_DIFFUSE);
  gl().BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl().DepthFunc(GL_LEQUAL);
  gl().EnableClientState(GL_VERTEX_ARRAY);
  gl().EnableClientState(GL_NORMAL_ARRAY);
}

/// Set whether drawing changes the colours and the alpha values of samples.
void SetMask(bool colors, bool alpha) {
  gl().ColorMask(colors ? GL_TRUE : GL_FALSE, colors ? GL_TRUE : GL_FALSE,
                 colors ? GL_TRUE : GL_FALSE, alpha ? GL_TRUE : GL_FALSE);
}

/// Draw the shapes together with more shapes, which are opaque. The alpha of a sample is the
/// opacity of one of these if it is visible there, and 0 otherwise.
void DrawPass(const FormPainter& painter, const Drawing& drawing,
              const std::vector<Shape>& translucent, std::span<const Shape> more) {
  SetMask(true, true);
  gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  SetMask(true, false);
  painter.Draw(drawing.shapes, /*opaque=*/true);
  SetMask(true, true);
  for (const Shape& shape : more) painter.Draw(shape);
  SetMask(true, false);
  gl().Enable(GL_BLEND);
  gl().DepthMask(GL_FALSE);
  painter.Draw(translucent, /*opaque=*/false);
  gl().DepthMask(GL_TRUE);
  gl().Disable(GL_BLEND);
  SetMask(false, false);
  for (const MeshInstance& mesh : drawing.hiding) painter(mesh);
  SetMask(true, false);
  painter.Draw(drawing.outline, /*opaque=*/true);
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

}  // namespace

class Canvas::Impl {
 public:
  Impl(const std::vector<ShadedMesh>& meshes, int width, int height, int supersampling)
      : width_(width),
        height_(height),
        factor_(supersampling),
        band_rows_(std::clamp(kMaxBandSamples / (width * factor_ * factor_), 1, height)),
        meshes_(std::make_shared<const std::vector<Vertices>>(meshes.begin(), meshes.end())),
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
  /// A band of samples that starts at row `top` of the image, stored from the last row up.
  struct SampleBand {
    int width, top, rows, factor;
  };

  /// Blend all images sample by sample.
  std::vector<unsigned char> Compose(const FormPainter& painter, const Drawing& drawing,
                                     const std::vector<Shape>& translucent,
                                     const SampleBand& band) const {
    const std::size_t count = std::size_t{4} * band.width * band.rows;
    const auto draw = [&](std::span<const Shape> more) {
      DrawPass(painter, drawing, translucent, more);
      return context_.pixels().data();
    };
    const unsigned char* seen = draw(drawing.veil->shapes);
    std::vector<unsigned char> veil(seen, seen + count);
    FadeInWindows(drawing.veil->windows, band, veil);
    // Samples in front of the covers keep their alpha.
    SetMask(false, true);
    gl().Color4ub(0, 0, 0, 0);
    for (const MeshInstance& cover : drawing.veil->covers) painter(cover);
    SetMask(true, true);
    gl().Finish();
    std::vector<bool> over(count / 4);
    for (std::size_t i = 0; i < over.size(); ++i) over[i] = seen[4 * i + 3] != 0;
    seen = draw({});
    std::vector<unsigned char> samples(seen, seen + count);
    const auto lay_veil = [&](bool where_over) {
      for (std::size_t i = 0; i < over.size(); ++i) {
        if (over[i] == where_over) Lay(&veil[4 * i], veil[4 * i + 3], &samples[4 * i]);
      }
    };
    lay_veil(false);
    for (const Layer& layer : drawing.layers) {
      seen = draw(layer.shapes);
      const auto opacity = static_cast<int>(std::lround(kFullAlpha * layer.opacity));
      for (std::size_t i = 0; i < over.size(); ++i) {
        if (seen[4 * i + 3] != 0) Lay(&seen[4 * i], opacity, &samples[4 * i]);
      }
    }
    lay_veil(true);
    return samples;
  }

  static void Lay(const unsigned char* color, int alpha, unsigned char* sample) {
    for (int c = 0; c < 3; ++c) {
      const int mixed = color[c] * alpha + sample[c] * (kFullAlpha - alpha);
      sample[c] = static_cast<unsigned char>((mixed + kFullAlpha / 2) / kFullAlpha);
    }
  }

  /// Reduce the opacity of samples inside windows.
  static void FadeInWindows(const std::vector<Window>& windows, const SampleBand& band,
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
          const double share =
              1 - kWindowClearness * window.strength * fade * fade * (3 - 2 * fade);
          unsigned char& alpha =
              samples[4 * (std::size_t(band.width) * (band.rows - 1 - y) + x) + 3];
          alpha = static_cast<unsigned char>(std::lround(share * alpha));
        }
      }
    }
  }

  void Init() {
    const OffscreenContext::Use use(context_);
    InitState();
  }

  void DrawBand(const Camera& camera, const Drawing& drawing, const Band& band, Image& image) {
    const int rows = band.rows * factor_;
    gl().Viewport(0, 0, width_ * factor_, rows);
    SetCamera(camera, band);
    const FormPainter painter(camera, *meshes_);
    const std::vector<Shape> translucent = SortTranslucent(camera, drawing.shapes);
    std::vector<std::uint32_t> sums(std::size_t{3} * width_ * band.rows);
    if (drawing.veil) {
      const std::vector<unsigned char> samples = Compose(
          painter, drawing, translucent,
          {.width = width_ * factor_, .top = band.top * factor_, .rows = rows, .factor = factor_});
      AddSamples(samples.data(), width_ * factor_, rows, factor_, kOne, sums);
    } else {
      const std::vector<int> weights = WeightsOf(drawing.layers);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        DrawPass(painter, drawing, translucent,
                 i == 0 ? std::span<const Shape>() : drawing.layers[i - 1].shapes);
        AddSamples(context_.pixels().data(), width_ * factor_, rows, factor_, weights[i], sums);
      }
    }
    const std::uint32_t all = kOne * factor_ * factor_;
    std::ranges::transform(
        sums, image.rgb.begin() + std::ptrdiff_t{3} * width_ * band.top,
        [all](std::uint32_t sum) { return static_cast<unsigned char>((sum + all / 2) / all); });
  }

  int width_, height_, factor_;
  int band_rows_;
  std::shared_ptr<const std::vector<Vertices>>
      meshes_;  ///< vertex arrays of the meshes, shared with copies
  OffscreenContext context_;
};

Canvas::Canvas(const std::vector<ShadedMesh>& meshes, int width, int height, int supersampling)
    : impl_(std::make_unique<Impl>(meshes, width, height, supersampling)) {}
Canvas::Canvas(const Canvas& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Canvas::~Canvas() = default;

Image Canvas::Draw(const Camera& camera, const Drawing& drawing, Color paper) {
  return impl_->Draw(camera, drawing, paper);
}

}  // namespace regrasp::render
