#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/kinematics/hand_file.h"
#include "sim/hand/gap.h"

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// Couplings of a hand's joints from its model and its file, independent of the planner's
/// kinematics.
/// They are equality constraints of joints and of fixed tendons, `<mimic>`, and the couplings of
/// the hand file.
class CouplingResiduals {
 public:
  explicit CouplingResiduals(const kinematics::HandFile& file);

  /// Deviation of a joint from the angle that a coupling requires.
  struct Residual {
    int joint = -1;      ///< joint of the model; -1 if nothing is coupled
    double radians = 0;  ///< absolute value
    std::string source;  ///< element that defines the coupling, for messages
  };
  /// Return the largest residual in the joint positions of `data`.
  [[nodiscard]] Residual Largest(const mjData_& data) const;

 private:
  /// Term of Σ coefficient · joint angle = constant; the first joint follows the others.
  struct Term {
    int joint;
    double coefficient;
  };
  struct Equation {
    std::vector<Term> terms;
    double constant = 0;
    std::string source;
  };
  void AddEqualities();
  void AddRelation(const std::string& joint, const std::string& leader, double ratio, double offset,
                   const std::string& source);
  void AddTendon(int tendon, double factor, Equation& equation) const;

  const mjModel_& model_;  ///< owned by the hand file
  std::vector<Equation> equations_;
};

/// Part of a hand that moves as one body.
struct HandPart {
  using Role = kinematics::LinkShape::Role;
  FingerIndex finger;  ///< finger; not valid for the palm
  int joints = 0;      ///< number of the finger's joints that move it
  Role role = Role::kLink;
  std::string body;
};

/// Hand in the engine's kinematics: poses of its parts and fingertips in the palm's frame.
/// Independent of the planner's kinematics.
class HandBody {
 public:
  explicit HandBody(const kinematics::HandFile& file);
  ~HandBody();
  HandBody(const HandBody&) = delete;
  HandBody& operator=(const HandBody&) = delete;

  [[nodiscard]] const kinematics::HandModel& hand() const;
  [[nodiscard]] const std::vector<HandPart>& parts() const;
  /// Return whether parts may touch.
  /// These are neighbours along a finger, and parts that are close in the reference configuration.
  [[nodiscard]] bool MayTouch(int a, int b) const;

  /// Set the joints.
  /// @param joints  angles [finger][joint] from the palm to the fingertip, in the order and number
  ///     of the model.
  void SetJoints(const std::vector<std::vector<double>>& joints);
  /// Deviation of a finger's joint from its coupling.
  struct Uncoupled {
    FingerIndex finger;
    int joint = 0;  ///< joint of the finger, from the palm on
    double radians = 0;
    std::string source;  ///< element that defines the coupling, for messages
  };
  /// Return the largest residual of the couplings; none if no joint of a finger is coupled.
  [[nodiscard]] std::optional<Uncoupled> LargestCouplingResidual() const;
  [[nodiscard]] ConvexBody Place(int part) const;
  /// Return a point of a joint's axis.
  [[nodiscard]] Eigen::Vector3d JointAnchor(FingerIndex finger, int joint) const;
  /// Return the centre of a fingertip sphere.
  [[nodiscard]] Eigen::Vector3d TipCentre(FingerIndex finger) const;
  /// Return the orientation of the body that has the fingertip, in the palm's frame.
  [[nodiscard]] Eigen::Matrix3d TipTurn(FingerIndex finger) const;
  /// Return a bound on the motion of all points of a part, metres, while the joints move linearly.
  [[nodiscard]] double MotionBound(int part, const std::vector<std::vector<double>>& from,
                                   const std::vector<std::vector<double>>& to) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::sim
