#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/ray_tree.h"

namespace regrasp::render {

/// Where a camera stands, radians: azimuth about z from the x axis, elevation above the plane of x
/// and y.
struct ViewDirection {
  double azimuth = 0;
  double elevation = 0;

  /// The unit vector from the object towards the camera.
  [[nodiscard]] Eigen::Vector3d ToCamera() const;
};

/// How pictures are taken; what is not given is chosen.
struct ViewOptions {
  std::optional<ViewDirection> direction = std::nullopt;
  std::optional<Projection> projection = std::nullopt;
  double zoom = 1;  ///< > 0; beyond 1 what is at the border is cut off
};

/// Where the pictures of a sequence are taken from: unit vectors from the object towards the
/// camera.
struct Viewpoints {
  Eigen::Vector3d common;
  /// Of each frame that is not seen well enough from there, and better from elsewhere.
  std::vector<std::optional<Eigen::Vector3d>> own;
};

/// How body and hand stand in a frame of a plan for a hand.
struct Standing {
  Eigen::Isometry3d to_body = Eigen::Isometry3d::Identity();
  std::vector<PlacedRays> hand = {};  ///< hides what is behind it, but not quite
};

/// Tries directions around the object from a little above (and, less gladly, from below) and takes
/// the one that sees most of each finger: of its ball and stem, which the object and other fingers
/// hide, of its force arrow, which is also the shorter the more it points at the camera, and of its
/// label, which needs a free place beside it and nearer to its own ball than to others; that has
/// fingers and cones apart, that looks along no stem, and that sees much of the object: few faces
/// edge-on, its parts side by side.
///
/// One direction serves all frames. A finger is not seen well enough where its ball is hidden by
/// another finger or behind two walls, its arrow is a point, or its label has no place of its own.
/// A frame with such fingers has a direction of its own if one shows more of them.
///
/// A planar object is seen from straight above.
/// @param frames         the fingers of every frame of the sequence.
/// @param largest_force  of the whole sequence, newtons.
/// @param standing       of each frame; empty: the body is where it is, and there is no hand.
[[nodiscard]] Viewpoints ChooseViewpoints(const BodyShape& body, bool planar,
                                          const std::vector<std::vector<FingerGlyph>>& frames,
                                          double largest_force,
                                          const std::vector<Standing>& standing = {});

}  // namespace regrasp::render
