#include "render/frames/replay_animation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

namespace regrasp::render {

void RenderInOrder(const FrameRenderer& renderer, std::span<const FrameTask> tasks, int workers,
                   const std::function<void(int index, const Image& image)>& take) {
  const auto count = static_cast<int>(tasks.size());
  const int ahead = std::min(workers, count);
  std::vector<FrameRenderer> renderers(ahead, renderer);
  std::deque<std::future<Image>> pending;
  // The next task of a renderer starts after its previous one.
  const auto start = [&](int index) {
    pending.push_back(std::async(std::launch::async, [&, index] {
      const FrameTask& task = tasks[index];
      return renderers[index % ahead].Render(*task.snapshot, task.caption, task.fault, task.view);
    }));
  };
  for (int index = 0; index < ahead; ++index) start(index);
  for (int index = 0; index < count; ++index) {
    const Image image = pending.front().get();
    pending.pop_front();
    if (index + ahead < count) start(index + ahead);
    take(index, image);
  }
}

namespace {

/// Maximum motion between two samples, in units. Larger motions cannot be displayed.
constexpr double kLargestMotion = 0.25;
constexpr double kStillMotion = 1e-3;

/// Number of example frames for a palette: each finger is in contact in one of them.
constexpr int kMostExamples = 8;

double LargestForce(const std::vector<AnimationPause>& pauses) {
  double largest = std::numeric_limits<double>::min();
  for (const AnimationPause& pause : pauses) {
    for (const plan::FingerState& finger : pause.snapshot.fingers) {
      largest = std::max(largest, finger.force_W.norm());
    }
  }
  return largest;
}

double MotionBetween(const plan::Snapshot& a, const plan::Snapshot& b, double diameter_m,
                     double largest_force) {
  double most = 0;
  for (const plan::FingerState& after : b.fingers) {
    const auto before = std::ranges::find(a.fingers, after.finger, &plan::FingerState::finger);
    if (before == a.fingers.end()) continue;
    const double travel = (after.tip_W - before->tip_W).norm() / (kMotionUnit * diameter_m);
    const double force = 2 * (after.force_W - before->force_W).norm() / largest_force;
    most = std::max({most, travel, force});
  }
  return std::isfinite(most) ? std::min(most, kLargestMotion) : kLargestMotion;
}

/// Return the accumulated motion at each pause. The samples up to it belong to its entry.
std::vector<double> ProgressAtPauses(const std::vector<plan::Snapshot>& samples,
                                     const std::vector<double>& progress,
                                     const std::vector<AnimationPause>& pauses) {
  std::vector<double> at;
  for (const AnimationPause& pause : pauses) {
    const auto end =
        std::ranges::upper_bound(samples, pause.snapshot.time_s, {}, &plan::Snapshot::time_s);
    at.push_back(end == samples.begin() ? 0 : progress[end - samples.begin() - 1]);
  }
  return at;
}

/// Return the number of frames of each entry.
std::vector<int> CountFrames(const std::vector<double>& at_pauses) {
  std::vector<int> counts;
  int all = 0;
  double before = 0;
  for (const double at : at_pauses) {
    const double wanted = std::ceil(kFramesPerUnit * (at - before));
    counts.push_back(
        static_cast<int>(std::clamp<double>(wanted, kMinEntryFrames, kMaxEntryFrames)));
    all += counts.back();
    before = at;
  }
  if (all <= kMaxFrames) return counts;
  for (int& count : counts) count = std::max(1, count * kMaxFrames / all);
  return counts;
}

int PauseTime_ms(const std::vector<AnimationPause>& pauses, std::size_t entry) {
  if (pauses[entry].marks) return kFailurePause_ms;
  if (entry + 1 == pauses.size()) return kLastPause_ms;
  return entry == 0 ? kFirstPause_ms : kPause_ms;
}

void AddPause(const std::vector<AnimationPause>& pauses, std::size_t entry,
              std::vector<AnimationFrame>& frames) {
  const AnimationPause& pause = pauses[entry];
  const FaultMarks* marks = pause.marks ? &*pause.marks : nullptr;
  frames.push_back({{&pause.snapshot, pause.caption, marks}, PauseTime_ms(pauses, entry)});
}

/// Render some of the pauses. They contain the colours of fingers, forces and marks.
std::vector<Image> RenderExamples(const FrameRenderer& renderer,
                                  const std::vector<AnimationFrame>& frames, int workers) {
  std::vector<FrameTask> pauses;
  for (const AnimationFrame& frame : frames) {
    if (frame.duration_ms > kFrameTime_ms) pauses.push_back(frame.task);
  }
  std::vector<FrameTask> chosen;
  const auto count = static_cast<int>(pauses.size());
  const int examples = std::min(count, kMostExamples);
  for (int i = 1; i <= examples; ++i) chosen.push_back(pauses[count * i / examples - 1]);
  std::vector<Image> images;
  RenderInOrder(renderer, chosen, workers,
                [&images](int, const Image& image) { images.push_back(image); });
  return images;
}

}  // namespace

std::vector<double> MeasureProgress(const std::vector<plan::Snapshot>& samples, double diameter_m,
                                    double largest_force) {
  std::vector<double> progress;
  double sum = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += kStillMotion;
    if (i > 0) sum += MotionBetween(samples[i - 1], samples[i], diameter_m, largest_force);
    progress.push_back(sum);
  }
  return progress;
}

