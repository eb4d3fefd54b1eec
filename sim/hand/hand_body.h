#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/kinematics/hand_file.h"
#include "sim/hand/coupling_residuals.h"
#include "sim/hand/gap.h"

namespace regrasp::sim {

/// A part of a hand that has a place of its own.
struct HandPart {
  FingerIndex finger;  ///< not valid: the palm
  int joints = 0;      ///< of the finger that move it
  bool is_tip = false;
  std::string body;
};

/// A hand as the engine has it: where its parts and tips are, in the palm's frame, whatever the
/// planner's kinematics say.
class HandBody {
 public:
  explicit HandBody(const kinematics::HandFile& file);
  ~HandBody();
  HandBody(const HandBody&) = delete;
  HandBody& operator=(const HandBody&) = delete;

  [[nodiscard]] const kinematics::HandModel& hand() const;
  [[nodiscard]] const std::vector<HandPart>& parts() const;
  /// Pairs of parts that may touch: neighbours along a finger, and what is near at rest.
  [[nodiscard]] bool MayTouch(int a, int b) const;

  /// @param joints  by finger, from the palm to the tip, as the model has them; as many as it has.
  void SetJoints(const std::vector<std::vector<double>>& joints);
  /// How far a joint of a finger is from what it is coupled to.
  struct Uncoupled {
    FingerIndex finger;
    int joint = 0;  ///< of the finger, from the palm on
    double radians = 0;
    std::string source;  ///< element that states the coupling, for messages
  };
  /// Return the largest residual of the couplings; none if no joint of a finger is coupled.
  [[nodiscard]] std::optional<Uncoupled> LargestCouplingResidual() const;
  [[nodiscard]] ConvexBody Place(int part) const;
  /// A point of a joint's hinge.
  [[nodiscard]] Eigen::Vector3d JointAnchor(FingerIndex finger, int joint) const;
  /// The centre of a fingertip's ball.
  [[nodiscard]] Eigen::Vector3d TipCentre(FingerIndex finger) const;
  /// No point of the part moves farther than this, metres, while the joints go straight from one to
  /// the other.
  [[nodiscard]] double MotionBound(int part, const std::vector<std::vector<double>>& from,
                                   const std::vector<std::vector<double>>& to) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::sim
