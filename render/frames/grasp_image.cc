#include "render/frames/grasp_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/frames/annotation.h"
#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/shaded_mesh.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"

namespace regrasp::render {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kGraspHandOpacity = 0.55;
constexpr Color kGraspHandColor = {196, 186, 172};
constexpr Color kGraspContact = kFaultRed;
/// Lengths per size of the scene.
constexpr double kGraspContactRadius = 0.009;
constexpr double kGraspEdgeRadius = 0.0016;
constexpr int kGraspSupersampling = 2;
/// Share of the direction away from the palm in the direction towards the eye.
constexpr double kGraspAway = 0.45;

/// The scene in units of its size, centred at the middle of the object.
class GraspDrawing {
 public:
  GraspDrawing(const GraspScene& scene, const object::Object& object)
      : scene_(scene), body_(MakeBodyShape(object)) {
    const double diameter = object.diameter() * scene.scale;
    centre_ = scene.scale * object.mass_properties().centroid;
    for (const kinematics::LinkVisual& link : scene.hand) AddPoints(link);
    double reach = diameter;
    for (const Vector3d& point : points_) reach = std::max(reach, 2 * (point - centre_).norm());
    size_ = reach;
    for (Vector3d& point : points_) point = Unit(point);
    AddObject(diameter);
    for (const kinematics::LinkVisual& link : scene.hand) AddLink(link);
    for (const Vector3d& contact : scene.contacts) {
      drawing_.shapes.push_back({Sphere{Unit(contact), kGraspContactRadius}, kGraspContact});
    }
    drawing_.layers.push_back(std::move(links_));
  }

  [[nodiscard]] Vector3d Back() const {
    const Vector3d to_palm = scene_.palm.translation() - centre_;
    const Vector3d towards =
        to_palm.norm() > 0 ? Vector3d(to_palm.normalized()) : Vector3d(Vector3d::UnitZ());
    return (towards.unitOrthogonal() - kGraspAway * towards).normalized();
  }
  [[nodiscard]] const std::vector<ShadedMesh>& meshes() const { return meshes_; }
  [[nodiscard]] const Drawing& drawing() const { return drawing_; }
  [[nodiscard]] const std::vector<Vector3d>& points() const { return points_; }
  [[nodiscard]] double size() const { return size_; }

 private:
  [[nodiscard]] Vector3d Unit(const Vector3d& point) const { return (point - centre_) / size_; }

  void AddPoints(const kinematics::LinkVisual& link) {
    for (const auto& corners : link.triangles) {
      for (const Vector3d& p : corners) points_.push_back(scene_.palm * p);
    }
    for (const auto& capsule : link.capsules) {
      for (const Vector3d& end : {capsule.from, capsule.to}) {
        for (int axis = 0; axis < 3; ++axis) {
          for (const int sign : {-1, 1}) {
            points_.push_back(scene_.palm * end + sign * capsule.radius * Vector3d::Unit(axis));
          }
        }
      }
    }
  }

  /// Add the object, whose shape is relative to its centroid in units of its diameter.
  void AddObject(double diameter) {
    const double factor = diameter / size_;
    ShadedMesh surface = body_.surface;
    for (auto& corners : surface.triangles) {
      for (Vector3d& p : corners) points_.push_back(p *= factor);
    }
    drawing_.shapes.push_back({MeshInstance{static_cast<int>(meshes_.size())}, kBodyOutside});
    meshes_.push_back(std::move(surface));
    for (const auto& [from, to] : body_.edges) {
      drawing_.shapes.push_back({Line{factor * from, factor * to, kGraspEdgeRadius}, kInk});
    }
  }

  void AddLink(const kinematics::LinkVisual& link) {
    ShadedMesh mesh;
    for (std::size_t i = 0; i < link.triangles.size(); ++i) {
      auto corners = link.triangles[i];
      auto normals = link.normals[i];
      for (int k = 0; k < 3; ++k) {
        corners[k] = Unit(scene_.palm * corners[k]);
        normals[k] = scene_.palm.linear() * normals[k];
      }
      mesh.Add(corners, normals);
    }
    for (const auto& [from, to, radius] : link.capsules) {
      links_.shapes.push_back(
          {Capsule{Unit(scene_.palm * from), Unit(scene_.palm * to), radius / size_},
           kGraspHandColor});
    }
    if (mesh.triangles.empty()) return;
    links_.shapes.push_back({MeshInstance{static_cast<int>(meshes_.size())}, kGraspHandColor});
    meshes_.push_back(std::move(mesh));
  }

  const GraspScene& scene_;
  BodyShape body_;
  Vector3d centre_ = Vector3d::Zero();
  double size_ = 1;
  std::vector<ShadedMesh> meshes_;
  Drawing drawing_;
  Layer links_{{}, kGraspHandOpacity};
  std::vector<Vector3d> points_;
};

}  // namespace

Image DrawGraspScene(const GraspScene& scene, const object::Object& object,
                     const std::string& caption, int width) {
  const GraspDrawing grasp(scene, object);
  const TextStyle style{FontSize(width, width), kWhiteGround};
  const double font = style.font / width;
  const Margins margins{2 * font, 2 * font, 4.6 * font};
  const Camera camera = FitCamera(CameraAxes(grasp.Back()), Projection::kPerspective, width, width,
                                  margins, grasp.points());
  Canvas canvas(grasp.meshes(), camera.width, camera.height, kGraspSupersampling);
  const CairoImage image(canvas.Draw(camera, grasp.drawing()));
  static_cast<void>(DrawCaption(image, camera, caption, grasp.size(), style));
  return image.ToImage();
}

}  // namespace regrasp::render