std::vector<int> ChooseInstants(const std::vector<double>& progress, double from, double to,
                                int count) {
  const auto first = std::upper_bound(progress.begin(), progress.end(), from);
  const auto last = std::upper_bound(first, progress.end(), to);
  std::vector<int> chosen;
  if (first == last) return chosen;
  for (int i = 0; i < count; ++i) {
    const double place = *first + (i + 0.5) / count * (*(last - 1) - *first);
    const auto at = static_cast<int>(std::lower_bound(first, last - 1, place) - progress.begin());
    if (chosen.empty() || chosen.back() != at) chosen.push_back(at);
  }
  return chosen;
}

std::vector<AnimationFrame> JoinAnimation(const std::vector<std::vector<plan::Snapshot>>& motions,
                                          const std::vector<AnimationPause>& pauses) {
  std::size_t all = 0;
  for (const auto& motion : motions) all += motion.size();
  const std::size_t stride = 1 + all / (kMaxFrames + 1);
  std::vector<AnimationFrame> frames;
  for (std::size_t entry = 0; entry < pauses.size(); ++entry) {
    for (std::size_t i = stride / 2; i < motions[entry].size(); i += stride) {
      frames.push_back({{&motions[entry][i], pauses[entry].moving_caption}, kFrameTime_ms});
    }
    AddPause(pauses, entry, frames);
  }
  return frames;
}

std::vector<AnimationFrame> CutAnimation(const std::vector<plan::Snapshot>& samples,
                                         const std::vector<AnimationPause>& pauses,
                                         double diameter_m) {
  const std::vector<double> progress = MeasureProgress(samples, diameter_m, LargestForce(pauses));
  const std::vector<double> at_pauses = ProgressAtPauses(samples, progress, pauses);
  const std::vector<int> counts = CountFrames(at_pauses);
  std::vector<AnimationFrame> frames;
  double from = 0;
  for (std::size_t entry = 0; entry < pauses.size(); ++entry) {
    const AnimationPause& pause = pauses[entry];
    for (const int at : ChooseInstants(progress, from, at_pauses[entry], counts[entry])) {
      frames.push_back({{&samples[at], pause.moving_caption}, kFrameTime_ms});
    }
    AddPause(pauses, entry, frames);
    from = at_pauses[entry];
  }
  return frames;
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
    for (const auto& file : files) file->Add(image, frames[index].duration_ms);
    if (on_frame) on_frame(index + 1);
  });
  std::vector<std::string> bytes;
  for (const auto& file : files) bytes.push_back(file->Finish());
  return bytes;
}

}  // namespace regrasp::render
