#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "render/frames/camera.h"
#include "render/frames/facet_mesh.h"
#include "render/picture/color_table.h"
#include "render/picture/image.h"

namespace regrasp::render {

struct Ball {
  Eigen::Vector3d centre;
  double radius;
};

/// A cylinder with round ends.
struct Rod {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  double radius;
};

/// A line of even colour, whatever the light, with round ends.
struct Line {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
  double radius;
};

/// One of the canvas's meshes, by its index.
struct MeshInstance {
  int mesh;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

struct Shape {
  std::variant<Ball, Rod, Line, MeshInstance> form;
  Color color;
  double opacity = 1;
};

/// Shapes that lie over a picture as one translucent sheet.
struct Layer {
  std::vector<Shape> shapes;
  double opacity = 1;
};

/// A round place of an image, pixels: from its rim to its middle what is before it grows clearer.
struct Window {
  Eigen::Vector2d centre;
  double radius;
  double strength;  ///< of 1
};

/// Things that stand before and behind what the layers show, each with an opacity of its own. Only
/// the nearest of them is seen at a place: behind the layers where one of `covers` stands before
/// it, otherwise over them.
struct Veil {
  std::vector<Shape> shapes;
  std::vector<MeshInstance> covers;
  std::vector<Window> windows;  ///< where it hides less
};

/// What a canvas draws.
struct Drawing {
  /// Those with an opacity below 1 must be convex: only their near side is drawn.
  std::vector<Shape> shapes;
  /// The picture of the shapes and the first layer, opaque, is laid over that of the shapes alone;
  /// that of the shapes and the second layer over both; and so on. A body's far side and then its
  /// near side are so seen through exactly, whatever the order of its triangles.
  std::vector<Layer> layers;
  /// Lines that are drawn, opaque, where neither shapes nor `hiding` stand before them.
  std::vector<Shape> outline;
  std::vector<MeshInstance> hiding;
  /// With it a layer changes the picture only where it is seen.
  std::optional<Veil> veil = std::nullopt;
};

/// An off-screen OpenGL window with one soft light from above the camera's left shoulder
/// and no shadows.
///
/// Deterministic: the same drawing gives the same bytes. The scene is about the origin, of size 1.
/// A canvas may be used by one thread after the other; a copy has a window of its own, so that two
/// threads draw at a time.
class Canvas {
 public:
  /// @param meshes         what MeshInstance names.
  /// @param width, height  pixels of its images.
  /// @param supersampling  samples along both axes of a pixel, averaged.
  /// @throws EnvironmentError  no off-screen rendering context.
  Canvas(const std::vector<FacetMesh>& meshes, int width, int height, int supersampling);
  ~Canvas();
  Canvas(const Canvas& other);
  Canvas& operator=(const Canvas&) = delete;

  /// @param camera  of the canvas's width and height.
  [[nodiscard]] Image Draw(const Camera& camera, const Drawing& drawing, Color paper = kWhite);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::render
