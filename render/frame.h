#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/snapshot.h"

namespace regrasp {

/// An image, 8 bits RGB, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;  ///< 3 · width · height
};

/// @throws EnvironmentError  the file cannot be written.
void WritePng(const std::filesystem::path& path, const Image& image);

struct FrameOptions {
  int width = 1280;
  int height = 960;
  int supersampling = 2;  ///< rendered this many times as large along both axes, then averaged
};

/// Draws frames of a replay: the object translucent with its feature edges, fingers as a ball and a
/// stem along the normal, one colour a finger for the whole sequence, true friction cones, force
/// arrows, and the finger that moves told apart.
///
/// One renderer serves a whole plan, with one camera, so that frames can be laid side by side. The
/// camera is chosen once so that the contacts of all `snapshots` are seen as well as possible.
class FrameRenderer {
 public:
  /// @param scale       metres per unit of the object.
  /// @param half_angle  of the friction cones drawn, radians.
  /// @param snapshots   of the whole sequence, to choose the camera.
  /// @throws EnvironmentError  no off-screen rendering context.
  FrameRenderer(const Object& object, double scale, double half_angle,
                const std::vector<Snapshot>& snapshots, const FrameOptions& options = {});
  ~FrameRenderer();
  FrameRenderer(FrameRenderer&&) noexcept;
  FrameRenderer& operator=(FrameRenderer&&) noexcept;

  [[nodiscard]] Image Render(const Snapshot& snapshot);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp
