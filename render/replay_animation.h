#pragma once

#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/snapshot.h"
#include "render/frame.h"

namespace regrasp {

struct AnimationOptions {
  int width = 640;
  int height = 480;
  double thickness = kUsualThickness;  ///< of the prism of a planar object, in diameters
};

/// How an animation is cut: every entry of a plan has the same number of pictures, evenly over its
/// time, and then rests.
inline constexpr int kPicturesPerEntry = 16;
inline constexpr int kPictureTime_ms = 50;  ///< 20 pictures a second
inline constexpr int kRestTime_ms = 900;

/// A plan of more entries than this has fewer pictures an entry, but one at least and its rest.
inline constexpr int kMostFullEntries = 40;

/// The instants of one entry that an animation shows, by their index in `times`: at most `count`,
/// evenly spaced over the times in (from, to], ascending, without repetition.
/// @param times  ascending.
[[nodiscard]] std::vector<int> ChooseInstants(const std::vector<double>& times, double from,
                                              double to, int count);

/// The whole replay as an animated WebP file, slowed down: each entry takes
/// kPicturesPerEntry · kPictureTime_ms whatever its time in the replay, and rests at its end.
/// Deterministic.
/// @param samples  states during the replay, ascending in time.
/// @param rests    the state after each entry that was replayed, in the order of the plan, ≥ 1.
/// @throws EnvironmentError       no off-screen rendering context.
/// @throws std::invalid_argument  a size that frames cannot have, or no rest.
[[nodiscard]] std::string RenderAnimation(const Object& object, const Plan& plan, double half_angle,
                                          const std::vector<Snapshot>& samples,
                                          const std::vector<Snapshot>& rests,
                                          const AnimationOptions& options = {});

}  // namespace regrasp
