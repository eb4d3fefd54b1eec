#include "render/frames/viewpoint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "planner/base/number.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kAzimuths = 36;
constexpr std::array<double, 6> kElevationsDeg = {28, 38, 20, 48, 12, -18};
/// What each of these elevations costs: pictures from below look odd.
constexpr std::array<double, 6> kElevationCosts = {0, 0.04, 0.05, 0.2, 0.15, 0.8};

// Weights of the score, per finger or per pair of fingers.
constexpr double kSeen = 1.5;           ///< a finger from its contact to its end
constexpr double kForceSeen = 0.3;      ///< its force
constexpr double kLabelSeen = 0.4;      ///< its number
constexpr double kBodySeen = 0.5;       ///< the object fills as much of the picture as it can
constexpr double kForeshortened = 1.0;  ///< the stem points at the camera, or away
constexpr double kOverlap = 1.5;        ///< two fingers cover each other
constexpr double kEdgeOnFace = 0.5;     ///< all faces are seen edge-on
constexpr double kWorstSeen = 0.5;      ///< the finger of a frame that is seen worst

constexpr double kBodyHidden = 1.5;  ///< all of the object is behind a hand

/// What counts that is seen through a wall of the object, both of its sides.
constexpr double kThroughWall = 0.35;
/// What counts that is inside it.
constexpr double kInside = 0.7;
/// What counts that is seen through a hand.
constexpr double kThroughHand = 0.35;
constexpr int kMostSides = 4;

/// A finger with less than this of the score is not seen well enough: it points along the line of
/// sight behind a wall, or another one covers it. A view of a frame's own shows every finger about
/// as well as an undisturbed one behind a wall.
constexpr double kNotEnough = 0.1;
constexpr double kEnough = 0.6;

/// Two fingers nearer than this in the picture (diameters) disturb each other.
constexpr double kApart = 0.15;
/// A normal that leaves the image plane by less than this sine is a face seen edge-on.
constexpr double kEdgeOnSine = 0.14;
/// A stem within this cosine of the line of sight is foreshortened.
constexpr double kForeshortenedCosine = 0.80;

/// Nearer than this a ray meets the side that it starts on.
constexpr double kViewRaySkip = 1e-4;
/// Of a finger's number, in diameters.
constexpr double kViewLabelRadius = 0.025;
/// Of a fine mesh so many facets tell what the object looks like.
constexpr std::size_t kMostFacets = 4096;

/// Distance of two segments in the plane; zero where they cross.
double SegmentDistance(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const bool apart_cd = Cross(b - a, c - a) * Cross(b - a, d - a) > 0;
  const bool apart_ab = Cross(d - c, a - c) * Cross(d - c, b - c) > 0;
  if (!apart_cd && !apart_ab && Cross(b - a, d - c) != 0) return 0;
  return std::min({DistanceToSegment(a, c, d), DistanceToSegment(b, c, d),
                   DistanceToSegment(c, a, b), DistanceToSegment(d, a, b)});
}

/// What is seen of a finger, each of 1.
struct Sight {
  double ball = 0;
  double stem = 0;
  double force = 1;  ///< where it has none too
  double label = 0;

  [[nodiscard]] double Score() const {
    return kSeen * (ball + stem) / 2 + kForceSeen * force + kLabelSeen * label;
  }
};

/// Fingers before an object, seen from far away.
class ViewScene {
 public:
  /// All arguments outlive this object.
  ViewScene(const RayTree& body, const std::vector<FingerGlyph>& fingers,
            const Eigen::Matrix3d& axes, const Standing& standing)
      : body_(body), fingers_(fingers), axes_(axes), standing_(standing) {}

  [[nodiscard]] Sight Look(const FingerGlyph& glyph, double largest_force) const {
    Sight sight;
    sight.ball = BallShare(glyph);
    sight.stem =
        (Share(glyph, (glyph.ball + glyph.stem_end) / 2) + Share(glyph, glyph.stem_end)) / 2;
    if (const auto tip = ForceTip(glyph, largest_force)) sight.force = ForceShare(glyph, *tip);
    sight.label = LabelShare(glyph);
    return sight;
  }

