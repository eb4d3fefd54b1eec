#pragma once

#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Waits until the object and the fingers that hold it are still: until none of them has moved by
/// more than kStill · D in kStillTime. Gives up after kLongestWait, and once the object is lost
/// (MotionMonitor::lost).
/// @return whether they came to rest.
/// @throws UnstableError
bool WaitUntilStill(ReplayWorld& world);

/// The same at a place where the object has to come to rest: the monitor is told where it does not,
/// and looks at the contacts.
/// @throws UnstableError
void ComeToRest(ReplayWorld& world);

/// How far a push of ρ F moves a body that nothing holds while a grasp has time to come to rest,
/// over ρ D: the force grows evenly in `ramp` and stays for kLongestWait, both in natural times.
/// The acceleration is ρ F / M = ρ D over the natural time squared, so that mass and squeeze drop
/// out.
[[nodiscard]] double FreeMotion(double ramp);

/// Natural times √(M D / F) (ReplaySettings::natural_time_s). A finger's servo settles in a tenth,
/// the object swings on the servos once in about one, well damped; once in ten where two fingers
/// stand close together, and then it takes twenty until it is still.
inline constexpr double kStillTime = 0.4;
/// A body that slides because a push exceeds what the grasp resists, by a part in 800,000 of
/// the squeeze, has moved by the default tolerance by then.
inline constexpr double kLongestWait = 40;
/// Over D. Contacts creep in kStillTime by less than 5e-8: the engine softens friction so that it
/// gives by (1 − solimp) / impratio = 1e-6 of (1 / m + 1 / M) f, half the contacts' time constant
/// of two time steps long. A body that nothing holds moves 8e-4 in it under the default shake, and
/// one that the grasp holds but for a thousandth of the push nearly 1e-6.
inline constexpr double kStill = 1e-6;
/// How far the body reaches from an axis, over its radius of gyration about that axis: 1.4 for a
/// rod's own axis, 2 for a cube's diagonal. Contacts that creep turn a needle about its long axis
/// by much, and none of its points goes far.
inline constexpr double kArmOfGyration = 3;

}  // namespace regrasp::sim
