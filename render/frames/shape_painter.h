#pragma once

#include <Eigen/Core>
#include <vector>

#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/offscreen_context.h"

namespace regrasp::render {

/// Vertex arrays of a mesh for OpenGL.
class VertexArrays {
 public:
  /// @param mesh
  /// @param shared  whether triangles share equal corners. That is faster to draw, and slower to
  ///                set up.
  explicit VertexArrays(const ShadedMesh& mesh, bool shared = true);
  /// Draw the triangles in the current colour, or in their own colours if they have some.
  void Draw() const { Draw(corners_); }
  /// Draw the triangles that face the eye. It is faster than culling by OpenGL, with the same
  /// image.
  /// @param eye  homogeneous position of the eye in the frame of the mesh.
  void DrawFacing(const Eigen::Vector4d& eye) const;

 private:
  void Draw(const std::vector<unsigned>& corners) const;

  /// Planes of the triangles of shared corners: a point p is in front if plane · (p, 1) > 0.
  std::vector<Eigen::Vector4f> planes_;
  std::vector<float> points_;
  std::vector<float> normals_;
  std::vector<unsigned char> colors_;  ///< RGBA per vertex; empty: the current colour
  std::vector<unsigned> corners_;      ///< vertices of the triangles
};

/// Rows from `top` to `top + rows` of an image with `height` rows.
struct Band {
  int top, rows, height;
};

/// Set up the state of a new context: depth test, one light, culled back sides.
void InitState();

/// Set the projection and the light of a camera for a band of its image.
void SetCamera(const Camera& camera, const Band& band);

/// Set whether drawing changes the colours and the alpha values of samples.
void SetMask(bool colors, bool alpha);

/// Draws shapes into the current context.
class ShapePainter {
 public:
  /// @param camera, meshes  must outlive this object.
  ShapePainter(const Camera& camera, const std::vector<VertexArrays>& meshes)
      : camera_(camera), meshes_(meshes) {}

  /// Draw a shape. Its opacity is the alpha of its samples.
  void Draw(const Shape& shape) const;
  /// Draw a mesh in the current colour.
  void Draw(const MeshInstance& instance) const;
  /// Draw the opaque shapes, with an alpha of 1 or 0.
  void DrawOpaque(const std::vector<Shape>& shapes, bool alpha = true) const;
  /// Blend the translucent shapes in order of decreasing distance. They hide nothing and do not
  /// change alpha.
  void BlendTranslucent(const std::vector<Shape>& shapes) const;

 private:
  const Camera& camera_;
  const std::vector<VertexArrays>& meshes_;
};

}  // namespace regrasp::render
