#include "render/frames/shape_painter.h"

#include <algorithm>
#include <array>
#include <boost/container_hash/hash.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <unordered_map>
#include <variant>
#include <vector>

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Limits of the depth range, relative to the distance from camera to origin.
constexpr double kNearFactor = 0.1;
constexpr double kFarFactor = 4;

/// Share of a surface's colour in shade, and the additional share at normal incidence of light.
constexpr float kAmbient = 0.68F;
constexpr float kDiffuse = 0.40F;
/// Direction towards the light, in camera axes.
constexpr float kLightFrom[4] = {-0.45F, 0.75F, 0.8F, 0};

/// Rounding error of the distance of the eye from a plane, relative to that from the origin.
constexpr float kEdgeOn = 1e-4F;

/// A vertex: point, normal and colour.
struct Vertex {
  std::array<float, 6> values;
  std::array<unsigned char, 4> color;

  bool operator==(const Vertex&) const = default;
};

struct VertexHash {
  std::size_t operator()(const Vertex& vertex) const {
    return static_cast<std::size_t>(boost::hash_value(vertex.values));
  }
};

Vertex VertexOf(const ShadedMesh& mesh, std::size_t triangle, int corner) {
  Vertex vertex = {{}, {}};
  for (int i = 0; i < 3; ++i) {
    vertex.values[i] = static_cast<float>(mesh.triangles[triangle][corner][i]);
    vertex.values[3 + i] = static_cast<float>(mesh.normals[triangle][corner][i]);
  }
  if (mesh.colors.empty()) return vertex;
  const Color& color = mesh.colors[triangle][corner];
  vertex.color = {color.r, color.g, color.b, 255};
  return vertex;
}

void SetColor(Color color, double opacity) {
  gl().Color4ub(color.r, color.g, color.b, static_cast<GLubyte>(std::lround(255 * opacity)));
}

/// Draws a form in the current colour.
struct FormPainter {
  const Camera& camera;
  const std::vector<VertexArrays>& meshes;

  void operator()(const Sphere& sphere) const {
    Once(MakeCapsule(sphere.centre, sphere.centre, sphere.radius));
  }
  void operator()(const Capsule& capsule) const {
    Once(MakeCapsule(capsule.from, capsule.to, capsule.radius));
  }
  void operator()(const Line& line) const {
    gl().Disable(GL_LIGHTING);
    const Vector3d back = camera.ToEye((line.from + line.to) / 2);
    Once(MakeBand(line.from, line.to, line.radius, back));
    gl().Enable(GL_LIGHTING);
  }
  static void Once(const ShadedMesh& mesh) { VertexArrays(mesh, /*shared=*/false).Draw(); }
  void operator()(const MeshInstance& instance) const {
    gl().PushMatrix();
    gl().MultMatrixd(instance.pose.data());
    const bool perspective = camera.projection == Projection::kPerspective;
    Eigen::Vector4d eye;
    eye << (perspective ? camera.position : Vector3d(camera.axes.col(2))), (perspective ? 1 : 0);
    meshes[instance.mesh].DrawFacing(instance.pose.inverse() * eye);
    gl().PopMatrix();
  }
};

/// Return the middle of a form, for its distance.
struct Middle {
  Vector3d operator()(const Sphere& sphere) const { return sphere.centre; }
  Vector3d operator()(const Capsule& capsule) const { return (capsule.from + capsule.to) / 2; }
  Vector3d operator()(const Line& line) const { return (line.from + line.to) / 2; }
  Vector3d operator()(const MeshInstance& mesh) const { return mesh.pose.translation(); }
};

}  // namespace

VertexArrays::VertexArrays(const ShadedMesh& mesh, bool shared) {
  std::unordered_map<Vertex, unsigned, VertexHash> indices;
  corners_.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vertex vertex = VertexOf(mesh, t, corner);
      const auto count = static_cast<unsigned>(points_.size() / 3);
      corners_.push_back(shared ? indices.try_emplace(vertex, count).first->second : count);
      if (corners_.back() != count) continue;
      points_.insert(points_.end(), vertex.values.begin(), vertex.values.begin() + 3);
      normals_.insert(normals_.end(), vertex.values.begin() + 3, vertex.values.end());
      if (mesh.colors.empty()) continue;
      colors_.insert(colors_.end(), vertex.color.begin(), vertex.color.end());
    }
    if (!shared) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3d normal = (b - a).cross(c - a).normalized();
    planes_.emplace_back(
        Eigen::Vector4d(normal.x(), normal.y(), normal.z(), -normal.dot(a)).cast<float>());
  }
}

void VertexArrays::DrawFacing(const Eigen::Vector4d& eye) const {
  // OpenGL culls triangles that are nearly edge-on.
  const Eigen::Vector4f at = eye.cast<float>();
  const float least = -kEdgeOn * at.norm();
  std::vector<unsigned> facing;
  facing.reserve(corners_.size());
  for (std::size_t t = 0; t < planes_.size(); ++t) {
    if (planes_[t].dot(at) < least) continue;
    facing.insert(facing.end(), corners_.begin() + static_cast<std::ptrdiff_t>(3 * t),
                  corners_.begin() + static_cast<std::ptrdiff_t>(3 * t + 3));
  }
  Draw(facing);
}

void VertexArrays::Draw(const std::vector<unsigned>& corners) const {
  if (corners.empty()) return;
  gl().VertexPointer(3, GL_FLOAT, 0, points_.data());
  gl().NormalPointer(GL_FLOAT, 0, normals_.data());
  if (!colors_.empty()) {
    gl().EnableClientState(GL_COLOR_ARRAY);
    gl().ColorPointer(4, GL_UNSIGNED_BYTE, 0, colors_.data());
  }
  gl().DrawElements(GL_TRIANGLES, static_cast<GLsizei>(corners.size()), GL_UNSIGNED_INT,
                    corners.data());
  if (!colors_.empty()) gl().DisableClientState(GL_COLOR_ARRAY);
}

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

void SetMask(bool colors, bool alpha) {
  gl().ColorMask(colors ? GL_TRUE : GL_FALSE, colors ? GL_TRUE : GL_FALSE,
                 colors ? GL_TRUE : GL_FALSE, alpha ? GL_TRUE : GL_FALSE);
}

void ShapePainter::Draw(const Shape& shape) const {
  SetColor(shape.color, shape.opacity);
  std::visit(FormPainter{camera_, meshes_}, shape.form);
}

void ShapePainter::Draw(const MeshInstance& instance) const {
  FormPainter{camera_, meshes_}(instance);
}

void ShapePainter::DrawOpaque(const std::vector<Shape>& shapes, bool alpha) const {
  for (const Shape& shape : shapes) {
    if (shape.opacity < 1) continue;
    SetColor(shape.color, alpha ? 1 : 0);
    std::visit(FormPainter{camera_, meshes_}, shape.form);
  }
}

void ShapePainter::BlendTranslucent(const std::vector<Shape>& shapes) const {
  std::vector<Shape> sorted;
  std::ranges::copy_if(shapes, std::back_inserter(sorted),
                       [](const Shape& shape) { return shape.opacity < 1; });
  std::ranges::stable_sort(sorted, std::greater(), [&](const Shape& shape) {
    return camera_.Depth(std::visit(Middle(), shape.form));
  });
  SetMask(true, false);
  gl().Enable(GL_BLEND);
  gl().DepthMask(GL_FALSE);
  for (const Shape& shape : sorted) Draw(shape);
  gl().DepthMask(GL_TRUE);
  gl().Disable(GL_BLEND);
}

}  // namespace regrasp::render
