#include "render/frames/canvas.h"

#include <GL/osmesa.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "planner/base/error.h"

namespace regrasp::render {

namespace {

constexpr int kDepthBits = 24;
constexpr int kBytesPerPixel = 4;
/// A frame is drawn in bands of at most this many samples, so that memory stays bounded (64 MB).
constexpr int kMaxBandSamples = 1 << 24;
/// The depth range and the place of the white wall behind everything, in distances from the camera
/// to the origin.
constexpr double kNearFactor = 0.1;
constexpr double kFarFactor = 4;
constexpr double kWallFactor = 3;

/// Nothing but meshes: shapes are drawn without bodies.
constexpr char kModelHead[] = R"(<mujoco model="canvas">
  <visual>
    <global offwidth="16" offheight="16"/>
    <quality shadowsize="0" offsamples="0" numslices="48" numstacks="24"/>
  </visual>
  <asset>
)";
constexpr char kModelTail[] = "  </asset>\n</mujoco>\n";

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using ModelPtr = std::unique_ptr<mjModel, ModelDeleter>;

/// MuJoCo's virtual files.
struct VirtualFiles {
  std::unique_ptr<mjVFS> vfs = std::make_unique<mjVFS>();
  VirtualFiles() { mj_defaultVFS(vfs.get()); }
  ~VirtualFiles() { mj_deleteVFS(vfs.get()); }
  VirtualFiles(const VirtualFiles&) = delete;
  VirtualFiles& operator=(const VirtualFiles&) = delete;

  void Add(const std::string& name, const std::string& bytes) {
    if (mj_makeEmptyFileVFS(vfs.get(), name.c_str(), static_cast<int>(bytes.size())) != 0) {
      throw std::runtime_error("no space for the file " + name + " in MuJoCo's memory");
    }
    std::memcpy(vfs->filedata[mj_findFileVFS(vfs.get(), name.c_str())], bytes.data(), bytes.size());
  }
};

template <class Number>
void Append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void AppendCorners(std::string& bytes,
                   const std::vector<std::array<Eigen::Vector3d, 3>>& triangles) {
  for (const auto& corners : triangles) {
    for (const Eigen::Vector3d& p : corners) {
      for (int i = 0; i < 3; ++i) Append(bytes, static_cast<float>(p[i]));
    }
  }
}

/// A mesh in MuJoCo's MSH format: counts of vertices, normals, texture coordinates and faces, then
/// the arrays. Every triangle has its own three vertices, so that it can be flat.
std::string FormatMsh(const FacetMesh& mesh) {
  const int triangles = static_cast<int>(mesh.triangles.size());
  std::string bytes;
  for (const int count : {3 * triangles, 3 * triangles, 0, triangles}) Append(bytes, count);
  AppendCorners(bytes, mesh.triangles);
  AppendCorners(bytes, mesh.normals);
  for (int i = 0; i < 3 * triangles; ++i) Append(bytes, i);
  return bytes;
}

/// MuJoCo moves a mesh to its principal axes when it compiles it; this puts it back.
void RestoreMesh(mjModel& model, int mesh, const FacetMesh& original) {
  if (model.mesh_vertnum[mesh] != 3 * static_cast<int>(original.triangles.size())) {
    throw std::logic_error("MuJoCo changed the number of vertices of a mesh");
  }
  float* vertex = model.mesh_vert + std::ptrdiff_t{3} * model.mesh_vertadr[mesh];
  float* normal = model.mesh_normal + std::ptrdiff_t{3} * model.mesh_vertadr[mesh];
  for (std::size_t t = 0; t < original.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      for (int i = 0; i < 3; ++i) {
        *vertex++ = static_cast<float>(original.triangles[t][corner][i]);
        *normal++ = static_cast<float>(original.normals[t][corner][i]);
      }
    }
  }
}

ModelPtr MakeModel(const std::vector<FacetMesh>& meshes) {
  VirtualFiles files;
  std::string xml = kModelHead;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string file = "mesh" + std::to_string(i) + ".msh";
    files.Add(file, FormatMsh(meshes[i]));
    xml += "    <mesh file=\"" + file + "\"/>\n";
  }
  files.Add("canvas.xml", xml + kModelTail);
  std::array<char, 1000> message = {};
  ModelPtr model(mj_loadXML("canvas.xml", files.vfs.get(), message.data(), message.size()));
  if (!model) throw std::runtime_error(std::string("rendering model: ") + message.data());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    RestoreMesh(*model, static_cast<int>(i), meshes[i]);
  }
  return model;
}

