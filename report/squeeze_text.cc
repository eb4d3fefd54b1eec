#include "report/squeeze_text.h"

#include "planner/base/number.h"
#include "sim/scene/hand_squeeze.h"
#include "sim/scene/scaling.h"

namespace regrasp::report {

std::string SqueezeText(const sim::ReplaySettings& settings) {
  const double weight = settings.mass_kg * sim::kGravity;
  const std::string squeeze = FormatShort(settings.squeeze_N) + " N, " +
                              FormatShort(settings.squeeze_N / weight) + " times the weight";
  switch (settings.squeeze_source) {
    case sim::SqueezeSource::kShake:
      return squeeze + ": so much that the weight " +
             (settings.shake >= sim::kLeastShakeForSqueeze ? "is only a tenth of the shake"
                                                           : "hardly counts") +
             ", as verdicts depend on forces over the squeeze alone; no hand presses like that "
             "(--squeeze realistic does as hands do)";
    case sim::SqueezeSource::kHand:
      if (settings.squeeze_N >= sim::kStrongestGrip_N) {
        return squeeze + ": the most that a hand applies, less than it would take here";
      }
      return squeeze + ": as a hand grips, " + FormatShort(sim::kGripSafety) +
             " times what the weight needs in the grasp that carries it worst";
    case sim::SqueezeSource::kTorques:
      return squeeze +
             ": what the torques of the hand's actuators allow, at most twelve weights or 4 N";
    case sim::SqueezeSource::kGiven:
      return squeeze + ": as --squeeze says";
  }
  return squeeze;
}

}  // namespace regrasp::report
