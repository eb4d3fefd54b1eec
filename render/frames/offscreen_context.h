#pragma once

#include <GL/osmesa.h>

#include <vector>

namespace regrasp::render {

/// OpenGL functions that draw frames, without their prefix.
// clang-format off
#define REGRASP_GL_FUNCTIONS(F) \
  F(BlendFunc) F(Clear) F(ClearColor) F(Color4ub) F(ColorMask) F(ColorMaterial) F(ColorPointer) F(DepthFunc) \
  F(DepthMask) F(Disable) F(DisableClientState) F(DrawElements) F(Enable) F(EnableClientState) F(Finish) F(Frustum) F(LightModelfv) F(Lightfv) \
  F(LoadIdentity) F(LoadMatrixd) F(MatrixMode) F(MultMatrixd) F(NormalPointer) F(Ortho) F(PopMatrix) \
  F(PushMatrix) F(Scissor) F(VertexPointer) F(Viewport)
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

/// Return the functions of the loaded library.
/// @throws EnvironmentError  if OSMesa is not installed.
[[nodiscard]] const Gl& gl();

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

}  // namespace regrasp::render
