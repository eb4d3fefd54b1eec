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

  /// While it exists, OpenGL's functions of this thread draw here. Another thread's may do so
  /// afterwards.
  class Use {
   public:
    explicit Use(OffscreenContext& context) { context.MakeCurrent(); }
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
  };
  /// What was drawn, once glFinish was called.
  [[nodiscard]] const std::vector<unsigned char>& pixels() const { return pixels_; }

 private:
  void MakeCurrent();

  int width_, height_;
  std::vector<unsigned char> pixels_;
  osmesa_context* context_;
};

}  // namespace regrasp::render
