#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/collision/convex_shape.h"

namespace regrasp::kinematics {

/// A hinge of a finger, as the product of exponentials has it (Murray, Li and Sastry 1994, 3.2):
/// while the hand is at rest all frames are parallel to the palm's. The joint's frame has its
/// origin on the hinge, at `offset` in the frame of the joint before it (of the palm, for the first
/// one), and is turned about `axis` by what the joint's angle is beyond `rest`.
struct Joint {
  std::string name;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of length 1
  double rest = 0;                                  ///< angles as the model has them, radians
  double lower = 0;
  double upper = 0;
  /// The drive that turns it, among those of the finger: coupled joints share one. The joint's
  /// angle is `ratio` times the angle of the drive plus `coupling_offset`, radians.
  int drive = 0;
  double ratio = 1;
  double coupling_offset = 0;
  bool follows = false;  ///< whether it is coupled to the joint that the drive's angle is that of
};

/// A part of the hand that others can run into.
struct LinkShape {
  std::string link;     ///< the model's body
  int after = 0;        ///< joints of the finger that move it; it is in the last one's frame
  bool is_tip = false;  ///< what touches the object at a contact
  collision::ConvexShape shape;
};

/// The ball that a finger touches with, in the frame of its last joint.
struct Fingertip {
  std::string body;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
  /// Where the finger points, of length 1: from the last hinge to the ball, at right angles to the
  /// hinge unless the ball is on it.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
};

/// A chain of hinges from the palm to a fingertip.
struct Finger {
  std::string name;
  std::vector<Joint> joints;  ///< from the palm to the tip
  std::vector<LinkShape> shapes;
  Fingertip tip;
  int drives =
      0;  ///< numbers that say how it stands; equals the number of joints but for couplings
  /// By drive: limits such that all joints keep theirs, radians.
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// A hand with fingers that are chains of hinges, in the frame of its palm; metres and radians.
struct HandModel {
  std::string name;
  std::string file;  ///< of the hand, without folders, as plans name it
  /// Of the bytes of the hand's file, of the model's with what it includes, and of all meshes that
  /// it names.
  std::string sha256;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< against gravity, of length 1
  std::vector<Finger> fingers;
  std::vector<LinkShape> palm;  ///< `after` is 0
  /// Pairs of shapes that are near each other by construction and are not checked: by finger (−1
  /// the palm) and place among its shapes.
  struct Part {
    FingerIndex finger;  ///< not valid: the palm
    int shape = 0;
    auto operator<=>(const Part&) const = default;
  };
  std::vector<std::pair<Part, Part>> ignored;  ///< each in ascending order, sorted
};

/// How a finger stands: the angle of each drive, radians.
using Posture = Eigen::VectorXd;

}  // namespace regrasp::kinematics
