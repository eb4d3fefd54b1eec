#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/reason.h"
#include "planner/plan/snapshot.h"

namespace regrasp::render {

/// What is drawn over the frame of a failed step. Places in metres, world frame.
struct FaultMarks {
  /// The length between two points, with its text.
  struct Dimension {
    Eigen::Vector3d from, to;
    std::string text;
  };
  /// A normal, drawn from its contact into the object.
  struct Normal {
    Eigen::Vector3d at, along;
    bool expected = false;  ///< otherwise it is the one at fault
    std::string text;
  };
  /// Where a finger should be or was.
  struct Place {
    Eigen::Vector3d contact, normal;
    std::string text;
  };
  /// The friction cone that would be needed.
  struct Cone {
    Eigen::Vector3d apex, axis;
    double half_angle;
    std::string text;  ///< of the first, for all
  };
  /// A fingertip as thick as it is.
  struct Tip {
    Eigen::Vector3d centre;
    double radius;
  };
  /// A place in a hand that is at fault.
  struct Spot {
    Eigen::Vector3d at;
    std::string text;
  };
  std::string heading;               ///< what failed, in a line
  std::vector<FingerIndex> fingers;  ///< drawn in red
  bool planar = false;               ///< cones are flat
  std::vector<Dimension> dimensions = {};
  std::vector<Normal> normals = {};
  std::vector<Place> places = {};
  std::vector<Cone> cones = {};
  std::vector<Tip> tips = {};
  std::vector<Spot> spots = {};
  std::vector<plan::HandLink> links = {};  ///< of a hand, drawn in red
  std::optional<plan::FaultPush> push = std::nullopt;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< now, where the push is drawn
  /// The object where it was before it moved, for a ghost.
  std::optional<Eigen::Isometry3d> X_WO_before = std::nullopt;
  std::string ghost_text = {};
};

/// A failed step as it is drawn. Distances that are too small to be seen, or too large for a
/// picture, are drawn longer or shorter, and their text says so; what is far away otherwise, or not
/// finite, is left out.
struct FaultPicture {
  plan::Snapshot snapshot;
  FaultMarks marks;
};

/// @param snapshot  what the replay saw, or what is planned (planner/plan/snapshot.h).
/// @param heading   what failed, in a line.
/// @param scale     metres per unit of the object.
[[nodiscard]] FaultPicture MakeFaultPicture(const object::Object& object, double scale,
                                            plan::Reason reason, const plan::Fault& fault,
                                            const plan::Snapshot& snapshot,
                                            const std::string& heading);

}  // namespace regrasp::render
