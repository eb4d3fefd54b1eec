#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"

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

/// Where the pictures of a sequence are taken from.
///
/// Tries directions around the object from a little above (and, less gladly, from below) and takes
/// the one that sees most of each finger before the object, that has fingers and cones apart, that
/// looks along no stem, and that sees much of the object: few faces edge-on, its parts side by
/// side. A planar object is seen from straight above.
/// @param frames  the fingers of every frame of the sequence.
/// @returns the unit vector from the object towards the camera.
[[nodiscard]] Eigen::Vector3d ChooseViewpoint(const BodyShape& body, bool planar,
                                              const std::vector<std::vector<FingerGlyph>>& frames);

}  // namespace regrasp::render
