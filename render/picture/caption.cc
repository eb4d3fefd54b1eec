#include "render/picture/caption.h"

#include <algorithm>
#include <vector>

#include "planner/base/quantity_text.h"

namespace regrasp::render {

namespace {

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
  double length;  ///< from waypoint to waypoint, the object's unit of length
};

/// The fingers whose last waypoint is not their first, by number.
std::vector<Travel> MovedFingers(const plan::Align& align) {
  std::vector<Travel> moved;
  if (align.waypoints.empty()) return moved;
  for (const plan::FingerContact& first : align.waypoints.front()) {
    const plan::FingerContact* last = plan::FindFinger(align.waypoints.back(), first.finger);
    if (last == nullptr || first.contact.p == last->contact.p) continue;
    Travel travel = {first.finger, 0};
    const plan::FingerContact* before = &first;
    for (const plan::FingerGrasp& waypoint : align.waypoints) {
      const plan::FingerContact* here = plan::FindFinger(waypoint, first.finger);
      if (here == nullptr) continue;
      travel.length += (here->contact.p - before->contact.p).norm();
      before = here;
    }
    moved.push_back(travel);
  }
  std::ranges::sort(moved, {}, &Travel::finger);
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

/// "move 1 by 12 mm, 3 by 0.8 mm along the surface"; empty where nothing moves.
std::string DescribeTravel(const plan::Align& step, double scale) {
  std::string text;
  for (const auto& [finger, length] : MovedFingers(step)) {
    constexpr int kDigits = 2;
    text += (text.empty() ? "move " : ", ") + std::to_string(finger) + " by " +
            FormatLength(length * scale, kDigits);
  }
  return text.empty() ? text : text + " along the surface";
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
