#include "render/picture/caption.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "planner/base/number.h"

namespace regrasp::render {

double RoundLength(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

namespace {

/// Smallest rotation (radians) and translation (metres) that are reported. Smaller ones are
/// rounding errors.
constexpr double kMinRotation = 1e-4;
constexpr double kMinTranslation = 1e-5;
/// Significant digits of a length.
constexpr int kDigits = 2;

std::string List(const std::vector<FingerIndex>& fingers) {
  std::string text;
  for (const FingerIndex finger : fingers)
    text += (text.empty() ? "" : ", ") + std::to_string(finger);
  return text;
}

std::vector<FingerIndex> FingersOf(const plan::FingerGrasp& grasp) {
  std::vector<FingerIndex> fingers;
  for (const plan::FingerContact& contact : grasp) fingers.push_back(contact.finger);
  return fingers;
}

struct Travel {
  FingerIndex finger;
  double length;  ///< length of the polyline through the waypoints, object units
  int begin;      ///< index of the first waypoint with another position
};

/// Return the fingers whose last waypoint differs from their first, in the order in which they
/// start, then by number.
std::vector<Travel> MovedFingers(const plan::Align& align) {
  std::vector<Travel> moved;
  if (align.waypoints.empty()) return moved;
  for (const plan::FingerContact& first : align.waypoints.front()) {
    const plan::FingerContact* last = plan::FindFinger(align.waypoints.back(), first.finger);
    if (last == nullptr || first.contact.p == last->contact.p) continue;
    Travel travel = {first.finger, 0, 0};
    int index = 0;
    const plan::FingerContact* before = &first;
    for (const plan::FingerGrasp& waypoint : align.waypoints) {
      const plan::FingerContact* here = plan::FindFinger(waypoint, first.finger);
      ++index;
      if (here == nullptr) continue;
      travel.length += (here->contact.p - before->contact.p).norm();
      if (travel.begin == 0 && here->contact.p != first.contact.p) travel.begin = index;
      before = here;
    }
    moved.push_back(travel);
  }
  std::ranges::sort(moved, {}, [](const Travel& t) { return std::pair(t.begin, t.finger); });
  return moved;
}

std::string Describe(const plan::Switch& step) {
  std::string text = "switch:";
  if (!step.place.empty()) text += " place " + List(FingersOf(step.place));
  if (!step.release.empty()) {
    text += (step.place.empty() ? " release " : ", release ") + List(step.release);
  }
  return text;
}

std::string Describe(const plan::Align& step) {
  std::vector<FingerIndex> fingers;
  for (const Travel& travel : MovedFingers(step)) fingers.push_back(travel.finger);
  return fingers.empty() ? "align" : "align: move " + List(fingers);
}

/// Return "move: rotate the object by 38°", or "move: translate the object by 2.1 mm" if it does
/// not rotate.
std::string Describe(const plan::Move& step) {
  if (step.path.empty()) return "move";
  const Eigen::Isometry3d& from = step.path.front().pose;
  const Eigen::Isometry3d& to = step.path.back().pose;
  const Eigen::AngleAxisd rotation(from.linear().transpose() * to.linear());
  if (rotation.angle() >= kMinRotation) {
    return "move: rotate the object by " + FormatDegrees(Degrees(rotation.angle()));
  }
  const double translation = (to.translation() - from.translation()).norm();
  return translation < kMinTranslation
             ? "move: free fingers"
             : "move: translate the object by " + FormatLength(translation, kDigits);
}

/// Return the motion of the fingers, for example "move 1 by 12 mm, 3 by 0.8 mm together along the
/// surface".
///
/// Fingers that start later follow "then". Empty if no finger moves.
std::string DescribeTravel(const plan::Align& step, double scale) {
  const std::vector<Travel> moved = MovedFingers(step);
  if (moved.empty()) return "";
  std::string text;
  int before = moved.front().begin;
  for (const auto& [finger, length, begin] : moved) {
    text += text.empty() ? "move " : begin == before ? ", " : ", then ";
    text += std::to_string(finger) + " by " + FormatLength(length * scale, kDigits);
    before = begin;
  }
  const bool together = moved.size() > 1 && moved.front().begin == moved.back().begin;
  return text + (together ? " together" : "") + " along the surface";
}

}  // namespace

std::string EntryTitle(const plan::Plan& plan, plan::EntryIndex entry) {
  if (entry == 0) return "hold: fingers " + List(FingersOf(plan.initial));
  return std::visit([](const auto& kind) { return Describe(kind); }, plan::StepOf(plan, entry));
}

std::string FrameCaption(const plan::Plan& plan, plan::EntryIndex entry) {
  if (entry == 0) return EntryTitle(plan, entry);
  const std::string step =
      "step " + std::to_string(entry) + "/" + std::to_string(plan.steps.size());
  const auto* align = std::get_if<plan::Align>(&plan::StepOf(plan, entry));
  const std::string travel = align != nullptr ? DescribeTravel(*align, plan.scale) : "";
  return step + " · " + (travel.empty() ? EntryTitle(plan, entry) : "align: " + travel);
}

}  // namespace regrasp::render
