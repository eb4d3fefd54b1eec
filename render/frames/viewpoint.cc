#include "render/frames/viewpoint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "planner/base/number.h"
#include "render/picture/caption.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kAzimuths = 36;
constexpr std::array<double, 6> kElevationsDeg = {28, 38, 20, 48, 12, -18};
/// Costs of these elevations: images from below look unusual.
constexpr std::array<double, 6> kElevationCosts = {0, 0.04, 0.05, 0.2, 0.15, 0.8};

// Weights of the score, per finger or per pair of fingers.
constexpr double kSeen = 1.5;           ///< visible finger from its contact to its end
constexpr double kForceSeen = 0.3;      ///< visible force
constexpr double kLabelSeen = 0.4;      ///< visible number
constexpr double kBodySeen = 0.5;       ///< object that fills as much of the image as possible
constexpr double kForeshortened = 1.0;  ///< stem parallel to the line of visibility
constexpr double kOverlap = 1.5;        ///< two fingers that cover each other
constexpr double kEdgeOnFace = 0.5;     ///< all faces edge-on
constexpr double kWorstSeen = 0.5;      ///< least visible finger of a frame

constexpr double kBodyHidden = 1.5;  ///< object completely behind a hand

/// Visibility through a wall of the object, that is both of its sides.
constexpr double kThroughWall = 0.35;
/// Visibility of a point inside the object.
constexpr double kInside = 0.7;
/// Visibility through a hand.
constexpr double kThroughHand = 0.35;
constexpr int kMaxSides = 4;

/// Scores below which a finger is not visible enough, and above which an own viewpoint is accepted.
/// The first means parallel to the line of visibility behind a wall, or covered by another finger.
/// The second is about the score of an undisturbed finger behind a wall.
constexpr double kNotEnough = 0.1;
constexpr double kEnough = 0.6;

/// Distance in the image (diameters) below which two fingers disturb each other.
constexpr double kApart = 0.15;
/// Sine of the angle between normal and image plane below which a face counts as edge-on.
constexpr double kEdgeOnSine = 0.14;
/// Cosine of the angle to the line of visibility above which a stem is foreshortened.
constexpr double kForeshortenedCosine = 0.80;

/// Distance within which a ray ignores the surface at its origin.
constexpr double kViewRaySkip = 1e-4;
/// Radius of a finger's number, in diameters.
constexpr double kViewLabelRadius = 0.025;
/// Maximum number of triangles of a fine mesh that are evaluated.
constexpr std::size_t kMaxTriangles = 4096;

/// Return the distance of two segments in the plane; zero if they intersect.
double SegmentDistance(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const bool apart_cd = Cross(b - a, c - a) * Cross(b - a, d - a) > 0;
  const bool apart_ab = Cross(d - c, a - c) * Cross(d - c, b - c) > 0;
  if (!apart_cd && !apart_ab && Cross(b - a, d - c) != 0) return 0;
  return std::min({DistanceToSegment(a, c, d), DistanceToSegment(b, c, d),
                   DistanceToSegment(c, a, b), DistanceToSegment(d, a, b)});
}

/// Visibility of the parts of a finger, each from 0 to 1.
struct Visibility {
  double fingertip = 0;
  double stem = 0;
  double force = 1;  ///< 1 also for a finger without force
  double label = 0;

  [[nodiscard]] double Score() const {
    return kSeen * (fingertip + stem) / 2 + kForceSeen * force + kLabelSeen * label;
  }
};

/// Fingers in front of an object, in a parallel projection.
class ViewScene {
 public:
  /// Create a scene. All arguments must outlive it.
  ViewScene(const RayTree& body, const std::vector<FingerGlyph>& fingers,
            const Eigen::Matrix3d& axes, const FramePlacement& placements)
      : body_(body), fingers_(fingers), axes_(axes), placement_(placements) {}

