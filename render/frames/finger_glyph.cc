#include "render/frames/finger_glyph.h"

#include <algorithm>

#include "planner/object/rotation.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

// Lengths in object diameters.
constexpr double kFingertipRadius = 0.030;
constexpr double kStemRadius = 0.013;
constexpr double kStemLength = 0.125;  // from the contact to the end of the stem
constexpr double kForceRadius = 0.0055;
constexpr double kLongestForce = 0.20;
constexpr double kShortestForce = 0.055;
constexpr double kMostForce = 0.25;  // of a force that is larger than the largest
constexpr double kMotionGap = 0.030;
constexpr double kMotionLength = 0.085;
constexpr double kArrowSpace = kMotionGap + kMotionLength;
constexpr double kMotionRadius = 0.009;
constexpr double kTrackRadius = 0.007;
constexpr double kTrackDash = 0.030;
/// Distance of a track's end from the fingertip that hides it, in fingertip radii.
constexpr double kBeforeFingertip = 1.7;

/// Shares of the free space in front of a contact that sphere and stem can use. Less than half, so
/// that the finger on the opposite side has space too.
constexpr double kFingertipShare = 0.15;
constexpr double kStemShare = 0.45;

/// Distance within which a ray ignores the surface at its origin.
constexpr double kRaySkip = 1e-4;

constexpr double kConeOpacity = 0.5;
constexpr double kGhostGlyphOpacity = 0.33;

/// Return the pose of a mesh that opens along +z at the origin, moved to `apex` and opening along
/// `direction`.
Eigen::Isometry3d PoseAlong(const Vector3d& apex, const Vector3d& direction) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = object::AligningRotation(Vector3d::UnitZ(), direction).toRotationMatrix();
  pose.translation() = apex;
  return pose;
}

void AddArrow(const Vector3d& tail, const Vector3d& tip, double radius, Color color,
              const GlyphMeshes& meshes, std::vector<Shape>& shapes) {
  const Vector3d direction = (tip - tail).normalized();
  const Vector3d neck = tip - direction * (0.8 * kArrowHeadLength);
  shapes.push_back({Capsule{tail, neck, radius}, color});
  shapes.push_back({MeshInstance{meshes.arrow_head, PoseAlong(tip, -direction)}, color});
}

/// Add the dashes from a to b of a path with length `before` up to a. The pattern continues over
/// corners.
void AddDashes(const Vector3d& a, const Vector3d& b, double before, Color color,
               std::vector<Shape>& shapes) {
  const double after = before + (b - a).norm();
  const Vector3d along = (b - a).normalized();
  for (int k = static_cast<int>(before / (2 * kTrackDash)); 2 * k * kTrackDash < after; ++k) {
    const double start = std::max(2 * k * kTrackDash, before) - before;
    const double end = std::min((2 * k + 1) * kTrackDash, after) - before;
    if (start < end)
      shapes.push_back({Capsule{a + along * start, a + along * end, kTrackRadius}, color});
  }
}

/// Add the path of a sliding finger just off the surface: a ghost at its start, dashes, and an
/// arrow head in front of the fingertip if the path is long enough.
void AddTrack(const FingerGlyph& glyph, Color color, const GlyphMeshes& meshes,
              std::vector<Shape>& shapes) {
  if (!FirstLeg(glyph)) return;
  const Vector3d lift = glyph.outward * kTrackRadius;
  // The orientation of the finger at its start is unknown.
  shapes.push_back({Sphere{glyph.path.front(), glyph.fingertip_radius}, color, kGhostGlyphOpacity});
  shapes.push_back({Sphere{glyph.path.front() + lift, 2 * kTrackRadius}, color});
  double before = 0;
  for (std::size_t i = 1; i < glyph.path.size(); ++i) {
    AddDashes(glyph.path[i - 1] + lift, glyph.path[i] + lift, before, color, shapes);
    before += (glyph.path[i] - glyph.path[i - 1]).norm();
  }
  // The finger can stop while others continue.
  const auto last = std::find_if(glyph.path.rbegin(), glyph.path.rend(),
                                 [&](const Vector3d& p) { return p != glyph.path.back(); });
  const Vector3d leg = glyph.contact - *last;
  if (leg.norm() < kArrowHeadLength) return;
  const double back =
      std::min(kBeforeFingertip * glyph.fingertip_radius, leg.norm() - kArrowHeadLength);
  const Vector3d tip = glyph.contact - leg.normalized() * back + lift;
  shapes.push_back({MeshInstance{meshes.arrow_head, PoseAlong(tip, -leg.normalized())}, color});
}

bool IsInMotion(plan::FingerRole role) {
  return role == plan::FingerRole::kPlaced || role == plan::FingerRole::kReleased;
}

}  // namespace

