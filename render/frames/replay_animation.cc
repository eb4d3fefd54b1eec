#include "render/frames/replay_animation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "render/picture/caption.h"
#include "render/picture/webp.h"

namespace regrasp::render {

namespace {

/// More than this between two samples, in units, is no motion that could be shown.
constexpr double kLargestMotion = 0.25;
constexpr double kStillMotion = 1e-3;

double LargestForce(const std::vector<plan::Snapshot>& rests) {
  double largest = 0;
  for (const plan::Snapshot& rest : rests) {
    for (const plan::FingerState& finger : rest.fingers) {
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
                                    const std::vector<plan::Snapshot>& rests) {
  std::vector<double> at;
  for (const plan::Snapshot& rest : rests) {
    const auto end = std::ranges::upper_bound(samples, rest.time_s, {}, &plan::Snapshot::time_s);
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

std::string RenderAnimation(const object::Object& object, const plan::Plan& plan, double half_angle,
                            const std::vector<plan::Snapshot>& samples,
                            const std::vector<plan::Snapshot>& rests,
                            const AnimationOptions& options,
                            const std::function<void(int)>& on_entry) {
  if (rests.empty()) throw std::invalid_argument("RenderAnimation: nothing was replayed");
  FrameOptions frame;
  frame.width = options.width;
  frame.height = options.height;
  frame.body.thickness = options.thickness;
  frame.gaps = GapView::kShown;
  FrameRenderer renderer(object, plan.scale, half_angle, rests, frame);
  WebpAnimation animation(options.width, options.height);
  const double largest_force = std::max(LargestForce(rests), std::numeric_limits<double>::min());
  const std::vector<double> progress =
      MeasureProgress(samples, plan.scale * object.diameter(), largest_force);
  const std::vector<double> at_rests = ProgressAtRests(samples, progress, rests);
  const std::vector<int> counts = CountPictures(at_rests);
  double from = 0;
  for (std::size_t entry = 0; entry < rests.size(); ++entry) {
    const std::string caption = FrameCaption(plan, plan::EntryIndex(static_cast<int>(entry)));
    for (const int at : ChooseInstants(progress, from, at_rests[entry], counts[entry])) {
      animation.Add(renderer.Render(samples[at], caption), kPictureTime_ms);
    }
    animation.Add(renderer.Render(rests[entry], caption), kRestTime_ms);
    from = at_rests[entry];
    if (on_entry) on_entry(static_cast<int>(entry) + 1);
  }
  return animation.Finish();
}

}  // namespace regrasp::render
