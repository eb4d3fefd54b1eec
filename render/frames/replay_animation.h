#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <future>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "planner/plan/projection.h"
#include "render/frames/frame.h"
#include "render/picture/animation.h"

namespace regrasp::render {

/// Arguments of FrameRenderer::Render. Referenced objects must outlive the task.
struct FrameTask {
  const plan::Snapshot* snapshot;
  FrameText text;
  const FaultMarks* fault = nullptr;
  int view = kCommonView;
};

/// Draw in several threads, each with a copy of the renderer, and pass the results on in order.
///
/// `take` is called in the calling thread while further results are drawn. Results do not depend on
/// the number of workers.
/// @param count    number of results.
/// @param workers  number of threads, ≥ 1.
/// @param draw     function from a renderer and an index to a result.
/// @param take     function that is called with an index and its result.
/// @throws exceptions of `draw` and `take`.
template <class Draw, class Take>
void DrawInOrder(const FrameRenderer& renderer, int count, int workers, const Draw& draw,
                 const Take& take) {
  using Drawn = std::invoke_result_t<const Draw&, FrameRenderer&, int>;
  const int ahead = std::min(workers, count);
  std::vector<FrameRenderer> renderers(ahead, renderer);
  std::deque<std::future<Drawn>> pending;
  // The next task of a renderer starts after its previous one.
  const auto start = [&](int index) {
    pending.push_back(std::async(std::launch::async,
                                 [&, index] { return draw(renderers[index % ahead], index); }));
  };
  for (int index = 0; index < ahead; ++index) start(index);
  for (int index = 0; index < count; ++index) {
    const Drawn drawn = pending.front().get();
    pending.pop_front();
    if (index + ahead < count) start(index + ahead);
    take(index, drawn);
  }
}

/// Draw frames in several threads and pass them on in order (DrawInOrder).
/// @param take  function that is called with the index of a task and its frame.
/// @throws exceptions of Render and `take`.
void RenderInOrder(const FrameRenderer& renderer, std::span<const FrameTask> tasks, int workers,
                   const std::function<void(int index, const Image& image)>& take);

/// Longest animation of a plan with up to kUsualEntries entries, seconds. Longer plans have a
/// proportionally longer animation, up to kLongestOfAll_s.
inline constexpr double kLongest_s = 30;
inline constexpr int kUsualEntries = 19;
inline constexpr double kLongestOfAll_s = 60;

/// Durations of the pauses at the ends of entries, frames. The first one leaves time to understand
/// the image. The last one precedes the repetition, and is longer if it shows a failure. Animations
/// that would be longer than kLongestOfAll_s have pauses of one frame after the other entries.
inline constexpr int kFirstPause = 24;
inline constexpr int kPause = 8;
inline constexpr int kLastPause = 45;
inline constexpr int kFailurePause = 90;

/// Speeds are multiples of this number.
inline constexpr double kSpeedStep = 0.5;

/// An instant of a replay that an animation shows.
struct AnimationInstant {
  int entry;
  double time_s;  ///< time of the replay
  int frames;     ///< duration in the animation
};

struct AnimationSchedule {
  double speed = 1;  ///< time of the replay per time of the animation, ≥ 1
  std::vector<AnimationInstant> instants;
};

/// Choose the speed of an animation and the instants that it shows.
///
/// The speed is the same throughout: the least multiple of kSpeedStep for which the animation is
/// short enough. Each entry ends with a pause.
/// @param ends   times at which the entries end, seconds, ascending, at least one. The first entry
///               starts at 0.
/// @param fails  whether the last entry fails.
[[nodiscard]] AnimationSchedule ScheduleAnimation(std::span<const double> ends, bool fails);

/// A frame of an animation and its duration in frames of the file.
struct AnimationFrame {
  FrameTask task;
  int frames;
};

/// Draw the frames and encode one file per format. The result does not depend on `workers`.
/// @param renderer  renderer of animated frames (FrameOptions::animated).
/// @param frames    frames of the animation, ≥ 1.
/// @param workers   number of threads that draw, ≥ 1.
/// @param on_frame  function that is called with the number of finished frames.
/// @throws EnvironmentError  if off-screen rendering or the encoder is not available.
[[nodiscard]] std::vector<std::string> RenderAnimation(
    const FrameRenderer& renderer, const std::vector<AnimationFrame>& frames,
    const std::vector<AnimationFormat>& formats, int workers,
    const std::function<void(int)>& on_frame = {});

}  // namespace regrasp::render
