#pragma once

#include <vector>

struct osmesa_context;

namespace regrasp::render {

/// An OSMesa context of OpenGL (compatibility profile) with the memory that it draws in: RGBA, 8
/// bits a channel, rows from the bottom, and a depth buffer.
class OffscreenContext {
 public:
  /// @throws EnvironmentError  it cannot be made, or not in this size.
  OffscreenContext(int width, int height);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// OpenGL's functions of this thread draw here from now on.
  void MakeCurrent();
  /// What was drawn, once glFinish was called.
  [[nodiscard]] const std::vector<unsigned char>& pixels() const { return pixels_; }

 private:
  int width_, height_;
  std::vector<unsigned char> pixels_;
  osmesa_context* context_;
};

}  // namespace regrasp::render
