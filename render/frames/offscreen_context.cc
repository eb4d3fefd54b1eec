#include "render/frames/offscreen_context.h"

#include <cstddef>
#include <cstdlib>
#include <string>

#include "planner/base/error.h"
#include "planner/base/shared_library.h"

namespace regrasp::render {

namespace {

constexpr int kDepthBits = 24;
constexpr int kBytesPerPixel = 4;

Gl LoadGl() {
  // Mesa 22 (Debian 12) and older versions.
  const SharedLibrary mesa({"libOSMesa.so.8", "libOSMesa.so.6"});
  Gl gl;
#define REGRASP_GL_FIND(name) mesa.Find("gl" #name, gl.name);
  REGRASP_GL_FUNCTIONS(REGRASP_GL_FIND)
#undef REGRASP_GL_FIND
  mesa.Find("OSMesaCreateContextExt", gl.CreateContext);
  mesa.Find("OSMesaDestroyContext", gl.DestroyContext);
  mesa.Find("OSMesaMakeCurrent", gl.MakeCurrent);
  return gl;
}

OSMesaContext CreateContext() {
  // Mesa would store shaders in the home folder. The name of this variable depends on its version.
  constexpr char kName[] = "MESA_SHADER_CACHE_DISABLE";
  constexpr char kOldName[] = "MESA_GLSL_CACHE_DISABLE";
  if (std::getenv(kName) == nullptr && std::getenv(kOldName) == nullptr) {
    for (const char* name : {kName, kOldName}) setenv(name, "true", /*overwrite=*/1);
  }
  return gl().CreateContext(OSMESA_RGBA, kDepthBits, 0, 0, nullptr);
}

}  // namespace

const Gl& gl() {
  static const Gl functions = LoadGl();
  return functions;
}

OffscreenContext::OffscreenContext(int width, int height)
    : width_(width), height_(height), context_(CreateContext()) {
  if (context_ == nullptr)
    throw EnvironmentError("off-screen rendering context (OSMesa) cannot be created");
  try {
    const Use used(*this);
    CreateFramebuffer();
  } catch (...) {
    gl().DestroyContext(context_);
    throw;
  }
}

OffscreenContext::~OffscreenContext() { gl().DestroyContext(context_); }

OffscreenContext::Use::~Use() { gl().MakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

void OffscreenContext::MakeCurrent() {
  if (gl().MakeCurrent(context_, unused_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
    throw EnvironmentError("off-screen rendering context (OSMesa) cannot be used");
  }
}

void OffscreenContext::CreateFramebuffer() {
  // The framebuffer remains bound, and the context deletes it.
  GLuint framebuffer = 0;
  gl().GenFramebuffers(1, &framebuffer);
  gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  std::array<GLuint, 2> buffers = {};
  gl().GenRenderbuffers(2, buffers.data());
  const auto attach = [this](GLuint buffer, GLenum format, GLenum attachment) {
    gl().BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl().RenderbufferStorage(GL_RENDERBUFFER, format, width_, height_);
    gl().FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(buffers[0], GL_RGBA8, GL_COLOR_ATTACHMENT0);
  attach(buffers[1], GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  const bool is_complete = gl().CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (gl().GetError() != GL_NO_ERROR || !is_complete) {
    throw EnvironmentError("the off-screen framebuffer of " + std::to_string(width_) + "x" +
                           std::to_string(height_) + " pixels cannot be created (OSMesa)");
  }
}

void ReadPixels(const PixelBox& box, int row_pixels, unsigned char* to) {
  if (box.empty()) return;
  gl().PixelStorei(GL_PACK_ROW_LENGTH, row_pixels);
  const std::size_t first = std::size_t(box.bottom) * row_pixels + box.left;
  gl().ReadPixels(box.left, box.bottom, box.right - box.left, box.top - box.bottom, GL_RGBA,
                  GL_UNSIGNED_BYTE, to + kBytesPerPixel * first);
}

}  // namespace regrasp::render
