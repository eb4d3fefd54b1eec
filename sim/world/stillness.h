#pragma once

#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Wait until the object and the fingers in contact are still.
/// They are still if none of them has moved by more than kStill · D in kStillTime. The wait ends
/// after kLongestWait, or when the object is lost (MotionMonitor::lost).
/// @return whether they became still.
/// @throws UnstableError  if the simulation becomes unstable.
bool WaitUntilStill(ReplayWorld& world);

/// Wait until everything is still when a static grasp is required.
/// The monitor records a failure to become still, and measures the contacts.
/// @throws UnstableError  if the simulation becomes unstable.
void ComeToRest(ReplayWorld& world);

/// Return the motion of an unsupported object under a disturbance of ρ F in a hold phase, over ρ D.
/// The force grows linearly during `ramp` and then acts for kLongestWait, both in characteristic
/// times. The acceleration is ρ F / M = ρ D over the characteristic time squared, so mass and grasp
/// force cancel.
[[nodiscard]] double FreeMotion(double ramp);

/// Duration of stillness in characteristic times √(M D / F)
/// (ReplaySettings::characteristic_time_s). A finger's servo settles in a tenth. The object
/// oscillates on the servos with a period of about one, well damped. If two fingers are close
/// together the period is ten, and it takes twenty to become still.
inline constexpr double kStillTime = 0.4;
/// Longest wait in characteristic times. An object slides if a disturbance exceeds the resisted
/// wrench by 1 / 800,000 of the grasp force; in this time it has moved by the default tolerance.
inline constexpr double kLongestWait = 40;
/// Limit of still motion over D. Contacts creep by less than 5e-8 in kStillTime. The engine softens
/// friction so that it yields by (1 − solimp) / impratio = 1e-6 of (1 / m + 1 / M) f. Its time
/// constant is half that of the contacts, which is two time steps. An unsupported object moves 8e-4
/// in this time under the default disturbance. An object that the grasp holds except for a
/// thousandth of the disturbance moves nearly 1e-6.
inline constexpr double kStill = 1e-6;
/// Upper bound on the extent of the object from an axis over its radius of gyration about that
/// axis: 1.4 for a rod's own axis, 2 for a cube's diagonal. Creeping contacts rotate a needle about
/// its long axis by a large angle, but none of its points moves far.
inline constexpr double kArmOfGyration = 3;

}  // namespace regrasp::sim