  /// How much two fingers, from the stem's end to the cone's, cover each other.
  [[nodiscard]] double Overlap(const FingerGlyph& a, const FingerGlyph& b) const {
    const auto inner = [&](const FingerGlyph& g) {
      return Flat(g.contact - g.outward * kConeLength);
    };
    const double distance = SegmentDistance(Flat(a.end), inner(a), Flat(b.end), inner(b));
    return std::max(0.0, 1 - distance / kApart);
  }

 private:
  [[nodiscard]] Vector2d Flat(const Vector3d& p) const { return (axes_.transpose() * p).head<2>(); }

  /// Whether another finger stands before a point; one that leaves is a ghost.
  [[nodiscard]] bool IsCovered(const FingerGlyph& own, const Vector3d& p) const {
    const Vector2d flat = Flat(p);
    return std::ranges::any_of(fingers_, [&](const FingerGlyph& other) {
      if (&other == &own || other.role == plan::FingerRole::kReleased) return false;
      if ((other.ball - p).dot(axes_.col(2)) < 0) return false;
      const Vector2d ball = Flat(other.ball);
      return (flat - ball).norm() < other.ball_radius ||
             DistanceToSegment(flat, ball, Flat(other.end)) < other.stem_radius;
    });
  }

  /// How much is seen of what a finger has at a point.
  [[nodiscard]] double Share(const FingerGlyph& own, const Vector3d& p) const {
    if (IsCovered(own, p)) return 0;
    if (standing_.hand.empty()) return ThroughWalls(p, axes_.col(2));
    const double through_hand =
        IsMet(standing_.hand, p, axes_.col(2), kViewRaySkip) ? kThroughHand : 1;
    const Eigen::Isometry3d& to_body = standing_.to_body;
    return through_hand * ThroughWalls(to_body * p, to_body.linear() * axes_.col(2));
  }

  /// The same of the object alone, in its frame.
  [[nodiscard]] double ThroughWalls(const Vector3d& p, const Vector3d& back) const {
    const int sides = body_.CountHits(p, back, kViewRaySkip, kMostSides);
    return std::pow(kThroughWall, sides / 2) * (sides % 2 == 1 ? kInside : 1);
  }

  [[nodiscard]] double BallShare(const FingerGlyph& glyph) const {
    constexpr double kOff = 0.6;  // of its radius
    double share = Share(glyph, glyph.ball);
    for (const int axis : {0, 1}) {
      for (const double sign : {-1.0, 1.0}) {
        share += Share(glyph, glyph.ball + sign * kOff * glyph.ball_radius * axes_.col(axis));
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

  /// How free the freest place beside a finger's end is.
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
      const Vector2d ball = Flat(other.ball);
      const double gap =
          std::min((place - ball).norm() - other.ball_radius,
                   DistanceToSegment(place, ball, Flat(other.end)) - other.stem_radius);
      share = std::min(share, std::max(0.0, (gap / kViewLabelRadius + 1) / 2));
      const bool nearer = (place - ball).norm() < (place - Flat(own.ball)).norm();
      if (&other != &own && nearer) return 0;
    }
    return share;
  }

  const RayTree& body_;
  const std::vector<FingerGlyph>& fingers_;
  const Eigen::Matrix3d& axes_;
  const Standing& standing_;
};

/// How a frame looks from somewhere.
struct FrameSight {
  double mean = 0;    ///< score of its fingers
  double worst = 0;   ///< of them
  double hidden = 0;  ///< share of the object that a hand hides