/// An OSMesa context with the memory that it draws in.
class OffscreenContext {
 public:
  OffscreenContext(int width, int height)
      : width_(width),
        height_(height),
        pixels_(std::size_t{kBytesPerPixel} * width * height),
        context_(CreateContext()) {
    if (context_ == nullptr) {
      throw EnvironmentError("no off-screen rendering context (OSMesa)");
    }
    try {
      MakeCurrent();
    } catch (...) {
      OSMesaDestroyContext(context_);
      throw;
    }
  }
  ~OffscreenContext() { OSMesaDestroyContext(context_); }
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  void MakeCurrent() {
    if (OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width_, height_) != GL_TRUE) {
      throw EnvironmentError("the off-screen rendering context of " + std::to_string(width_) + "x" +
                             std::to_string(height_) + " pixels cannot be used (OSMesa)");
    }
  }

 private:
  static OSMesaContext CreateContext() {
    // Mesa would keep shaders in the home folder. Its versions have two names for this.
    constexpr char kName[] = "MESA_SHADER_CACHE_DISABLE";
    constexpr char kOldName[] = "MESA_GLSL_CACHE_DISABLE";
    if (std::getenv(kName) == nullptr && std::getenv(kOldName) == nullptr) {
      for (const char* name : {kName, kOldName}) setenv(name, "true", /*overwrite=*/1);
    }
    return OSMesaCreateContextExt(OSMESA_RGBA, kDepthBits, 0, 0, nullptr);
  }

  int width_, height_;
  std::vector<unsigned char> pixels_;
  OSMesaContext context_;
};

struct Rgba {
  float values[4];
};

Rgba MakeRgba(Color color, double opacity) {
  constexpr float kMax = 255;
  // MuJoCo draws what is transparent twice, front to back and back to front.
  const double once = opacity < 1 ? 1 - std::sqrt(1 - opacity) : 1;
  return {{color.r / kMax, color.g / kMax, color.b / kMax, static_cast<float>(once)}};
}

/// Turns shapes into MuJoCo's geoms.
struct GeomMaker {
  mjvGeom& geom;
  const Rgba& rgba;

