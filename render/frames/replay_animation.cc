#include "render/frames/replay_animation.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace regrasp::render {

void RenderInOrder(const FrameRenderer& renderer, std::span<const FrameTask> tasks, int workers,
                   const std::function<void(int index, const Image& image)>& take) {
  DrawInOrder(
      renderer, static_cast<int>(tasks.size()), workers,
      [&tasks](FrameRenderer& drawer, int index) {
        const FrameTask& task = tasks[index];
        return drawer.Render(*task.snapshot, task.text, task.fault, task.view);
      },
      take);
}

namespace {

/// Number of example frames for a palette: each finger is in contact in one of them.
constexpr int kMostExamples = 8;

int PauseOf(std::size_t entry, std::size_t entries, bool fails) {
  if (entry + 1 == entries) return fails ? kFailurePause : kLastPause;
  return entry == 0 ? kFirstPause : kPause;
}

/// Return the longest duration of an animation, frames.
int MostFrames(std::size_t entries) {
  const double longest = kLongest_s * std::max(1.0, static_cast<double>(entries) / kUsualEntries);
  return static_cast<int>(kFramesPerSecond * std::min(longest, kLongestOfAll_s));
}

/// Render some evenly spaced frames, and the last one. They contain the colours of fingers, forces
/// and marks.
std::vector<Image> RenderExamples(const FrameRenderer& renderer,
                                  const std::vector<AnimationFrame>& frames, int workers) {
  std::vector<FrameTask> chosen;
  const auto count = static_cast<int>(frames.size());
  const int examples = std::min(count, kMostExamples);
  for (int i = 1; i <= examples; ++i) chosen.push_back(frames[count * i / examples - 1].task);
  std::vector<Image> images;
  RenderInOrder(renderer, chosen, workers,
                [&images](int, const Image& image) { images.push_back(image); });
  return images;
}

}  // namespace

AnimationSchedule ScheduleAnimation(std::span<const double> ends, bool fails) {
  std::vector<int> pauses;
  for (std::size_t i = 0; i < ends.size(); ++i) pauses.push_back(PauseOf(i, ends.size(), fails));
  const int most = MostFrames(ends.size());
  int paused = std::accumulate(pauses.begin(), pauses.end(), 0);
  if (2 * paused > most) {
    for (std::size_t i = 1; i + 1 < pauses.size(); ++i) pauses[i] = 1;
    paused = std::accumulate(pauses.begin(), pauses.end(), 0);
  }
  const int free = std::max(1, most - paused);
  const double needed = kFramesPerSecond * ends.back() / free;
  AnimationSchedule schedule;
  schedule.speed = std::max(1.0, std::ceil(needed / kSpeedStep) * kSpeedStep);
  const double interval_s = schedule.speed / kFramesPerSecond;
  double start_s = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const int entry = static_cast<int>(i);
    // The end of the entry before it is already shown.
    constexpr double kRounding = 1e-9;
    const int count = static_cast<int>(std::ceil((ends[i] - start_s) / interval_s - kRounding)) - 1;
    for (int k = 1; k <= count; ++k) {
      schedule.instants.push_back({entry, ends[i] - (count + 1 - k) * interval_s, 1});
    }
    schedule.instants.push_back({entry, ends[i], pauses[i]});
    start_s = ends[i];
  }
  return schedule;
}

std::vector<std::string> RenderAnimation(const FrameRenderer& renderer,
                                         const std::vector<AnimationFrame>& frames,
                                         const std::vector<AnimationFormat>& formats, int workers,
                                         const std::function<void(int)>& on_frame) {
  if (frames.empty()) throw std::invalid_argument("RenderAnimation: expected at least one frame");
  const bool has_gif = std::ranges::find(formats, AnimationFormat::kGif) != formats.end();
  const std::vector<Image> examples =
      has_gif ? RenderExamples(renderer, frames, workers) : std::vector<Image>();
  std::vector<std::unique_ptr<Animation>> files;
  std::vector<FrameTask> tasks;
  for (const AnimationFrame& frame : frames) tasks.push_back(frame.task);
  RenderInOrder(renderer, tasks, workers, [&](int index, const Image& image) {
    for (std::size_t i = files.size(); i < formats.size(); ++i) {
      files.push_back(MakeAnimation(formats[i], image.width, image.height, examples));
    }
    for (const auto& file : files) file->Add(image, frames[index].frames);
    if (on_frame) on_frame(index + 1);
  });
  std::vector<std::string> bytes;
  for (const auto& file : files) bytes.push_back(file->Finish());
  return bytes;
}

}  // namespace regrasp::render