  [[nodiscard]] Visibility Evaluate(const FingerGlyph& glyph, double largest_force) const {
    Visibility visibility;
    visibility.fingertip = FingertipShare(glyph);
    visibility.stem =
        (Share(glyph, (glyph.fingertip + glyph.stem_end) / 2) + Share(glyph, glyph.stem_end)) / 2;
    if (const auto tip = ForceTip(glyph, largest_force)) visibility.force = ForceShare(glyph, *tip);
    visibility.label = LabelShare(glyph);
    return visibility;
  }

  /// Return the overlap of two fingers, from the ends of their stems to the ends of their cones.
  [[nodiscard]] double Overlap(const FingerGlyph& a, const FingerGlyph& b) const {
    const auto inner = [&](const FingerGlyph& g) {
      return Flat(g.contact - g.outward * kConeLength);
    };
    const double distance = SegmentDistance(Flat(a.end), inner(a), Flat(b.end), inner(b));
    return std::max(0.0, 1 - distance / kApart);
  }

 private:
  [[nodiscard]] Vector2d Flat(const Vector3d& p) const { return (axes_.transpose() * p).head<2>(); }

  /// Return whether another finger is in front of a point. Released fingers are ghosts and do not
  /// count.
  [[nodiscard]] bool IsCovered(const FingerGlyph& own, const Vector3d& p) const {
    const Vector2d flat = Flat(p);
    return std::ranges::any_of(fingers_, [&](const FingerGlyph& other) {
      if (&other == &own || other.role == plan::FingerRole::kReleased) return false;
      if ((other.fingertip - p).dot(axes_.col(2)) < 0) return false;
      const Vector2d fingertip = Flat(other.fingertip);
      return (flat - fingertip).norm() < other.fingertip_radius ||
             DistanceToSegment(flat, fingertip, Flat(other.end)) < other.stem_radius;
    });
  }

  /// Return the visibility of a point of a finger.
  [[nodiscard]] double Share(const FingerGlyph& own, const Vector3d& p) const {
    if (IsCovered(own, p)) return 0;
    if (placement_.hand.empty()) return ThroughWalls(p, axes_.col(2));
    const double through_hand =
        IsHit(placement_.hand, p, axes_.col(2), kViewRaySkip) ? kThroughHand : 1;
    const Eigen::Isometry3d& to_body = placement_.to_body;
    return through_hand * ThroughWalls(to_body * p, to_body.linear() * axes_.col(2));
  }

  /// Return the visibility of a point behind the object alone, in the object frame.
  [[nodiscard]] double ThroughWalls(const Vector3d& p, const Vector3d& back) const {
    const int sides = body_.CountHits(p, back, kViewRaySkip, kMaxSides);
    return std::pow(kThroughWall, sides / 2) * (sides % 2 == 1 ? kInside : 1);
  }

  [[nodiscard]] double FingertipShare(const FingerGlyph& glyph) const {
    constexpr double kOff = 0.6;  // in fingertip radii
    double share = Share(glyph, glyph.fingertip);
    for (const int axis : {0, 1}) {
      for (const double sign : {-1.0, 1.0}) {
        share +=
            Share(glyph, glyph.fingertip + sign * kOff * glyph.fingertip_radius * axes_.col(axis));
      }
    }
    return share / 5;
  }

  [[nodiscard]] double ForceShare(const FingerGlyph& glyph, const Vector3d& tip) const {
    constexpr std::array<double, 3> kPlaces = {0.4, 0.7, 1};
    const Vector3d arrow = tip - glyph.contact;
    double share = 0;
    for (const double place : kPlaces) share += Share(glyph, glyph.contact + place * arrow);
    const double length = Flat(arrow).norm() / arrow.norm();
    return length * share / kPlaces.size();
  }

