#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/plan/snapshot.h"
#include "render/frames/frame.h"
#include "render/picture/moving_picture.h"

namespace regrasp::render {

/// What FrameRenderer::Render is given; what it points to outlives it.
struct FrameTask {
  const plan::Snapshot* snapshot;
  std::string caption;
  const FaultMarks* fault = nullptr;
  int view = kCommonView;
};

/// Draws frames in several threads, each with a copy of the renderer, and hands them on in this one
/// in the order of the tasks, while further ones are drawn. The frames do not depend on the number
/// of workers.
/// @param workers  ≥ 1.
/// @param take     called with the index of a task and its frame.
/// @throws what Render or `take` throws.
void RenderInOrder(const FrameRenderer& renderer, std::span<const FrameTask> tasks, int workers,
                   const std::function<void(int index, const Image& image)>& take);

/// The end of an entry, where the animation rests.
struct AnimationRest {
  plan::Snapshot snapshot;
  std::string moving_caption;  ///< below what leads to it
  std::string caption;
  std::optional<FaultMarks> marks = std::nullopt;  ///< of a failed step
};

/// How an animation is cut: pictures where something moves, whatever its time in the replay, and a
/// rest at the end of every entry. A unit of motion is a fingertip's travel of kMotionUnit
/// diameters, or half of the largest contact force coming or going.
inline constexpr double kMotionUnit = 0.02;
inline constexpr double kPicturesPerUnit = 4;  ///< a finger comes down in ten pictures
inline constexpr int kFewestPictures = 8;      ///< of an entry
inline constexpr int kMostPictures = 64;       ///< of an entry: a long align goes faster
inline constexpr int kPictureTime_ms = kTick_ms;
/// At the first rest one finds one's way about the picture; before the animation begins again the
/// last one can be looked at, longer where it tells what failed.
inline constexpr int kFirstRestTime_ms = 1500;
inline constexpr int kRestTime_ms = 900;
inline constexpr int kLastRestTime_ms = 2500;
inline constexpr int kFailedRestTime_ms = 4000;

/// A plan of many entries has fewer pictures an entry, but one at least and its rest.
inline constexpr int kMostPicturesInAll = 900;

/// How far the replay has come at each sample, in units of motion, ascending. A jump, where a free
/// finger appears somewhere else, counts as little; time counts a little too, so that no two
/// samples are equal.
/// @param largest_force  newtons, > 0.
[[nodiscard]] std::vector<double> MeasureProgress(const std::vector<plan::Snapshot>& samples,
                                                  double diameter_m, double largest_force);

/// The instants of one entry that an animation shows, by their index in `progress`: at most
/// `count`, evenly spaced over what lies in (from, to], ascending, without repetition.
/// @param progress  ascending.
[[nodiscard]] std::vector<int> ChooseInstants(const std::vector<double>& progress, double from,
                                              double to, int count);

/// A picture of an animation, and how long it is shown.
struct AnimationPicture {
  FrameTask frame;
  int duration_ms;
};

/// Cuts a replay into the pictures of an animation: they are spread over what moves, so that a
/// finger is seen to come down, forces to change, and a finger to leave; every entry rests at its
/// end.
/// @param samples  states during the replay, ascending in time; those after the last rest that was
///                 replayed are left out. They and the rests outlive what is returned.
/// @param rests    in the order of the plan, ≥ 1.
[[nodiscard]] std::vector<AnimationPicture> CutAnimation(const std::vector<plan::Snapshot>& samples,
                                                         const std::vector<AnimationRest>& rests,
                                                         double diameter_m);

/// The same of pictures that are chosen already: those before each rest.
/// @param motions  as many as rests; they and the rests outlive what is returned.
[[nodiscard]] std::vector<AnimationPicture> JoinAnimation(
    const std::vector<std::vector<plan::Snapshot>>& motions,
    const std::vector<AnimationRest>& rests);

/// Draws the pictures and writes one file of them in each format. Deterministic, whatever the
/// number of workers.
/// @param renderer    with GapView::kShown.
/// @param pictures    ≥ 1.
/// @param workers     threads that draw, ≥ 1.
/// @param on_picture  called with the number of pictures done, after each.
/// @throws EnvironmentError  no off-screen rendering context, or no encoder.
[[nodiscard]] std::vector<std::string> RenderAnimation(
    const FrameRenderer& renderer, const std::vector<AnimationPicture>& pictures,
    const std::vector<MovingFormat>& formats, int workers,
    const std::function<void(int)>& on_picture = {});

}  // namespace regrasp::render
