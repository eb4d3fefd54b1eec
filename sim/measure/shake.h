#pragma once

#include <functional>

#include "planner/grasp/grasp_forces.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// How the fingers respond to a push.
enum class DisturbanceResponse {
  kAdapted,  ///< with forces planned for the push
  /// With the forces of the rest; only the servos' stiffness gives more. The object gives way on
  /// the servos, by what a push does to springs, and has moved where it does not come back.
  kFixed,
};

/// Pushes and turns the object at rest in every direction (sim/measure/push.h), one after the
/// other, on top of the weight: a force of shake · squeeze, then a torque of that over R. Each push
/// lasts until everything is still (sim/world/stillness.h). The world's monitor measures; a push
/// that the grasp does not stand is the last. Afterwards everything is as before, whatever is
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

}  // namespace regrasp::sim
