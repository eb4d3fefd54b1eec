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
  std::deque<std::future<Image>> frames;
  // A renderer's next task starts when its last one is done.
  const auto start = [&](int index) {
    frames.push_back(std::async(std::launch::async, [&, index] {
      const FrameTask& task = tasks[index];
      return renderers[index % ahead].Render(*task.snapshot, task.caption, task.fault, task.view);
    }));
  };
  for (int index = 0; index < ahead; ++index) start(index);
  for (int index = 0; index < count; ++index) {
    const Image image = frames.front().get();
    frames.pop_front();
    if (index + ahead < count) start(index + ahead);
    take(index, image);
  }
}

namespace {

/// More than this between two samples, in units, is no motion that could be shown.
constexpr double kLargestMotion = 0.25;
constexpr double kStillMotion = 1e-3;

/// So many pictures show all colours: each finger holds in one of them.
constexpr int kMostExamples = 8;

double LargestForce(const std::vector<AnimationRest>& rests) {
  double largest = std::numeric_limits<double>::min();
  for (const AnimationRest& rest : rests) {
    for (const plan::FingerState& finger : rest.snapshot.fingers) {
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

/// How far the replay has come at each rest; the samples up to it belong to its entry.
std::vector<double> ProgressAtRests(const std::vector<plan::Snapshot>& samples,
                                    const std::vector<double>& progress,
                                    const std::vector<AnimationRest>& rests) {
  std::vector<double> at;
  for (const AnimationRest& rest : rests) {
    const auto end =
        std::ranges::upper_bound(samples, rest.snapshot.time_s, {}, &plan::Snapshot::time_s);
    at.push_back(end == samples.begin() ? 0 : progress[end - samples.begin() - 1]);
  }
  return at;
}

/// How many pictures each entry has.
std::vector<int> CountPictures(const std::vector<double>& at_rests) {
  std::vector<int> counts;
  int all = 0;
  double before = 0;
  for (const double at : at_rests) {
    const double wanted = std::ceil(kPicturesPerUnit * (at - before));
    counts.push_back(static_cast<int>(std::clamp<double>(wanted, kFewestPictures, kMostPictures)));
    all += counts.back();
    before = at;
  }
  if (all <= kMostPicturesInAll) return counts;
  for (int& count : counts) count = std::max(1, count * kMostPicturesInAll / all);
  return counts;
}

int RestTime_ms(const std::vector<AnimationRest>& rests, std::size_t entry) {
  if (rests[entry].marks) return kFailedRestTime_ms;
  if (entry + 1 == rests.size()) return kLastRestTime_ms;
  return entry == 0 ? kFirstRestTime_ms : kRestTime_ms;
}

void AddRest(const std::vector<AnimationRest>& rests, std::size_t entry,
             std::vector<AnimationPicture>& pictures) {
  const AnimationRest& rest = rests[entry];
  const FaultMarks* marks = rest.marks ? &*rest.marks : nullptr;
  pictures.push_back({{&rest.snapshot, rest.caption, marks}, RestTime_ms(rests, entry)});
}

/// Some of the rests: they have the colours of the fingers, of forces and of marks.
std::vector<Image> RenderExamples(const FrameRenderer& renderer,
                                  const std::vector<AnimationPicture>& pictures, int workers) {
  std::vector<FrameTask> rests;
  for (const AnimationPicture& picture : pictures) {
    if (picture.duration_ms > kPictureTime_ms) rests.push_back(picture.frame);
  }
  std::vector<FrameTask> chosen;
  const auto count = static_cast<int>(rests.size());
  const int examples = std::min(count, kMostExamples);
  for (int i = 1; i <= examples; ++i) chosen.push_back(rests[count * i / examples - 1]);
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

std::vector<AnimationPicture> JoinAnimation(const std::vector<std::vector<plan::Snapshot>>& motions,
                                            const std::vector<AnimationRest>& rests) {
  std::size_t all = 0;
  for (const auto& motion : motions) all += motion.size();
  const std::size_t stride = 1 + all / (kMostPicturesInAll + 1);
  std::vector<AnimationPicture> pictures;
  for (std::size_t entry = 0; entry < rests.size(); ++entry) {
    for (std::size_t i = stride / 2; i < motions[entry].size(); i += stride) {
      pictures.push_back({{&motions[entry][i], rests[entry].moving_caption}, kPictureTime_ms});
    }
    AddRest(rests, entry, pictures);
  }
  return pictures;
}

std::vector<AnimationPicture> CutAnimation(const std::vector<plan::Snapshot>& samples,
                                           const std::vector<AnimationRest>& rests,
                                           double diameter_m) {
  const std::vector<double> progress = MeasureProgress(samples, diameter_m, LargestForce(rests));
  const std::vector<double> at_rests = ProgressAtRests(samples, progress, rests);
  const std::vector<int> counts = CountPictures(at_rests);
  std::vector<AnimationPicture> pictures;
  double from = 0;
  for (std::size_t entry = 0; entry < rests.size(); ++entry) {
    const AnimationRest& rest = rests[entry];
    for (const int at : ChooseInstants(progress, from, at_rests[entry], counts[entry])) {
      pictures.push_back({{&samples[at], rest.moving_caption}, kPictureTime_ms});
    }
    AddRest(rests, entry, pictures);
    from = at_rests[entry];
  }
  return pictures;
}

std::vector<std::string> RenderAnimation(const FrameRenderer& renderer,
                                         const std::vector<AnimationPicture>& pictures,
                                         const std::vector<MovingFormat>& formats, int workers,
                                         const std::function<void(int)>& on_picture) {
  if (pictures.empty()) throw std::invalid_argument("RenderAnimation: no picture");
  const bool has_gif = std::ranges::find(formats, MovingFormat::kGif) != formats.end();
  const std::vector<Image> examples =
      has_gif ? RenderExamples(renderer, pictures, workers) : std::vector<Image>();
  std::vector<std::unique_ptr<MovingPicture>> files;
  std::vector<FrameTask> tasks;
  for (const AnimationPicture& picture : pictures) tasks.push_back(picture.frame);
  RenderInOrder(renderer, tasks, workers, [&](int index, const Image& image) {
    for (std::size_t i = files.size(); i < formats.size(); ++i) {
      files.push_back(MakeMovingPicture(formats[i], image.width, image.height, examples));
    }
    for (const auto& file : files) file->Add(image, pictures[index].duration_ms);
    if (on_picture) on_picture(index + 1);
  });
  std::vector<std::string> bytes;
  for (const auto& file : files) bytes.push_back(file->Finish());
  return bytes;
}

}  // namespace regrasp::render
