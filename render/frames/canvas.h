#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/picture/image.h"
#include "render/picture/palette.h"

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

struct Arrow {
  Eigen::Vector3d tail;
  Eigen::Vector3d tip;
  double radius;
};

/// One of the canvas's meshes, by its index.
struct MeshInstance {
  int mesh;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

struct Shape {
  std::variant<Ball, Rod, Arrow, MeshInstance> form;
  Color color;
  double opacity = 1;
};

/// An off-screen OpenGL window that MuJoCo's renderer draws in, on white, with one soft light from
/// above the camera's left shoulder and no shadows.
///
/// Deterministic: the same shapes give the same bytes. The scene is about the origin, of size 1.
class Canvas {
 public:
  /// @param meshes  what MeshInstance names.
  /// @param width, height  pixels of its images.
  /// @throws EnvironmentError  no off-screen rendering context.
  Canvas(const std::vector<FacetMesh>& meshes, int width, int height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  [[nodiscard]] Image Draw(const Camera& camera, std::span<const Shape> shapes);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::render