  [[nodiscard]] double Score() const { return mean + kWorstSeen * worst - kBodyHidden * hidden; }
};

FrameSight LookAt(const RayTree& body, const std::vector<FingerGlyph>& fingers,
                  const Eigen::Matrix3d& axes, double largest_force, const Standing& standing) {
  if (fingers.empty()) return {};
  const ViewScene scene(body, fingers, axes, standing);
  std::vector<double> scores;
  for (const FingerGlyph& glyph : fingers) {
    scores.push_back(scene.Look(glyph, largest_force).Score());
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

/// Facets of a surface, evenly taken from all.
struct Facet {
  Vector3d corner;
  Vector3d normal;
  double area;
};

std::vector<Facet> TakeFacets(const FacetMesh& surface) {
  const std::size_t stride = 1 + surface.triangles.size() / kMostFacets;
  std::vector<Facet> facets;
  for (std::size_t i = 0; i < surface.triangles.size(); i += stride) {
    const auto& [a, b, c] = surface.triangles[i];
    facets.push_back({a, surface.normals[i][0], (b - a).cross(c - a).norm()});
  }
  return facets;
}

double EdgeOnShare(const std::vector<Facet>& facets, const Vector3d& back) {
  double edge_on = 0;
  double total = 0;
  for (const auto& [corner, normal, area] : facets) {
    total += area;
    edge_on += area * std::max(0.0, 1 - std::abs(normal.dot(back)) / kEdgeOnSine);
  }
  return edge_on / total;
}

/// Sides of the object in the picture, multiplied.
double PictureArea(const std::vector<Facet>& facets, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox2d box;
  for (const Facet& facet : facets) {
    box.extend(Vector2d((axes.transpose() * facet.corner).head<2>()));
  }
  return box.volume();
}

/// How much of an object a hand hides.
double HiddenShare(const std::vector<Facet>& facets, const Standing& standing,
                   const Vector3d& back) {
  constexpr std::size_t kPoints = 40;
  if (standing.hand.empty()) return 0;
  const Eigen::Isometry3d from_body = standing.to_body.inverse();
  const std::size_t stride = 1 + facets.size() / kPoints;
  int hidden = 0;
  int all = 0;
  for (std::size_t i = 0; i < facets.size(); i += stride) {
    ++all;
    if (IsMet(standing.hand, from_body * facets[i].corner, back, kViewRaySkip)) ++hidden;
  }
  return static_cast<double>(hidden) / all;
}

struct Candidate {
  Vector3d back;
  double body = 0;  ///< how well the object is seen, and how odd the place is
  double area = 0;  ///< of the object in the picture
  std::vector<FrameSight> frames = {};
};

std::vector<Candidate> ListCandidates(const BodyShape& body,
                                      const std::vector<std::vector<FingerGlyph>>& frames,
                                      double largest_force, const std::vector<Standing>& standing) {
  static const Standing kAlone;
  const std::vector<Facet> facets = TakeFacets(body.surface);
  std::vector<Candidate> candidates;
  for (std::size_t e = 0; e < kElevationsDeg.size(); ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      // Half a step off, so that no box is seen along a diagonal.
      const Vector3d back =
          ViewDirection{Radians(360.0 * (a + 0.3) / kAzimuths), Radians(kElevationsDeg[e])}
              .ToCamera();
      const Eigen::Matrix3d axes = CameraAxes(back);
      candidates.push_back({back, -kElevationCosts[e] - kEdgeOnFace * EdgeOnShare(facets, back),
                            PictureArea(facets, axes)});
      for (std::size_t i = 0; i < frames.size(); ++i) {
        const Standing& stands = standing.empty() ? kAlone : standing[i];
        candidates.back().frames.push_back(
            LookAt(body.rays, frames[i], axes, largest_force, stands));
        candidates.back().frames.back().hidden = HiddenShare(facets, stands, back);
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
                            double largest_force, const std::vector<Standing>& standing) {
  Viewpoints chosen = {Vector3d::UnitZ(), std::vector<std::optional<Vector3d>>(frames.size())};
  if (planar) return chosen;
  const std::vector<Candidate> candidates = ListCandidates(body, frames, largest_force, standing);
  const auto in_all = [&](const Candidate& candidate) {
    double score = 0;
    for (const FrameSight& frame : candidate.frames) score += frame.Score();
    return candidate.body + score / std::max<double>(candidate.frames.size(), 1);
  };
  const Candidate& common = std::ranges::max(candidates, {}, in_all);
  chosen.common = common.back;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (common.frames[i].worst >= kNotEnough) continue;
    const auto alone = [i](const Candidate& candidate) {
      const FrameSight& frame = candidate.frames[i];
      return std::pair(frame.worst >= kEnough, candidate.body + frame.Score());
    };
    const Candidate& best = std::ranges::max(candidates, {}, alone);
    if (best.frames[i].worst >= kEnough) chosen.own[i] = best.back;
  }
  return chosen;
}

}  // namespace regrasp::render
