#pragma once

#include "sim/stage.h"

namespace regrasp {

/// How the fingers answer a push.
enum class Answer {
  kAdapted,  ///< with forces planned for the push
  /// With the forces of the rest; only the servos' stiffness gives more. The object gives way on
  /// the servos, by what a push does to springs, and has moved where it does not come back.
  kFixed,
};

/// Pushes and turns the object at rest in every direction (sim/push.h), one after the other, on top
/// of the weight: a force of shake · squeeze, then a torque of that over R. The stage's judge
/// measures; afterwards everything is as before, whatever is thrown.
/// @throws UnstableError
void Shake(Stage& stage, Answer answer);

/// One push on the object at rest, and a look at its contacts. Adapted forces and their push stay;
/// a push that fixed forces answer is taken away again.
/// @throws UnstableError
void PushOnce(Stage& stage, const Wrench& push_S, Answer answer);

/// Keeps the stage as it is, at rest: puts it back at its end.
class KeepRest {
 public:
  explicit KeepRest(Stage& stage);
  ~KeepRest();
  KeepRest(const KeepRest&) = delete;
  KeepRest& operator=(const KeepRest&) = delete;
  /// Puts it back at once.
  void Restore();

 private:
  Stage& stage_;
  Engine::State rest_;
  std::vector<Eigen::Vector3d> forces_;
};

inline constexpr int kShakeRampSteps = 30;  ///< a finger's servo settles in about 5 steps
inline constexpr int kShakeHoldSteps = 20;
/// With fixed forces the object itself swings on the servos, as a rule once in about 50 steps and
/// well damped; where the fingers stand close together it turns four times more slowly.
inline constexpr int kFixedHoldSteps = 60;
inline constexpr int kMostReturnSteps = 600;
inline constexpr double kReturned = 0.5;  ///< over the tolerance: nearer than this it is back

}  // namespace regrasp
