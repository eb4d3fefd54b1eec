#include "render/figures/plan_diagram.h"

#include <algorithm>
#include <variant>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "render/picture/caption.h"

namespace regrasp::render {

namespace {

BorderPoint BorderPointOf(const grasp::Contact& contact) {
  return {contact.p.head<2>(), -contact.n.head<2>()};
}

const char* TypeName(DiagramKind kind) {
  switch (kind) {
    case DiagramKind::kTwoFinger:
      return "2-finger grasp";
    case DiagramKind::kConcurrent:
      return "concurrent grasp";
    case DiagramKind::kParallel:
      return "parallel grasp";
    case DiagramKind::kOther:
      break;
  }
  return "other grasp";
}

/// The type of the grasp, with φ where its cones are narrower than those of the friction.
std::string Describe(const GraspDiagram& grasp, double friction) {
  std::string name = TypeName(grasp.kind);
  if (grasp.kind != DiagramKind::kConcurrent) return name;
  const auto degrees = [](double radians) { return FormatShort(Degrees(radians), 3) + "°"; };
  const std::string drawn = degrees(grasp.cones.front().half_angle);
  const std::string theta = degrees(friction);
  return drawn == theta ? name : name + "; φ = " + drawn + " < θ = " + theta;
}

/// Where a finger is at the waypoints of an align.
std::vector<BorderPoint> PathOf(const plan::Align& align, FingerIndex finger) {
  std::vector<BorderPoint> path;
  for (const plan::FingerGrasp& waypoint : align.waypoints) {
    const plan::FingerContact* at = plan::FindFinger(waypoint, finger);
    if (at != nullptr) path.push_back(BorderPointOf(at->contact));
  }
  return path;
}

bool Moves(const std::vector<BorderPoint>& path) {
  return std::any_of(path.begin(), path.end(),
                     [&](const BorderPoint& point) { return point.p != path.front().p; });
}

void AddActions(const plan::FingerGrasp& /*before*/, const plan::Align& align,
                std::vector<DiagramFinger>& fingers) {
  for (DiagramFinger& finger : fingers) {
    std::vector<BorderPoint> path = PathOf(align, finger.finger);
    if (!Moves(path)) continue;
    finger.role = plan::FingerRole::kMoved;
    finger.path = std::move(path);
  }
}

void AddActions(const plan::FingerGrasp& before, const plan::Switch& step,
                std::vector<DiagramFinger>& fingers) {
  for (DiagramFinger& finger : fingers) {
    if (plan::FindFinger(step.place, finger.finger)) finger.role = plan::FingerRole::kPlaced;
  }
  for (const FingerIndex released : step.release) {
    const plan::FingerContact* at = plan::FindFinger(before, released);
    if (at == nullptr) continue;
    fingers.push_back({released, plan::FingerRole::kReleased, BorderPointOf(at->contact), {}});
  }
}

void AddActions(const plan::FingerGrasp& /*before*/, const plan::Move& /*step*/,
                std::vector<DiagramFinger>& /*fingers*/) {}

}  // namespace

std::string PanelLabel(int index) {
  constexpr int kLetters = 26;
  std::string letters;
  for (int rest = index; rest >= 0; rest = rest / kLetters - 1) {
    letters.insert(letters.begin(), static_cast<char>('a' + rest % kLetters));
  }
  return "(" + letters + ")";
}

std::vector<StepDiagram> DescribePlan(const object::Polygon& polygon, const plan::Plan& plan) {
  std::vector<StepDiagram> diagrams;
  plan::FingerGrasp grasp = plan.initial;
  const int entries = static_cast<int>(plan.steps.size()) + 1;
  for (plan::EntryIndex entry{0}; entry < entries; ++entry) {
    const plan::FingerGrasp before = grasp;
    const plan::Step* step = entry > 0 ? &plan::StepOf(plan, entry) : nullptr;
    if (step != nullptr) grasp = plan::GraspAfter(before, *step);
    StepDiagram diagram;
    diagram.kind = step != nullptr ? plan::StepKind(*step) : "hold";
    diagram.grasp = DescribeGrasp(polygon, plan::ContactsOf(grasp), plan.half_angle);
    diagram.caption = PanelLabel(entry) + " " + EntryTitle(plan, entry) + "; " +
                      Describe(diagram.grasp, plan.half_angle);
    for (const plan::FingerContact& held : grasp) {
      diagram.fingers.push_back(
          {held.finger, plan::FingerRole::kHolding, BorderPointOf(held.contact), {}});
    }
    if (step != nullptr) {
      std::visit([&](const auto& s) { AddActions(before, s, diagram.fingers); }, *step);
    }
    diagrams.push_back(std::move(diagram));
  }
  return diagrams;
}

}  // namespace regrasp::render