Eigen::Isometry3d NormalizedFrame::BodyPose(const Eigen::Isometry3d& X_WO) const {
  Eigen::Isometry3d pose = X_WO;
  pose.translation() = FromWorld(X_WO * centroid_m);
  return pose;
}

std::vector<FingerGlyph> MakeFingerGlyphs(const plan::Snapshot& snapshot,
                                          const NormalizedFrame& frame, const RayTree& body,
                                          const GlyphOptions& options) {
  const Eigen::Isometry3d to_body = frame.BodyPose(snapshot.X_WO).inverse();
  std::vector<FingerGlyph> glyphs;
  for (const plan::FingerState& state : snapshot.fingers) {
    const bool is_free = state.role == plan::FingerRole::kFree;
    if (is_free && (!options.free_fingers || state.normal_W.isZero())) continue;
    FingerGlyph glyph;
    glyph.finger = state.finger;
    glyph.role = state.role;
    glyph.color = FingerColor(state.finger);
    glyph.contact = frame.FromWorld(state.contact_W);
    for (const Vector3d& p_W : state.path_W) glyph.path.push_back(frame.FromWorld(p_W));
    glyph.outward = -state.normal_W.normalized();
    glyph.force = state.force_W;
    const double clearance =
        body.Distance(to_body * glyph.contact, to_body.linear() * glyph.outward, kRaySkip);
    glyph.fingertip_radius =
        options.finger_radius.value_or(std::min(kFingertipRadius, kFingertipShare * clearance));
    glyph.stem_radius =
        options.finger_radius.value_or(kStemRadius * glyph.fingertip_radius / kFingertipRadius);
    const double stem =
        std::max(2 * glyph.fingertip_radius, std::min(kStemLength, kStemShare * clearance));
    glyph.fingertip = glyph.contact + glyph.outward * glyph.fingertip_radius;
    glyph.stem_end = glyph.contact + glyph.outward * stem;
    const bool has_arrow = IsInMotion(state.role) && clearance > kStemLength + kArrowSpace;
    glyph.end = glyph.stem_end + (has_arrow ? kArrowSpace : 0) * glyph.outward;
    glyphs.push_back(glyph);
  }
  return glyphs;
}

std::optional<Vector3d> ForceTip(const FingerGlyph& glyph, double largest_force) {
  const double size = glyph.force.norm();
  if (glyph.role == plan::FingerRole::kReleased || !(size > 0 && largest_force > 0)) {
    return std::nullopt;
  }
  // Forces during a motion can exceed those of the static grasps.
  const double length =
      std::clamp(kLongestForce * size / largest_force, kShortestForce, kMostForce);
  return glyph.contact + glyph.force / size * length;
}

std::optional<int> FirstLeg(const FingerGlyph& glyph) {
  const auto leaves =
      std::ranges::find_if(glyph.path, [&](const Vector3d& p) { return p != glyph.path.front(); });
  if (glyph.role != plan::FingerRole::kMoved || leaves == glyph.path.end()) return std::nullopt;
  return static_cast<int>(leaves - glyph.path.begin());
}

void AddFingerShapes(const FingerGlyph& glyph, double largest_force, const GlyphMeshes& meshes,
                     std::vector<Shape>& shapes) {
  const Color color = glyph.color;
  const bool ghost = glyph.role == plan::FingerRole::kReleased;
  const double opacity = ghost ? kGhostGlyphOpacity : 1;
  shapes.push_back({Sphere{glyph.fingertip, glyph.fingertip_radius}, color, opacity});
  const Vector3d stem_start =
      glyph.fingertip + glyph.outward * (glyph.fingertip_radius - glyph.stem_radius);
  shapes.push_back({Capsule{stem_start, glyph.stem_end, glyph.stem_radius}, color, opacity});
  if (glyph.end != glyph.stem_end) {
    const Vector3d near = glyph.stem_end + glyph.outward * kMotionGap;
    AddArrow(ghost ? near : glyph.end, ghost ? glyph.end : near, kMotionRadius, color, meshes,
             shapes);
  }
  if (ghost || glyph.role == plan::FingerRole::kFree) return;
  const Eigen::Isometry3d cone = PoseAlong(glyph.contact, -glyph.outward);
  shapes.push_back({MeshInstance{meshes.friction_cone, cone}, color, kConeOpacity});
  if (const auto tip = ForceTip(glyph, largest_force)) {
    AddArrow(glyph.contact, *tip, kForceRadius, glyph.force_color, meshes, shapes);
  }
  if (glyph.role == plan::FingerRole::kMoved) AddTrack(glyph, color, meshes, shapes);
}

}  // namespace regrasp::render
