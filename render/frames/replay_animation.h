#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/plan/projection.h"
#include "render/frames/frame.h"
#include "render/picture/animation.h"

namespace regrasp::render {

/// Arguments of FrameRenderer::Render. Referenced objects must outlive the task.
struct FrameTask {
  const plan::Snapshot* snapshot;
  std::string caption;
  const FaultMarks* fault = nullptr;
  int view = kCommonView;
};

/// Draw frames in several threads, each with a copy of the renderer, and pass them on in order.
///
/// `take` is called in the calling thread while further frames are drawn. Frames do not depend on
/// the number of workers.
/// @param workers  number of threads, ≥ 1.
/// @param take     function that is called with the index of a task and its frame.
/// @throws exceptions of Render and `take`.
void RenderInOrder(const FrameRenderer& renderer, std::span<const FrameTask> tasks, int workers,
                   const std::function<void(int index, const Image& image)>& take);

/// The end of a plan entry, at which the animation pauses.
struct AnimationPause {
  plan::Snapshot snapshot;
  std::string moving_caption;  ///< caption of the frames before it
  std::string caption;
  std::optional<FaultMarks> marks = std::nullopt;  ///< marks of a failed step
};

/// Fingertip travel per unit of motion, in diameters. The other unit of motion is half of the
/// largest contact force appearing or disappearing. An animation has frames in proportion to
/// motion, independent of time, and a pause at the end of each entry.
inline constexpr double kMotionUnit = 0.02;
/// Frames per unit of motion: about ten for a finger that is placed.
inline constexpr double kFramesPerUnit = 4;
inline constexpr int kMinEntryFrames = 8;  ///< minimum number of frames of an entry
/// Maximum number of frames of an entry: longer motions are faster.
inline constexpr int kMaxEntryFrames = 64;
inline constexpr int kFrameTime_ms = kTick_ms;
/// Durations of pauses. The first one leaves time to understand the image. The last one precedes
/// the repetition, and is longer if it shows a failure.
inline constexpr int kFirstPause_ms = 1500;
inline constexpr int kPause_ms = 900;
inline constexpr int kLastPause_ms = 2500;
inline constexpr int kFailurePause_ms = 4000;

/// Maximum number of frames of an animation. Entries of long plans have fewer frames, but at least
/// one and a pause.
inline constexpr int kMaxFrames = 900;

/// Compute the accumulated motion at each sample, in units of motion, ascending.
///
/// Jumps, when a free finger appears at another position, have a limited contribution. Time
/// contributes slightly, so that the values are distinct.
/// @param diameter_m     diameter of the object, metres.
/// @param largest_force  largest contact force, newtons, > 0.
[[nodiscard]] std::vector<double> MeasureProgress(const std::vector<plan::Snapshot>& samples,
                                                  double diameter_m, double largest_force);

/// Choose the instants of an entry that an animation shows.
/// @param progress  accumulated motion per sample, ascending.
/// @param from, to  motion at the start (exclusive) and the end (inclusive) of the entry.
/// @returns at most `count` indices into `progress`, evenly spaced in motion, strictly ascending.
[[nodiscard]] std::vector<int> ChooseInstants(const std::vector<double>& progress, double from,
                                              double to, int count);

/// A frame of an animation and its duration.
struct AnimationFrame {
  FrameTask task;
  int duration_ms;
};

/// Divide a replay into the frames of an animation, evenly spaced in motion, with a pause per
/// entry.
/// @param samples  states of the replay, ascending in time. States after the last pause are
///                 ignored. Samples and pauses must outlive the result.
/// @param pauses   ends of the entries, in plan order, ≥ 1.
/// @param diameter_m  diameter of the object, metres.
[[nodiscard]] std::vector<AnimationFrame> CutAnimation(const std::vector<plan::Snapshot>& samples,
                                                       const std::vector<AnimationPause>& pauses,
                                                       double diameter_m);

/// Combine given frames and pauses into an animation.
/// @param motions  states before each pause. Motions and pauses must outlive the result.
[[nodiscard]] std::vector<AnimationFrame> JoinAnimation(
    const std::vector<std::vector<plan::Snapshot>>& motions,
    const std::vector<AnimationPause>& pauses);

/// Draw the frames and encode one file per format. The result does not depend on `workers`.
/// @param renderer  renderer with GapView::kShown.
/// @param frames    frames of the animation, ≥ 1.
/// @param workers   number of threads that draw, ≥ 1.
/// @param on_frame  function that is called with the number of finished frames.
/// @throws EnvironmentError  if there is no off-screen rendering context or no encoder.
[[nodiscard]] std::vector<std::string> RenderAnimation(
    const FrameRenderer& renderer, const std::vector<AnimationFrame>& frames,
    const std::vector<AnimationFormat>& formats, int workers,
    const std::function<void(int)>& on_frame = {});

}  // namespace regrasp::render
