#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// Direction of a camera, radians: azimuth about z from the x axis, elevation above the xy plane.
struct ViewDirection {
  double azimuth = 0;
  double elevation = 0;

  /// Return the unit vector from the object towards the camera.
  [[nodiscard]] Eigen::Vector3d ToCamera() const;
};

/// View settings. Values that are not set are chosen automatically.
struct ViewOptions {
  std::optional<ViewDirection> direction = std::nullopt;
  std::optional<Projection> projection = std::nullopt;
  double zoom = 1;  ///< magnification, > 0; above 1 the border of the scene is cut off
};

/// Viewpoints of a sequence: unit vectors from the object towards the camera.
struct Viewpoints {
  Eigen::Vector3d common;
  /// Own viewpoints of frames that the common one does not show well; one entry per frame.
  std::vector<std::optional<Eigen::Vector3d>> own;
};

/// Poses of object and hand in a frame of a plan for a hand.
struct FramePlacement {
  Eigen::Isometry3d to_body = Eigen::Isometry3d::Identity();
  std::vector<PlacedRays> hand = {};  ///< links of the hand, which partly hide the scene
};

/// Choose camera directions for a sequence of frames.
///
/// Candidates are directions around the object from slightly above and, at a cost, from below. The
/// score of a direction increases with the visibility of
///   - fingertips and stems, which the object and other fingers can hide,
///   - force arrows, which are also shortened if they point at the camera,
///   - finger numbers, which need free space nearer to their own fingertip than to others, and
///   - the object: few faces edge-on and a large image area.
/// It decreases if fingers or cones overlap, or if the camera looks along a stem.
///
/// One direction serves all frames. A finger is not visible enough if another finger or two walls
/// hide its fingertip, if its arrow appears as a point, or if its number has no free space. A frame
/// with such fingers gets its own direction if that shows all of them. A planar object is seen
/// vertically from above.
/// @param frames         fingers of every frame of the sequence.
/// @param largest_force  largest force of the sequence, newtons.
/// @param placements     placement of each frame; empty if the object does not move and there is no
///                       hand.
[[nodiscard]] Viewpoints ChooseViewpoints(const BodyShape& body, bool planar,
                                          const std::vector<std::vector<FingerGlyph>>& frames,
                                          double largest_force,
                                          const std::vector<FramePlacement>& placements = {});

}  // namespace regrasp::render
