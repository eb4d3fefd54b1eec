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
    : width_(width),
      height_(height),
      pixels_(std::size_t{kBytesPerPixel} * width * height),
      context_(CreateContext()) {
  if (context_ == nullptr)
    throw EnvironmentError("off-screen rendering context (OSMesa) cannot be created");
  try {
    const Use tried(*this);
  } catch (...) {
    gl().DestroyContext(context_);
    throw;
  }
}

OffscreenContext::~OffscreenContext() { gl().DestroyContext(context_); }

OffscreenContext::Use::~Use() { gl().MakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

void OffscreenContext::MakeCurrent() {
  if (gl().MakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width_, height_) != GL_TRUE) {
    throw EnvironmentError("the off-screen rendering context of " + std::to_string(width_) + "x" +
                           std::to_string(height_) + " pixels cannot be used (OSMesa)");
  }
}

}  // namespace regrasp::render
