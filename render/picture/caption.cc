#include "render/picture/caption.h"

#include <algorithm>
#include <vector>

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

/// The fingers whose last waypoint is not their first, by number.
std::vector<FingerIndex> MovedFingers(const plan::Align& align) {
  std::vector<FingerIndex> moved;
  if (align.waypoints.empty()) return moved;
  for (const plan::FingerContact& first : align.waypoints.front()) {
    const plan::FingerContact* last = plan::FindFinger(align.waypoints.back(), first.finger);
    if (last != nullptr && first.contact.p != last->contact.p) moved.push_back(first.finger);
  }
  std::sort(moved.begin(), moved.end());
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
  const std::vector<FingerIndex> moved = MovedFingers(step);
  return moved.empty() ? "align" : "align: move " + List(moved);
}

}  // namespace

std::string EntryTitle(const plan::Plan& plan, int entry) {
  if (entry == 0) return "hold: fingers " + List(FingersOf(plan.initial));
  return std::visit([](const auto& kind) { return Describe(kind); }, plan.steps[entry - 1]);
}

std::string FrameCaption(const plan::Plan& plan, int entry) {
  if (entry == 0) return EntryTitle(plan, entry);
  const std::string step =
      "step " + std::to_string(entry) + "/" + std::to_string(plan.steps.size());
  const auto* align = std::get_if<plan::Align>(&plan.steps[entry - 1]);
  const bool moves = align != nullptr && !MovedFingers(*align).empty();
  return step + " · " + EntryTitle(plan, entry) + (moves ? " along the surface" : "");
}

}  // namespace regrasp::render
