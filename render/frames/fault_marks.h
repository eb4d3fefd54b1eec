#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/projection.h"
#include "planner/plan/reason.h"
#include "render/frames/annotation.h"
#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/finger_glyph.h"
#include "render/picture/caption.h"

namespace regrasp::render {

/// Marks that are drawn over the frame of a failed step. Positions in metres, world frame.
struct FaultMarks {
  /// A length between two points, with its text.
  struct Dimension {
    Eigen::Vector3d from, to;
    std::string text;
  };
  /// A normal, drawn from its contact into the object.
  struct Normal {
    Eigen::Vector3d at, along;
    bool expected = false;  ///< whether the normal is the expected instead of the wrong one
    std::string text;
  };
  /// A required or former position of a finger.
  struct Place {
    Eigen::Vector3d contact, normal;
    std::string text;
  };
  /// The friction cone that the grasp would require.
  struct Cone {
    Eigen::Vector3d apex, axis;
    double friction_angle;
    std::string text;  ///< text for all cones, set in the first one only
  };
  /// A fingertip sphere in its true size.
  struct Fingertip {
    Eigen::Vector3d centre;
    double radius;
  };
  /// A wrong place of a hand.
  struct Spot {
    Eigen::Vector3d at;
    std::string text;
  };
  std::string heading;               ///< reason of the failure, one line
  std::vector<FingerIndex> fingers;  ///< fingers that are drawn in red
  bool planar = false;               ///< whether cones are flat
  std::vector<Dimension> dimensions = {};
  std::vector<Normal> normals = {};
  std::vector<Place> places = {};
  std::vector<Cone> cones = {};
  std::vector<Fingertip> fingertips = {};
  std::vector<Spot> spots = {};
  std::vector<plan::HandLink> links = {};  ///< links of the hand that are drawn in red
  std::optional<plan::FaultDisturbance> disturbance = std::nullopt;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< current centroid of the object, where
                                                       ///< the disturbance force acts
  /// Former pose of the object, drawn as a ghost.
  std::optional<Eigen::Isometry3d> X_WO_before = std::nullopt;
  std::string ghost_text = {};
};

/// A failed step as it is drawn.
///
/// Distances that are too small to see or too large for an image are drawn longer or shorter, and
/// their text states it. Other far or non-finite points are omitted.
struct FaultScene {
  plan::Snapshot snapshot;
  FaultMarks marks;
};

/// Compute the scene of a failed step.
/// @param scale     metres per unit of the object.
/// @param snapshot  state in the replay, or as planned (planner/plan/projection.h).
/// @param heading   reason of the failure, one line.
[[nodiscard]] FaultScene MakeFaultScene(const object::Object& object, double scale,
                                        plan::Reason reason, const plan::Fault& fault,
                                        const plan::Snapshot& snapshot, const std::string& heading);

class CairoImage;

/// Return points that bound the marks, metres, world frame. Cones contribute only their apex,
/// because they are as long as the cones of fingers.
[[nodiscard]] std::vector<Eigen::Vector3d> ExtentOf(const FaultMarks& marks, double diameter_m);

/// Draw the marks over the frame of a failed step.
///
/// Actual values are red and expected values green, with lengths and angles. A disturbance force,
/// the ghost of an object that moved, and the heading at the top left are also drawn.
/// @param fingers  fingers in the frame; texts avoid them.
/// @returns the areas covered by lines and texts.
std::vector<Obstacle> DrawFaultMarks(const CairoImage& image, const Camera& camera,
                                     const NormalizedFrame& frame, const BodyShape& body,
                                     std::span<const FingerGlyph> fingers, const FaultMarks& marks,
                                     const TextStyle& style);

}  // namespace regrasp::render
