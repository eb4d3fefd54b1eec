#pragma once

#include <GL/osmesa.h>

namespace regrasp::render {

/// The functions of OpenGL that frames are drawn with, without their prefix.
// clang-format off
#define REGRASP_GL_FUNCTIONS(F) \
  F(BlendFunc) F(Clear) F(ClearColor) F(Color4ub) F(ColorMask) F(ColorMaterial) F(DepthFunc) F(DepthMask) \
  F(Disable) F(DrawArrays) F(Enable) F(EnableClientState) F(Finish) F(Frustum) F(LightModelfv) F(Lightfv) \
  F(LoadIdentity) F(LoadMatrixd) F(MatrixMode) F(MultMatrixd) F(NormalPointer) F(Ortho) F(PopMatrix) \
  F(PushMatrix) F(VertexPointer) F(Viewport)
// clang-format on

/// OpenGL as OSMesa has it, loaded at the first call of gl().
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

}  // namespace regrasp::render
