#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"
#include "planner/kinematics/hand_visuals.h"
#include "render/picture/image.h"

namespace regrasp::render {

struct HandPictureOptions {
  int width = 1280;  ///< pixels at most: what would be empty at the sides is cropped
  int height = 960;
  int supersampling = 3;
};

/// A picture of a hand at rest, seen from its palmar side or, where its fingers stand on the palm,
/// obliquely from above: its links, the balls of its fingertips in the fingers' colours through
/// them, with name and radius, an arrow that points up from the palm's origin, and a scale bar.
/// What is above the palm is left out.
///
/// Deterministic: the same hand gives the same bytes.
/// @param caption  written below it.
/// @throws EnvironmentError  no off-screen rendering context.
[[nodiscard]] Image DrawHand(const kinematics::HandModel& hand,
                             const std::vector<kinematics::LinkVisual>& visuals,
                             const std::string& caption, const HandPictureOptions& options = {});

}  // namespace regrasp::render
