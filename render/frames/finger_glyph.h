#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/plan/projection.h"
#include "render/frames/body_shape.h"
#include "render/frames/canvas.h"

namespace regrasp::render {

/// The normalized frame P: parallel to the object frame at the start, with the origin at the
/// centroid and the object diameter as unit of length.
struct NormalizedFrame {
  double diameter_m = 1;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d FromWorld(const Eigen::Vector3d& p_W) const {
    return (p_W - centroid_m) / diameter_m;
  }
  /// Return the pose of the object in the normalized frame.
  [[nodiscard]] Eigen::Isometry3d BodyPose(const Eigen::Isometry3d& X_WO) const;
};

/// A finger as it is drawn: a fingertip sphere that touches at `contact` and a stem from
/// `fingertip` to `stem_end`.
struct FingerGlyph {
  FingerIndex finger = {};
  plan::FingerRole role = plan::FingerRole::kHolding;
  Color color = kInk;
  Color force_color = kForceInk;
  Eigen::Vector3d contact;
  Eigen::Vector3d outward;  ///< unit vector opposite to the contact normal
  Eigen::Vector3d fingertip;
  Eigen::Vector3d stem_end;
  Eigen::Vector3d end;  ///< outer end of the stem, or of the arrow of a placed or released finger
  /// Path of a sliding step up to the contact; empty for other fingers.
  std::vector<Eigen::Vector3d> path;
  Eigen::Vector3d force;  ///< force on the object, newtons
  double fingertip_radius = 0;
  double stem_radius = 0;
};

struct GlyphOptions {
  /// Whether free fingers that have a normal are drawn: in the air, at FingerState::contact_W.
  bool free_fingers = false;
  /// True radius of the fingers, in diameters. If not set, spheres and stems have a symbolic size.
  std::optional<double> finger_radius = std::nullopt;
};

/// Compute the glyphs of the fingers of a snapshot.
///
/// In narrow places such as a hole or an inner corner, symbolic spheres and stems are smaller, so
/// that they do not intersect the opposite wall.
[[nodiscard]] std::vector<FingerGlyph> MakeFingerGlyphs(const plan::Snapshot& snapshot,
                                                        const NormalizedFrame& frame,
                                                        const RayTree& body,
                                                        const GlyphOptions& options = {});

/// Return the end of a finger's force arrow, which starts at its contact. Released fingers have
/// none.
/// @param largest_force  largest force of the whole sequence, newtons; it has the longest arrow.
[[nodiscard]] std::optional<Eigen::Vector3d> ForceTip(const FingerGlyph& glyph,
                                                      double largest_force);

/// Return the index of the path segment in which a sliding finger starts to move; nullopt if it
/// does not move.
[[nodiscard]] std::optional<int> FirstLeg(const FingerGlyph& glyph);

/// Space for the number of a finger beyond its end, in diameters.
inline constexpr double kLabelSpace = 0.05;

/// Indices of the canvas meshes that glyphs use.
struct GlyphMeshes {
  int friction_cone;
  int arrow_head;
};

/// Slant length of friction cones, in diameters.
inline constexpr double kConeLength = 0.15;
/// Half the opening angle (radians) and slant length of the cone at the head of every arrow.
inline constexpr double kArrowHeadHalfAngle = 0.36;
inline constexpr double kArrowHeadLength = 0.040;

/// Add the shapes of a finger: sphere, stem, friction cone and force arrow. A free finger has only
/// the first two.
///
/// A released finger is a ghost with an arrow away from the object, and a placed one has an arrow
/// towards it. A sliding finger has a ghost at its start and a track with an arrow head.
/// @param largest_force  see ForceTip.
void AddFingerShapes(const FingerGlyph& glyph, double largest_force, const GlyphMeshes& meshes,
                     std::vector<Shape>& shapes);

}  // namespace regrasp::render
