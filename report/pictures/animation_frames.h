#pragma once

#include <deque>
#include <vector>

#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "render/frames/replay_animation.h"
#include "report/pictures/hand_picture.h"
#include "report/pictures/replay_timeline.h"
#include "report/pictures/report_pictures.h"

namespace regrasp::report {

/// The frames of an animation, with the states that they show.
struct AnimationFrames {
  std::deque<plan::Snapshot> snapshots;
  std::vector<render::AnimationFrame> frames;
};

/// Divide a replay into the frames of an animation.
///
/// States between two samples are interpolated. A frame in which nothing moves visibly prolongs the
/// frame before it. If the last entry failed, its pause shows its own frame with marks.
/// @param shown     entries of the replay; must outlive the result.
/// @param timeline  motion of these entries.
/// @param fingers   fingers of the samples (FingersOf).
/// @param hand      hand of the plan; null: fingers without a hand.
[[nodiscard]] AnimationFrames MakeAnimationFrames(const plan::Plan& plan,
                                                  const std::vector<ShownEntry>& shown,
                                                  const ReplayTimeline& timeline,
                                                  const std::vector<FingerIndex>& fingers,
                                                  const HandPicture* hand, double diameter_m);

}  // namespace regrasp::report
