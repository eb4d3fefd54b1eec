#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/index.h"
#include "planner/collision/convex_shape.h"

namespace regrasp::kinematics {

/// Revolute joint of a finger, for the product of exponentials (Murray, Li and Sastry 1994, 3.2).
/// In the reference configuration all frames are parallel to the palm's. The origin of the joint's
/// frame is on its axis, at `offset` in the frame of the previous joint (of the palm for the first
/// joint). The frame is rotated about `axis` by the joint's angle minus `rest`.
struct Joint {
  std::string name;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector
  double rest = 0;  ///< angle in the reference configuration; angles are the model's, radians
  double lower = 0;
  double upper = 0;
  /// Index of the independent joint among those of the finger; coupled joints share one.
  /// The joint's angle is `ratio` times the angle of the independent joint plus `coupling_offset`,
  /// radians.
  int drive = 0;
  double ratio = 1;
  double coupling_offset = 0;
  bool follows = false;  ///< whether it is coupled to the independent joint
};

/// Collision shape of a part of the hand.
struct LinkShape {
  enum class Role {
    kLink,  ///< must not touch the object
    kTip,   ///< represents a fingertip, and touches the object at a contact
    /// Collision geometry of a fingertip's body, which a kTip shape represents for the object.
    /// Other links must not touch it either.
    kCovered,
  };
  std::string link;  ///< body of the model
  int after = 0;     ///< number of joints that move it; its frame is the last joint's
  Role role = Role::kLink;
  collision::ConvexShape shape;
  /// Shape that contains `shape`, for planning: with fewer points if there are many.
  collision::ConvexShape enclosing;
};

/// Fingertip sphere in the frame of the finger's last joint.
struct Fingertip {
  std::string body;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
  /// Pointing direction, a unit vector from the last joint to the sphere. It is perpendicular to
  /// the joint's axis unless the sphere is on the axis.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
};

/// Finger: chain of revolute joints from the palm to a fingertip.
struct Finger {
  std::string name;
  std::vector<Joint> joints;  ///< joints from the palm to the fingertip
  std::vector<LinkShape> shapes;
  Fingertip tip;
  int drives = 0;  ///< number of independent joints
  /// Limits by independent joint such that all joints are within theirs, radians.
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// Hand whose fingers are chains of revolute joints, in the palm's frame, in metres and radians.
struct HandModel {
  std::string name;
  std::string file;  ///< file name of the hand without folders, as in plans
  /// Digest of the hand's file, of the model's file with all included files, and of all meshes.
  std::string sha256;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector against gravity
  bool has_own_up = true;  ///< whether `up` is that of the hand's file (SetUp)
  std::vector<Finger> fingers;
  std::vector<LinkShape> palm;  ///< shapes of the palm; `after` is 0
  /// Shape in a pair that is near by construction and not checked for collisions.
  struct Part {
    FingerIndex finger;  ///< invalid: the palm
    int shape = 0;
    auto operator<=>(const Part&) const = default;
  };
  std::vector<std::pair<Part, Part>> ignored;  ///< pairs in ascending order, sorted
};

/// Let gravity act on a hand in another direction than its file states. Plans record it.
/// @param up  unit vector against gravity, in the palm's frame.
void SetUp(const Eigen::Vector3d& up, HandModel& hand);

/// Return upward directions to try: that of the hand, then the axes of the palm's frame.
[[nodiscard]] std::vector<Eigen::Vector3d> UpDirections(const HandModel& hand);

/// Joint configuration of a finger: angle of each independent joint, radians.
using JointConfiguration = Eigen::VectorXd;

/// Contents of `hand.json`: roles of the model's bodies, and the fingertip spheres.
/// The format is in docs/formats.md.
/// Lengths are in metres, in the frames of the model's bodies.
struct HandDescription {
  struct Tip {
    std::string name;  ///< name of the finger
    std::string body;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0;
  };
  /// Coupling: angle of `joint` = ratio · angle of `follows` + offset, radians.
  struct Coupling {
    std::string joint;
    std::string follows;
    double ratio = 1;
    double offset = 0;
  };

  std::string name;
  std::string model;  ///< file of the model, relative to the hand's file
  std::string palm;   ///< name of the body
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector in the palm's frame
  std::vector<Tip> tips;
  std::vector<Coupling> couplings;
};

/// Parse the text of a hand's file.
/// @param name  name of the file in messages.
/// @throws InputError  if the text is not a hand description.
[[nodiscard]] HandDescription ParseHandDescription(std::string_view text, const std::string& name);

/// Format a description as the text of a file. Equal descriptions give equal bytes.
[[nodiscard]] std::string FormatHandDescription(const HandDescription& description);

struct CompiledModel;

/// Check that a model has exactly the physics that the replay assumes.
/// These are gravity, joints with their limits and springs, and actuators of joints.
///
/// Flags and options that change only how a step is computed are accepted.
/// @throws InputError  if a flag disables a part of the physics (gravity, limits, equality, …) or
///     overrides contact parameters; if wind, density or viscosity is not 0, or if an actuator
///     moves no joint (adhesion, site, slider-crank). The message names the model's file and the
///     element.
void CheckPhysics(const CompiledModel& compiled);

/// Check that a hand has all couplings that its model imposes (joint_relations.h).
/// @param file  name of the hand's file in messages.
/// @throws InputError  as ReadJointRelations, and if a coupling of the model is missing or differs.
void CheckCouplings(const HandModel& hand, const std::string& palm, const CompiledModel& compiled,
                    const std::string& file);

/// Check that the palm and the fingertips have colliding geoms that contain the fingertip spheres.
/// Every point of a fingertip sphere must be within 5 mm of the convex hull of its link's geoms.
/// @param file  name of the hand's file in messages.
/// @throws InputError  if not; the message names the body and the distance.
void CheckCollisionGeoms(const HandDescription& description, const CompiledModel& compiled,
                         const std::string& file);

}  // namespace regrasp::kinematics
