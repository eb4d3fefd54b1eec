#pragma once

#define GL_GLEXT_PROTOTYPES  // declare the functions of framebuffers
#include <GL/osmesa.h>

#include <array>

namespace regrasp::render {

/// OpenGL functions that draw frames, without their prefix.
// clang-format off
#define REGRASP_GL_FUNCTIONS(F) \
  F(BindFramebuffer) F(BindRenderbuffer) F(BlendFunc) F(CheckFramebufferStatus) F(Clear) F(ClearColor) F(Color4ub) \
  F(ColorMask) F(ColorMaterial) F(ColorPointer) F(DepthFunc) F(DepthMask) F(DepthRange) F(Disable) F(DisableClientState) \
  F(DrawElements) F(Enable) F(EnableClientState) F(FramebufferRenderbuffer) F(Frustum) F(GenFramebuffers) \
  F(GenRenderbuffers) F(GetError) F(LightModelfv) F(Lightfv) F(LoadIdentity) F(LoadMatrixd) F(MatrixMode) \
  F(MultMatrixd) F(NormalPointer) F(Ortho) F(PixelStorei) F(PopMatrix) F(PushMatrix) F(ReadPixels) \
  F(RenderbufferStorage) F(Scissor) F(VertexPointer) F(Viewport)
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

/// A box of pixels. Rows count from the bottom.
struct PixelBox {
  int left, bottom, right, top;
  [[nodiscard]] bool empty() const { return left >= right || bottom >= top; }
};

/// An OSMesa context of OpenGL (compatibility profile) with a framebuffer: RGBA with 8 bits per
/// channel, and depth.
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

 private:
  void MakeCurrent();
  void CreateFramebuffer();

  int width_, height_;
  /// The buffer of OSMesa, which copies all of it whenever drawing ends. It is not used.
  std::array<unsigned char, 4> unused_ = {};
  OSMesaContext context_;
};

/// Read the RGBA values of a box of the present framebuffer.
/// @param row_pixels  width of the image `to`.
/// @param to          image of at least box.top rows, from bottom to top. The box has the same
/// place
///                    there.
void ReadPixels(const PixelBox& box, int row_pixels, unsigned char* to);

}  // namespace regrasp::render
