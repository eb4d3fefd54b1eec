#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "render/frames/camera.h"
#include "render/frames/shaded_mesh.h"
#include "render/picture/image.h"

namespace regrasp::render {

struct Sphere {
  Eigen::Vector3d centre;
  double radius;
};

/// A cylinder with hemispherical ends.
struct Capsule {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  double radius;
};

/// A line with round ends and a uniform colour, without lighting.
struct Line {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  double radius;
};

/// A mesh of the canvas, given by its index, at a pose.
struct MeshInstance {
  int mesh;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

struct Shape {
  std::variant<Sphere, Capsule, Line, MeshInstance> form;
  Color color;
  double opacity = 1;
};

/// Shapes that are blended over an image as one translucent sheet.
struct Layer {
  std::vector<Shape> shapes;
  double opacity = 1;
};

/// A disc of an image within which a veil becomes more transparent towards the centre, pixels.
struct Window {
  Eigen::Vector2d centre;
  double radius;
  double strength;  ///< share of the full effect, 0 to 1
};

/// Translucent shapes in front of and behind the layers or the solid, each with its own opacity.
///
/// At each pixel only the nearest shape is visible. It is blended below the layers if one of
/// `covers` is in front of it, otherwise over them. A solid hides it, but some rims shine through
/// (Solid).
struct Veil {
  std::vector<Shape> shapes;
  std::vector<Shape> rims = {};  ///< shells of which only the rim is not hidden by `shapes`
  std::vector<MeshInstance> covers = {};  ///< only with layers
  std::vector<Window> windows = {};       ///< areas in which the veil is more transparent
  std::vector<Shape> xray_rims = {};      ///< shells whose rims also shine through a solid
};

/// An opaque object, through which hidden shapes shine faintly as in an X-ray image.
struct Solid {
  std::vector<Shape> shapes;  ///< its surface and lines; translucent shapes are behind it
  double xray = 0;            ///< opacity of `Drawing::shapes` behind it
};

/// The content of an image.
struct Drawing {
  /// Shapes without a layer. Translucent ones must be convex: only their near side is drawn.
  std::vector<Shape> shapes;
  /// The opaque image of the shapes with layer i is blended over the previous result, for each
  /// layer in turn. The far and the near side of an object are thereby blended exactly, for any
  /// order of triangles.
  std::vector<Layer> layers;
  /// Opaque lines that are drawn where neither shapes nor `hiding` occlude them.
  std::vector<Shape> outline;
  std::vector<MeshInstance> hiding;
  /// If set, each layer is blended only at its visible pixels.
  std::optional<Veil> veil = std::nullopt;
  /// If set, it replaces the layers, the outline and `hiding`.
  std::optional<Solid> solid = std::nullopt;
};

/// An off-screen OpenGL canvas with one soft light from above and left of the camera, without
/// shadows.
///
/// The scene is centred at the origin and has size 1. Deterministic: the same drawing gives the
/// same bytes. One thread at a time can use a canvas. A copy has its own OpenGL context, so that
/// several threads can draw in parallel.
class Canvas {
 public:
  /// Create a canvas.
  /// @param meshes         meshes that MeshInstance refers to.
  /// @param width, height  size of the images, pixels.
  /// @param supersampling  number of averaged samples along both axes of a pixel.
  /// @throws EnvironmentError  if off-screen rendering is not available.
  Canvas(const std::vector<ShadedMesh>& meshes, int width, int height, int supersampling);
  ~Canvas();
  Canvas(const Canvas& other);
  Canvas& operator=(const Canvas&) = delete;

  /// Draw an image.
  /// @param camera  camera with the size of the canvas.
  [[nodiscard]] Image Draw(const Camera& camera, const Drawing& drawing, Color paper = kWhite);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Points whose projections bound the projections of shapes.
class ProjectedExtent {
 public:
  /// Create an empty extent.
  /// @param axes    axes of the camera.
  /// @param meshes  meshes that MeshInstance refers to; must outlive this object.
  ProjectedExtent(const Eigen::Matrix3d& axes, const std::vector<ShadedMesh>& meshes)
      : axes_(axes), meshes_(meshes) {}

  void operator()(const Sphere& sphere) {
    for (const double sign : {-1.0, 1.0}) {
      for (const int axis : {0, 1})
        points_.push_back(sphere.centre + sign * sphere.radius * axes_.col(axis));
    }
  }
  void operator()(const Capsule& capsule) { AddEnds(capsule); }
  void operator()(const Line& line) { AddEnds(line); }
  void operator()(const MeshInstance& instance) {
    for (const auto& corners : meshes_[instance.mesh].triangles) {
      for (const Eigen::Vector3d& p : corners) points_.push_back(instance.pose * p);
    }
  }
  template <class Form>
  void AddEnds(const Form& form) {
    for (const Eigen::Vector3d& end : {form.from, form.to}) (*this)(Sphere{end, form.radius});
  }
  void Add(const std::variant<Sphere, Capsule, Line, MeshInstance>& form) {
    std::visit(*this, form);
  }

  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  const Eigen::Matrix3d& axes_;
  const std::vector<ShadedMesh>& meshes_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace regrasp::render
