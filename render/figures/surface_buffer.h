#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// The nearest surface at each sample of an image, in a parallel projection: its label, depth and
/// normal. It is the input of line drawings (Saito and Takahashi 1990, "Comprehensible rendering
/// of 3-D shapes").
class SurfaceBuffer {
 public:
  static constexpr int kNothing = -1;  ///< label of samples without a surface

  SurfaceBuffer(int width, int height);

  /// Add a surface. Both sides of its triangles are visible.
  /// @param label  label of its samples, ≥ 0.
  /// @param place  function from a point of the mesh to samples: x to the right, y down, z towards
  ///               the eye, in the same unit.
  /// @param turn   rotation from the frame of the mesh to these axes.
  /// @param lift   distance by which the surface counts as nearer than it is, samples. It decides
  ///               between surfaces that nearly coincide.
  void Add(const ShadedMesh& mesh, int label,
           const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place,
           const Eigen::Matrix3d& turn, double lift = 0);

  /// Replace the samples next to steps of depth by the sample of median depth within two samples.
  /// Specks and slits of a few samples disappear, for example where surfaces nearly coincide.
  /// @param step  smallest step of depth, samples.
  void RemoveSpecks(double step);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Return the label of a sample; kNothing outside the image.
  [[nodiscard]] int LabelAt(int x, int y) const;
  /// Return the depth of a sample, larger if nearer to the eye; −∞ without a surface.
  [[nodiscard]] float DepthAt(int x, int y) const;
  /// Return the unit normal of a sample that faces the eye, rounded to about 0.5°.
  [[nodiscard]] Eigen::Vector3f NormalAt(int x, int y) const;

 private:
  struct Sample {
    float depth;
    short label;
    std::array<signed char, 3> normal;
  };

  [[nodiscard]] bool IsAtStep(int x, int y, double step) const;
  void AddTriangle(const std::array<Eigen::Vector3d, 3>& corners,
                   const std::array<Eigen::Vector3d, 3>& normals, int label);

  int width_, height_;
  std::vector<Sample> samples_;
};

/// Return whether a step of depth, or the border of a surface, separates two neighbouring samples.
/// Labels do not matter otherwise, because the links of a finger overlap at its joints.
/// @param step  smallest step of depth, samples.
[[nodiscard]] bool IsOutline(const SurfaceBuffer& surfaces, double step, int x, int y, int x2,
                             int y2);

}  // namespace regrasp::render