  /// Return the free share of the best label position next to the end of a finger.
  [[nodiscard]] double LabelShare(const FingerGlyph& glyph) const {
    constexpr int kPlaces = 8;
    double freest = 0;
    for (int i = 0; i < kPlaces; ++i) {
      const double turn = 2 * std::numbers::pi * i / kPlaces;
      const Vector2d place =
          Flat(glyph.end) + kLabelSpace * Vector2d(std::cos(turn), std::sin(turn));
      freest = std::max(freest, FreeShare(glyph, place));
    }
    return freest;
  }

  [[nodiscard]] double FreeShare(const FingerGlyph& own, const Vector2d& place) const {
    double share = 1;
    for (const FingerGlyph& other : fingers_) {
      const Vector2d fingertip = Flat(other.fingertip);
      const double gap =
          std::min((place - fingertip).norm() - other.fingertip_radius,
                   DistanceToSegment(place, fingertip, Flat(other.end)) - other.stem_radius);
      share = std::min(share, std::max(0.0, (gap / kViewLabelRadius + 1) / 2));
      const bool nearer = (place - fingertip).norm() < (place - Flat(own.fingertip)).norm();
      if (&other != &own && nearer) return 0;
    }
    return share;
  }

  const RayTree& body_;
  const std::vector<FingerGlyph>& fingers_;
  const Eigen::Matrix3d& axes_;
  const FramePlacement& placement_;
};

/// Evaluation of a frame from one direction.
struct FrameScore {
  double mean = 0;    ///< mean score of its fingers
  double worst = 0;   ///< lowest score of its fingers
  double hidden = 0;  ///< share of the object that a hand hides

  [[nodiscard]] double Score() const { return mean + kWorstSeen * worst - kBodyHidden * hidden; }
};

FrameScore EvaluateView(const RayTree& body, const std::vector<FingerGlyph>& fingers,
                        const Eigen::Matrix3d& axes, double largest_force,
                        const FramePlacement& placements) {
  if (fingers.empty()) return {};
  const ViewScene scene(body, fingers, axes, placements);
  std::vector<double> scores;
  for (const FingerGlyph& glyph : fingers) {
    scores.push_back(scene.Evaluate(glyph, largest_force).Score());
    const double excess = std::abs(glyph.outward.dot(axes.col(2))) - kForeshortenedCosine;
    if (excess > 0) scores.back() -= kForeshortened * excess / (1 - kForeshortenedCosine);
  }
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    for (std::size_t j = i + 1; j < fingers.size(); ++j) {
      const double overlap = scene.Overlap(fingers[i], fingers[j]);
      for (const std::size_t k : {i, j}) scores[k] -= kOverlap / 2 * overlap;
    }
  }
  const double sum = std::accumulate(scores.begin(), scores.end(), 0.0);
  return {sum / std::ssize(scores), std::ranges::min(scores)};
}

/// Evenly sampled triangles of a surface.
struct SampledTriangle {
  Vector3d corner;
  Vector3d normal;
  double area;
};

std::vector<SampledTriangle> SampleTriangles(const ShadedMesh& surface) {
  const std::size_t stride = 1 + surface.triangles.size() / kMaxTriangles;
  std::vector<SampledTriangle> triangles;
  for (std::size_t i = 0; i < surface.triangles.size(); i += stride) {
    const auto& [a, b, c] = surface.triangles[i];
    triangles.push_back({a, surface.normals[i][0], (b - a).cross(c - a).norm()});
  }
  return triangles;
}

double EdgeOnShare(const std::vector<SampledTriangle>& triangles, const Vector3d& back) {
  double edge_on = 0;
  double total = 0;
  for (const auto& [corner, normal, area] : triangles) {
    total += area;
    edge_on += area * std::max(0.0, 1 - std::abs(normal.dot(back)) / kEdgeOnSine);
  }
  return edge_on / total;
}

/// Return the area of the object's bounding box in the image.
double ImageArea(const std::vector<SampledTriangle>& triangles, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox2d box;
  for (const SampledTriangle& triangle : triangles) {
    box.extend(Vector2d((axes.transpose() * triangle.corner).head<2>()));
  }
  return box.volume();
}

