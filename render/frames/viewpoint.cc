#include "render/frames/viewpoint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/base/angle.h"
#include "render/picture/plane_geometry.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kAzimuths = 36;
constexpr std::array<double, 6> kElevationsDeg = {28, 38, 20, 48, 12, -18};
/// What each of these elevations costs: pictures from below look odd.
constexpr std::array<double, 6> kElevationCosts = {0, 0.02, 0.05, 0.08, 0.15, 0.8};

/// A planar object is tilted a little, so that the prism shows which way the fingers stand.
const Vector3d kPlanarView = Vector3d(0.0, -0.28, 1.0).normalized();

// Weights of the score, per contact or per pair of contacts.
constexpr double kSeen = 1.0;           ///< the contact is on the near side, nothing before it
constexpr double kForeshortened = 1.0;  ///< the stem points at the camera, or away
constexpr double kOverlap = 1.5;        ///< two fingers cover each other
constexpr double kEdgeOnFace = 0.5;     ///< all faces are seen edge-on
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

double ScoreFinger(const FingerGlyph& glyph, const Vector3d& back, const FacetMesh& surface) {
  const double facing = glyph.outward.dot(back);
  double score = 0;
  const bool front = facing > 0;
  if (front && std::isinf(RayDistance(surface, glyph.ball, back, glyph.ball_radius / 2))) {
    score += kSeen;
  }
  const double excess = std::abs(facing) - kForeshortenedCosine;
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

double Score(const BodyShape& body, const std::vector<std::vector<FingerGlyph>>& frames,
             const Vector3d& back) {
  const Eigen::Matrix3d axes = CameraAxes(back);
  double score = 0;
  int fingers = 0;
  for (const std::vector<FingerGlyph>& frame : frames) {
    for (std::size_t i = 0; i < frame.size(); ++i) {
      score += ScoreFinger(frame[i], back, body.surface);
      ++fingers;
      for (std::size_t j = i + 1; j < frame.size(); ++j) {
        score -= kOverlap * Overlap(frame[i], frame[j], axes);
      }
    }
  }
  return score / std::max(fingers, 1) - kEdgeOnFace * EdgeOnShare(body.surface, back);
}

}  // namespace

Vector3d ChooseViewpoint(const BodyShape& body, bool planar,
                         const std::vector<std::vector<FingerGlyph>>& frames) {
  if (planar) return kPlanarView;
  Vector3d best = Vector3d::UnitX();
  double best_score = -std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < kElevationsDeg.size(); ++e) {
    for (int a = 0; a < kAzimuths; ++a) {
      // Half a step off, so that no box is seen along a diagonal.
      const double azimuth = Radians(360.0 * (a + 0.3) / kAzimuths);
      const double elevation = Radians(kElevationsDeg[e]);
      const Vector3d back(std::cos(elevation) * std::cos(azimuth),
                          std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double score = Score(body, frames, back) - kElevationCosts[e];
      if (score > best_score) {
        best_score = score;
        best = back;
      }
    }
  }
  return best;
}

}  // namespace regrasp::render
