#include "render/replay_animation.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "render/caption.h"
#include "render/webp.h"

namespace regrasp {

std::vector<int> ChooseInstants(const std::vector<double>& times, double from, double to,
                                int count) {
  const auto first = std::upper_bound(times.begin(), times.end(), from);
  const auto last = std::upper_bound(first, times.end(), to);
  std::vector<int> chosen;
  if (first == last) return chosen;
  for (int i = 0; i < count; ++i) {
    const double time = *first + (i + 0.5) / count * (*(last - 1) - *first);
    const auto at = static_cast<int>(std::lower_bound(first, last - 1, time) - times.begin());
    if (chosen.empty() || chosen.back() != at) chosen.push_back(at);
  }
  return chosen;
}

std::string RenderAnimation(const Object& object, const Plan& plan, double half_angle,
                            const std::vector<Snapshot>& samples,
                            const std::vector<Snapshot>& rests, const AnimationOptions& options) {
  if (rests.empty()) throw std::invalid_argument("RenderAnimation: nothing was replayed");
  FrameOptions frame;
  frame.width = options.width;
  frame.height = options.height;
  frame.thickness = options.thickness;
  FrameRenderer renderer(object, plan.scale, half_angle, rests, frame);
  WebpAnimation animation(options.width, options.height);
  std::vector<double> times;
  for (const Snapshot& sample : samples) times.push_back(sample.time_s);
  const auto entries = static_cast<int>(rests.size());
  const int count =
      std::clamp(kPicturesPerEntry * kMostFullEntries / entries, 1, kPicturesPerEntry);
  double from = -std::numeric_limits<double>::infinity();
  for (int entry = 0; entry < entries; ++entry) {
    const std::string caption = FrameCaption(plan, entry);
    for (const int at : ChooseInstants(times, from, rests[entry].time_s, count)) {
      animation.Add(renderer.Render(samples[at], caption), kPictureTime_ms);
    }
    animation.Add(renderer.Render(rests[entry], caption), kRestTime_ms);
    from = rests[entry].time_s;
  }
  return animation.Finish();
}

}  // namespace regrasp
