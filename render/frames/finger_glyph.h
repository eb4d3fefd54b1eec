#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/plan/snapshot.h"
#include "render/frames/body_shape.h"
#include "render/frames/canvas.h"

namespace regrasp::render {

/// The picture's frame P: the object's frame at the start with its origin at the centroid and the
/// diameter as the unit of length.
struct PictureFrame {
  double diameter_m = 1;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d FromWorld(const Eigen::Vector3d& p_W) const {
    return (p_W - centroid_m) / diameter_m;
  }
  /// Where the body is in the picture.
  [[nodiscard]] Eigen::Isometry3d BodyPose(const Eigen::Isometry3d& X_WO) const;
};

/// One finger as it is drawn: a ball that touches at `contact` and a stem that ends at `end`.
struct FingerGlyph {
  FingerIndex finger = {};
  plan::FingerRole role = plan::FingerRole::kHolding;
  Color color = kInk;
  Color force_color = kForceInk;
  Eigen::Vector3d contact;
  Eigen::Vector3d outward;  ///< unit, against the contact's normal
  Eigen::Vector3d ball;
  Eigen::Vector3d stem_end;
  Eigen::Vector3d
      end;  ///< of all that is drawn: the stem, or the arrow of a placed or released one
  std::vector<Eigen::Vector3d> path;  ///< of an align, up to the contact; empty for others
  Eigen::Vector3d force;              ///< newtons, on the object
  double ball_radius = 0;
  double stem_radius = 0;
};

/// Whether a finger in the air is drawn away from its contact.
enum class GapView {
  kNone,  ///< at its contact: what a finger did in a step, seen at its end
  /// kGapScale times as far as it is, so that the eye sees it come and go; instead of its arrow,
  /// and no farther than that.
  kShown,
};
inline constexpr double kGapScale = 3;

struct GlyphOptions {
  GapView gaps = GapView::kNone;
  /// Of the fingers as they are, in diameters: balls and stems are drawn so thick; otherwise they
  /// are signs for points.
  std::optional<double> finger_radius = std::nullopt;
};

/// The fingers of a snapshot that are drawn: all but the free ones. In narrow places (a hole, an
/// inner corner) balls and stems are smaller, so that they don't run into the opposite wall, unless
/// they have their own size.
[[nodiscard]] std::vector<FingerGlyph> MakeFingerGlyphs(const plan::Snapshot& snapshot,
                                                        const PictureFrame& frame,
                                                        const RayTree& body,
                                                        const GlyphOptions& options = {});

/// Where the arrow of a finger's force ends; it begins at its contact. A finger that has left has
/// none.
/// @param largest_force  of the whole sequence, newtons: the longest arrow.
[[nodiscard]] std::optional<Eigen::Vector3d> ForceTip(const FingerGlyph& glyph,
                                                      double largest_force);

/// Of the legs of an align the one in which a finger leaves its place; none of a finger that stays.
[[nodiscard]] std::optional<int> FirstLeg(const FingerGlyph& glyph);

/// Space for a finger's number beyond its end, in diameters.
inline constexpr double kLabelSpace = 0.05;

/// The canvas's meshes that glyphs are made of.
struct GlyphMeshes {
  int friction_cone;
  int arrow_head;
};

/// Slant length of the friction cones, in diameters.
inline constexpr double kConeLength = 0.15;
/// The head of every arrow: a cone with this half-angle (radians) and slant length.
inline constexpr double kArrowHeadHalfAngle = 0.36;
inline constexpr double kArrowHeadLength = 0.040;

/// The shapes of one finger: ball, stem, friction cone and force; a released finger is a ghost with
/// an arrow that leaves, a placed one has an arrow that arrives, a moved one a ghost where it came
/// from and a track that ends in an arrowhead.
/// @param largest_force  as ForceTip.
void AddFingerShapes(const FingerGlyph& glyph, double largest_force, const GlyphMeshes& meshes,
                     std::vector<Shape>& shapes);

}  // namespace regrasp::render
