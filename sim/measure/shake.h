#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "sim/scene/measured.h"
#include "sim/world/replay_world.h"
#include "sim/world/stillness.h"

namespace regrasp::sim {

/// ± a force along every axis, then ± a torque about every axis: twelve in space; in the plane the
/// six along x and y and about z.
[[nodiscard]] std::vector<Push> PushDirections(int dimension);

/// "force +x", "torque -z".
[[nodiscard]] std::string PushName(const Push& push);

/// "a push of 5.3 N along +x", "a twist of 0.2 N·m about -z".
/// @param size    of the force, or of the torque over `radius`, newtons.
/// @param radius  metres.
[[nodiscard]] std::string PushText(const Push& push, double size, double radius);

/// A force of `size`, or a torque of `size` times the frame's radius.
[[nodiscard]] grasp::Wrench PushWrench(const Push& push, double size);

/// How the fingers respond to a push.
enum class DisturbanceResponse {
  kAdapted,  ///< with forces planned for the push
  /// With the forces of the rest; only the servos' stiffness gives more. The object gives way on
  /// the servos, by what a push does to springs, and has moved where it does not come back.
  kFixed,
};

/// Pushes and turns the object at rest in every direction (sim/measure/shake.h), one after the
/// other, on top of the weight: a force of shake · squeeze, then a torque of that over R. Each push
/// lasts until everything is still (sim/world/motion_monitor.h). The world's monitor measures; a
/// push that the grasp does not stand is the last. Afterwards everything is as before, whatever is
/// thrown.
/// @param on_fault  called while the world is as that push left it.
/// @throws UnstableError
void Shake(ReplayWorld& world, DisturbanceResponse response,
           const std::function<void(const plan::FaultPush& push)>& on_fault);

/// One push on the object at rest, and a look at its contacts. Adapted forces and their push stay;
/// a push that fixed forces meet is taken away again.
/// @throws UnstableError
void PushOnce(ReplayWorld& world, const grasp::Wrench& push_S, DisturbanceResponse response);

/// Keeps the world as it is, at rest: puts it back at its end.
class KeepRest {
 public:
  explicit KeepRest(ReplayWorld& world);
  ~KeepRest();
  KeepRest(const KeepRest&) = delete;
  KeepRest& operator=(const KeepRest&) = delete;
  /// Puts it back at once.
  void Restore();

 private:
  ReplayWorld& world_;
  Engine::State rest_;
  std::vector<Eigen::Vector3d> forces_;
};

/// A body that nothing holds stands no larger shake than this: while it is pushed it moves by the
/// tolerance (FreeMotion), or by so little in kStillTime that it looks still.
[[nodiscard]] double LeastShake(double tolerance);

/// @throws InputError  a body that nothing holds would stand the shake. None at all is allowed.
void CheckShake(const ReplaySettings& settings);

/// Natural times (ReplaySettings); a finger's servo settles in a tenth.
inline constexpr double kPushRamp = 0.6;

class ReplayWorld;

/// Looks for the largest push in every direction, each from the state of rest that the world is in;
/// afterwards everything but the monitor is as before.
///
/// What the object stands is checked as in a step: it does not move, slip or lose a contact by more
/// than the tolerance. A grasp that resists two pushes resists all in between, so that a bisection
/// finds the limit: to kStressGap of it, or to kLeastStress.
[[nodiscard]] std::vector<DirectionStress> MeasureStress(ReplayWorld& world);

inline constexpr double kStressGap = 0.01;    ///< over the limit
inline constexpr double kLeastStress = 1e-4;  ///< pushes nearer to each other count as one

}  // namespace regrasp::sim