  void operator()(const Ball& ball) const {
    const mjtNum size[3] = {ball.radius, ball.radius, ball.radius};
    mjv_initGeom(&geom, mjGEOM_SPHERE, size, ball.centre.data(), nullptr, rgba.values);
  }
  void operator()(const Rod& rod) const { Connect(mjGEOM_CAPSULE, rod.radius, rod.from, rod.to); }
  void operator()(const Arrow& arrow) const {
    Connect(mjGEOM_ARROW, arrow.radius, arrow.tail, arrow.tip);
  }
  void operator()(const MeshInstance& instance) const {
    const Eigen::Vector3d position = instance.pose.translation();
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = instance.pose.linear();
    mjv_initGeom(&geom, mjGEOM_MESH, nullptr, position.data(), rotation.data(), rgba.values);
    geom.dataid = 2 * instance.mesh;  // the odd ones are convex hulls
  }
  void Connect(int type, double radius, const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    mjv_initGeom(&geom, type, nullptr, nullptr, nullptr, rgba.values);
    mjv_makeConnector(&geom, type, radius, a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
  }
};

void CopyTo(float (&out)[3], const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

void Fill(float (&out)[3], float value) { std::fill(std::begin(out), std::end(out), value); }

/// A soft directional light from above the camera's left shoulder.
mjvLight MakeLight(const Camera& camera) {
  mjvLight light = {};
  const Eigen::Vector3d from = camera.axes * Eigen::Vector3d(-0.45, 0.75, 0.8);
  CopyTo(light.dir, -from.normalized());
  light.directional = 1;
  light.attenuation[0] = 1;
  Fill(light.ambient, 0.60F);
  Fill(light.diffuse, 0.48F);
  Fill(light.specular, 0.12F);
  return light;
}

/// A wall that shines white behind the scene. MuJoCo clears to black, and its own background, a
/// textured box, takes as long to draw as all the rest.
void InitWall(mjvGeom& geom, const Camera& camera) {
  const double distance = kWallFactor * camera.position.norm();
  const double aspect = std::max(1.0, static_cast<double>(camera.width) / camera.height);
  const double half = 2 * distance * camera.tan_half_height * aspect;
  const mjtNum size[3] = {half, half, distance * kNearFactor};
  const Eigen::Vector3d centre = camera.position - distance * camera.axes.col(2);
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = camera.axes;
  const Rgba white = MakeRgba({255, 255, 255}, 1);
  mjv_initGeom(&geom, mjGEOM_BOX, size, centre.data(), rotation.data(), white.values);
  geom.emission = 1;
}

/// What is drawn: geoms, light and background.
class Scene {
 public:
  Scene(const mjModel& model, std::span<const Shape> shapes, const Camera& camera) {
    mjv_defaultScene(&scene_);
    mjv_makeScene(&model, &scene_, static_cast<int>(shapes.size()) + 1);
    std::fill(std::begin(scene_.flags), std::end(scene_.flags), 0);
    scene_.flags[mjRND_CULL_FACE] = 1;
    for (const Shape& shape : shapes) {
      const Rgba rgba = MakeRgba(shape.color, shape.opacity);
      std::visit(GeomMaker{scene_.geoms[scene_.ngeom++], rgba}, shape.form);
    }
    InitWall(scene_.geoms[scene_.ngeom++], camera);
    scene_.lights[0] = MakeLight(camera);
    scene_.nlight = 1;
  }
  ~Scene() { mjv_freeScene(&scene_); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  [[nodiscard]] mjvScene* get() { return &scene_; }

 private:
  mjvScene scene_ = {};
};

/// The camera for the rows from `top` to `top + rows` of an image `height` rows high.
mjvGLCamera MakeBandCamera(const Camera& camera, double near, double far, double top, double rows,
                           double height) {
  mjvGLCamera band = {};
  CopyTo(band.pos, camera.position);
  CopyTo(band.forward, -camera.axes.col(2));
  CopyTo(band.up, camera.axes.col(1));
  const double half = camera.tan_half_height * near;
  band.frustum_top = static_cast<float>(half * (1 - 2 * top / height));
  band.frustum_bottom = static_cast<float>(half * (1 - 2 * (top + rows) / height));
  band.frustum_near = static_cast<float>(near);
  band.frustum_far = static_cast<float>(far);
  return band;
}

/// Copies rows that OpenGL gives from the bottom into the image from the top.
void CopyBand(Image& image, int top, const std::vector<unsigned char>& band, int rows) {
  const std::size_t row = std::size_t{3} * image.width;
  for (int y = 0; y < rows; ++y) {
    std::copy_n(band.data() + (rows - 1 - y) * row, row, image.rgb.data() + (top + y) * row);
  }
}

}  // namespace

class Canvas::Impl {
 public:
  Impl(const std::vector<FacetMesh>& meshes, int width, int height)
      : width_(width),
        height_(height),
        band_height_(std::clamp(kMaxBandSamples / width, 1, height)),
        context_(width, band_height_),
        model_(MakeModel(meshes)) {
    mjr_defaultContext(&renderer_);
    mjr_makeContext(model_.get(), &renderer_, mjFONTSCALE_50);
    mjr_setBuffer(mjFB_WINDOW, &renderer_);
  }
  ~Impl() {
    context_.MakeCurrent();
    mjr_freeContext(&renderer_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Image Draw(const Camera& camera, std::span<const Shape> shapes) {
    context_.MakeCurrent();
    Scene scene(*model_, shapes, camera);
    Image image = MakeImage(width_, height_);
    std::vector<unsigned char> pixels(std::size_t{3} * width_ * band_height_);
    const double distance = camera.position.norm();
    for (int top = 0; top < height_; top += band_height_) {
      const int rows = std::min(band_height_, height_ - top);
      const mjrRect viewport = {0, 0, width_, rows};
      scene.get()->camera[0] = scene.get()->camera[1] =
          MakeBandCamera(camera, kNearFactor * distance, kFarFactor * distance, top, rows, height_);
      mjr_render(viewport, scene.get(), &renderer_);
      mjr_finish();
      mjr_readPixels(pixels.data(), nullptr, viewport, &renderer_);
      CopyBand(image, top, pixels, rows);
    }
    return image;
  }

 private:
  int width_;
  int height_;
  int band_height_;
  OffscreenContext context_;
  ModelPtr model_;
  mjrContext renderer_ = {};
};

Canvas::Canvas(const std::vector<FacetMesh>& meshes, int width, int height)
    : impl_(std::make_unique<Impl>(meshes, width, height)) {}
Canvas::~Canvas() = default;

Image Canvas::Draw(const Camera& camera, std::span<const Shape> shapes) {
  return impl_->Draw(camera, shapes);
}

}  // namespace regrasp::render
