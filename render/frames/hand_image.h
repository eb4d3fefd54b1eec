#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"
#include "planner/kinematics/hand_visuals.h"
#include "render/picture/image.h"

namespace regrasp::render {

struct HandImageOptions {
  int width = 1280;  ///< maximum width, pixels; empty space at the sides is cropped
  int height = 960;
  int supersampling = 3;
};

/// Draw a hand with all joints at zero.
///
/// The hand is seen from its palmar side, or obliquely from above if its fingers point away from
/// the palm. The image shows links, fingertip spheres in the colours of the fingers, their names
/// and radii, the axes of the palm frame and the direction up, and a scale bar. Links above the
/// palm are omitted. Deterministic: the same hand gives the same bytes.
/// @param caption  text below the hand.
/// @throws EnvironmentError  if off-screen rendering is not available.
[[nodiscard]] Image DrawHand(const kinematics::HandModel& hand,
                             const std::vector<kinematics::LinkVisual>& visuals,
                             const std::string& caption, const HandImageOptions& options = {});

}  // namespace regrasp::render