/// Return the share of an object that a hand hides.
double HiddenShare(const std::vector<SampledTriangle>& triangles, const FramePlacement& placements,
                   const Vector3d& back) {
  constexpr std::size_t kPoints = 40;
  if (placements.hand.empty()) return 0;
  const Eigen::Isometry3d from_body = placements.to_body.inverse();
  const std::size_t stride = 1 + triangles.size() / kPoints;
  int hidden = 0;
  int all = 0;
  for (std::size_t i = 0; i < triangles.size(); i += stride) {
    ++all;
    if (IsHit(placements.hand, from_body * triangles[i].corner, back, kViewRaySkip)) ++hidden;
  }
  return static_cast<double>(hidden) / all;
}

struct Candidate {
  Vector3d back;
  double body = 0;  ///< visibility of the object minus the cost of the elevation
  double area = 0;  ///< image area of the object
  std::vector<FrameScore> frames = {};
};

std::vector<Candidate> ListCandidates(const BodyShape& body,
                                      const std::vector<std::vector<FingerGlyph>>& frames,
                                      double largest_force,
                                      const std::vector<FramePlacement>& placements) {
  static const FramePlacement kAlone;
  const std::vector<SampledTriangle> triangles = SampleTriangles(body.surface);
  std::vector<Candidate> candidates;
  for (std::size_t e = 0; e < kElevationsDeg.size(); ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      // Offset by a part of a step, so that no box is seen along a diagonal.
      const Vector3d back =
          ViewDirection{Radians(360.0 * (a + 0.3) / kAzimuths), Radians(kElevationsDeg[e])}
              .ToCamera();
      const Eigen::Matrix3d axes = CameraAxes(back);
      candidates.push_back({back, -kElevationCosts[e] - kEdgeOnFace * EdgeOnShare(triangles, back),
                            ImageArea(triangles, axes)});
      for (std::size_t i = 0; i < frames.size(); ++i) {
        const FramePlacement& placement = placements.empty() ? kAlone : placements[i];
        candidates.back().frames.push_back(
            EvaluateView(body.rays, frames[i], axes, largest_force, placement));
        candidates.back().frames.back().hidden = HiddenShare(triangles, placement, back);
      }
    }
  }
  const double largest = std::ranges::max(candidates, {}, &Candidate::area).area;
  for (Candidate& candidate : candidates) candidate.body += kBodySeen * candidate.area / largest;
  return candidates;
}

}  // namespace

Vector3d ViewDirection::ToCamera() const {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

Viewpoints ChooseViewpoints(const BodyShape& body, bool planar,
                            const std::vector<std::vector<FingerGlyph>>& frames,
                            double largest_force, const std::vector<FramePlacement>& placements) {
  Viewpoints chosen = {Vector3d::UnitZ(), std::vector<std::optional<Vector3d>>(frames.size())};
  if (planar) return chosen;
  const std::vector<Candidate> candidates = ListCandidates(body, frames, largest_force, placements);
  const auto in_all = [&](const Candidate& candidate) {
    double score = 0;
    for (const FrameScore& frame : candidate.frames) score += frame.Score();
    return candidate.body + score / std::max<double>(candidate.frames.size(), 1);
  };
  const Candidate& common = std::ranges::max(candidates, {}, in_all);
  chosen.common = common.back;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (common.frames[i].worst >= kNotEnough) continue;
    const auto alone = [i](const Candidate& candidate) {
      const FrameScore& frame = candidate.frames[i];
      return std::pair(frame.worst >= kEnough, candidate.body + frame.Score());
    };
    const Candidate& best = std::ranges::max(candidates, {}, alone);
    if (best.frames[i].worst >= kEnough) chosen.own[i] = best.back;
  }
  return chosen;
}

}  // namespace regrasp::render
