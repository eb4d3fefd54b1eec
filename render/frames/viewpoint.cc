#include "render/frames/viewpoint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "planner/base/angle.h"
#include "render/picture/plane_geometry.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kAzimuths = 36;
constexpr std::array<double, 6> kElevationsDeg = {28, 38, 20, 48, 12, -18};
/// What each of these elevations costs: pictures from below look odd.
constexpr std::array<double, 6> kElevationCosts = {0, 0.04, 0.05, 0.2, 0.15, 0.8};

// Weights of the score, per contact or per pair of contacts.
constexpr double kSeen = 1.5;           ///< a finger from its contact to its end
constexpr double kBodySeen = 0.5;       ///< the object fills as much of the picture as it can
constexpr double kForeshortened = 1.0;  ///< the stem points at the camera, or away
constexpr double kOverlap = 1.5;        ///< two fingers cover each other
constexpr double kEdgeOnFace = 0.5;     ///< all faces are seen edge-on
/// What a finger counts that is seen through the object.
constexpr double kShinesThrough = 0.35;
/// Two fingers nearer than this in the picture (diameters) disturb each other.
constexpr double kApart = 0.15;
/// A normal that leaves the image plane by less than this sine is a face seen edge-on.
constexpr double kEdgeOnSine = 0.14;
/// A stem within this cosine of the line of sight is foreshortened.
constexpr double kForeshortenedCosine = 0.80;

/// Distance of two segments in the plane; zero where they cross.
double SegmentDistance(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const bool apart_cd = Cross(b - a, c - a) * Cross(b - a, d - a) > 0;
  const bool apart_ab = Cross(d - c, a - c) * Cross(d - c, b - c) > 0;
  if (!apart_cd && !apart_ab && Cross(b - a, d - c) != 0) return 0;
  return std::min({DistanceToSegment(a, c, d), DistanceToSegment(b, c, d),
                   DistanceToSegment(c, a, b), DistanceToSegment(d, a, b)});
}

/// How much of a finger nothing stands before, of 1: what the object hides shines through.
double SeenShare(const FingerGlyph& glyph, const Vector3d& back, const FacetMesh& surface) {
  constexpr int kSamples = 3;
  double seen = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Vector3d p = glyph.ball + i / (kSamples - 1.0) * (glyph.stem_end - glyph.ball);
    const bool clear = std::isinf(RayDistance(surface, p, back, glyph.ball_radius / 2));
    seen += clear ? 1 : kShinesThrough;
  }
  return seen / kSamples;
}

double ScoreFinger(const FingerGlyph& glyph, const Vector3d& back, const FacetMesh& surface) {
  double score = kSeen * SeenShare(glyph, back, surface);
  const double excess = std::abs(glyph.outward.dot(back)) - kForeshortenedCosine;
  if (excess > 0) score -= kForeshortened * excess / (1 - kForeshortenedCosine);
  return score;
}

/// How much two fingers, from the stem's end to the cone's, cover each other.
double Overlap(const FingerGlyph& a, const FingerGlyph& b, const Eigen::Matrix3d& axes) {
  const auto flat = [&](const Vector3d& p) -> Vector2d { return (axes.transpose() * p).head<2>(); };
  const auto inner = [&](const FingerGlyph& g) {
    return flat(g.contact - g.outward * kConeLength);
  };
  const double distance = SegmentDistance(flat(a.end), inner(a), flat(b.end), inner(b));
  return std::max(0.0, 1 - distance / kApart);
}

double EdgeOnShare(const FacetMesh& surface, const Vector3d& back) {
  double edge_on = 0;
  double total = 0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& [a, b, c] = surface.triangles[i];
    const double area = (b - a).cross(c - a).norm();
    const double sine = std::abs(surface.normals[i][0].dot(back));
    total += area;
    edge_on += area * std::max(0.0, 1 - sine / kEdgeOnSine);
  }
  return edge_on / total;
}

/// Sides of the object in the picture, multiplied.
double PictureArea(const FacetMesh& surface, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox2d box;
  for (const auto& corners : surface.triangles) {
    box.extend(Vector2d((axes.transpose() * corners[0]).head<2>()));
  }
  return box.volume();
}

double ScoreFingers(const FacetMesh& surface, const std::vector<std::vector<FingerGlyph>>& frames,
                    const Eigen::Matrix3d& axes) {
  double score = 0;
  int fingers = 0;
  // A finger that holds on stands in many frames and is seen as well in all of them.
  std::map<std::array<double, 6>, double> scores;
  for (const std::vector<FingerGlyph>& frame : frames) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const Vector3d& a = frame[i].ball;
      const Vector3d& b = frame[i].stem_end;
      const auto [known, is_new] = scores.try_emplace({a.x(), a.y(), a.z(), b.x(), b.y(), b.z()});
      if (is_new) known->second = ScoreFinger(frame[i], axes.col(2), surface);
      score += known->second;
      ++fingers;
      for (std::size_t j = i + 1; j < frame.size(); ++j) {
        score -= kOverlap * Overlap(frame[i], frame[j], axes);
      }
    }
  }
  return score / std::max(fingers, 1);
}

struct Candidate {
  Vector3d back;
  double score;
  double area;  ///< of the object in the picture
};

}  // namespace

Vector3d ViewDirection::ToCamera() const {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

Vector3d ChooseViewpoint(const BodyShape& body, bool planar,
                         const std::vector<std::vector<FingerGlyph>>& frames) {
  if (planar) return Vector3d::UnitZ();
  std::vector<Candidate> candidates;
  for (std::size_t e = 0; e < kElevationsDeg.size(); ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      // Half a step off, so that no box is seen along a diagonal.
      const Vector3d back =
          ViewDirection{Radians(360.0 * (a + 0.3) / kAzimuths), Radians(kElevationsDeg[e])}
              .ToCamera();
      const Eigen::Matrix3d axes = CameraAxes(back);
      const double score = ScoreFingers(body.surface, frames, axes) - kElevationCosts[e] -
                           kEdgeOnFace * EdgeOnShare(body.surface, back);
      candidates.push_back({back, score, PictureArea(body.surface, axes)});
    }
  }
  const double largest = std::ranges::max(candidates, {}, &Candidate::area).area;
  const auto score = [&](const Candidate& c) { return c.score + kBodySeen * c.area / largest; };
  return std::ranges::max(candidates, {}, score).back;
}

}  // namespace regrasp::render
