#include "sim/actuation/carry_out.h"

#include <utility>

#include "planner/base/error.h"
#include "planner/object/body_measures.h"
#include "planner/plan/locate.h"
#include "sim/actuation/hand_replay.h"

namespace regrasp::sim {

std::function<std::optional<bool>(const plan::Plan&)> CarryOutTest(
    kinematics::HandFile file, const object::Polyhedron& solid) {
  return [file = std::move(file), &solid](const plan::Plan& plan) -> std::optional<bool> {
    HandReplayOptions options;
    options.mass_kg = object::MeasureBody(solid, plan.scale).mass_kg;
    try {
      const ReplayResult result = ReplayHand(file, solid, plan::LocatePlan(solid, plan), options);
      return result.steps.back().reason == plan::Reason::kNone;
    } catch (const InputError&) {
      return std::nullopt;
    }
  };
}

}  // namespace regrasp::sim
