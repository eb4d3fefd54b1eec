#pragma once

#include <array>
#include <cstddef>
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
  void Draw() const;

 private:
  friend class MeshBuffers;
  std::vector<float> points_;
  std::vector<float> normals_;
  std::vector<unsigned char> colors_;  ///< RGBA per vertex; empty: the current colour
  std::vector<unsigned> corners_;      ///< vertices of the triangles
};

/// Vertex arrays in the memory of a context, which draws them without copying them again.
/// The context frees the memory at its end.
class MeshBuffers {
 public:
  /// Copy the arrays to the current context.
  explicit MeshBuffers(const VertexArrays& arrays);
  /// Same as VertexArrays::Draw.
  void Draw() const;

 private:
  std::array<unsigned, 2> buffers_ = {};  ///< vertices and corners
  std::size_t normals_at_ = 0;            ///< position of the normals in the buffer of vertices
  std::size_t colors_at_ = 0;             ///< the same for colours; 0: the current colour
  int corners_ = 0;                       ///< number of corners
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
  /// @param camera  must outlive this object.
  /// @param meshes  meshes in the current context; must outlive this object.
  ShapePainter(const Camera& camera, const std::vector<MeshBuffers>& meshes)
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
  const std::vector<MeshBuffers>& meshes_;
};

}  // namespace regrasp::render
