#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "planner/object/polygon.h"
#include "tests/fixtures/polygons.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {

using regrasp::OnEdge;

inline plan::FingerContact OnEdge(const object::Polygon& polygon, int finger, int edge,
                                  double share) {
  return {FingerIndex(finger), OnEdge(polygon, edge, share)};
}

/// Draw a contact uniformly over the boundary.
inline plan::FingerContact DrawOnBoundary(const object::Polygon& polygon, int finger,
                                          std::mt19937& random) {
  std::vector<double> lengths;
  for (FaceIndex edge{0}; edge < polygon.face_count(); ++edge) {
    lengths.push_back(polygon.face_measure(edge));
  }
  const int edge = std::discrete_distribution<int>(lengths.begin(), lengths.end())(random);
  return OnEdge(polygon, finger, edge, std::uniform_real_distribution<double>(0, 1)(random));
}

/// Return a plan for a planar object, by default for a hand of four fingers.
inline plan::Plan MakePlanarPlan(plan::FingerGrasp initial, double friction_angle_deg,
                                 int fingers = 4) {
  plan::Plan plan = MakePlan(std::move(initial), friction_angle_deg, fingers);
  plan.dimension = 2;
  return plan;
}

/// Return an L with arms of 80 mm length and 40 mm width. Its concave corner is at (0.04, 0.04),
/// between edges 2 (below it, inward normal −y) and 3 (next to it, inward normal −x).
inline object::Polygon MakeL() {
  return object::Polygon::FromWkt("POLYGON((0 0, .08 0, .08 .04, .04 .04, .04 .08, 0 .08, 0 0))",
                                  "L");
}

/// Return a square of side 80 mm with a square hole of side 40 mm, which has the edges 4 to 7.
inline object::Polygon MakeFrame() {
  return object::Polygon::FromWkt(
      "POLYGON((-.04 -.04, .04 -.04, .04 .04, -.04 .04, -.04 -.04),"
      "(-.02 -.02, -.02 .02, .02 .02, .02 -.02, -.02 -.02))",
      "frame");
}

/// Return a sliding step with four fingers around a square.
/// One of them turns at a corner at a share of the path.
inline plan::Align AroundTheCorner(const object::Polygon& square) {
  const auto grasp = [&](double right, double above, double left, const grasp::Contact& moving) {
    return plan::FingerGrasp{OnEdge(square, 0, 1, right),
                             OnEdge(square, 1, 2, above),
                             OnEdge(square, 2, 3, left),
                             {FingerIndex(3), moving}};
  };
  return {{grasp(0.963, 0.307, 0.433, OnEdge(square, 0, 0.303)),
           grasp(0.441, 0.798, 0.554, OnEdge(square, 0, 0)),
           grasp(0.441, 0.798, 0.554, OnEdge(square, 3, 1)),
           grasp(0.356, 0.878, 0.574, OnEdge(square, 3, 0.951))}};
}

}  // namespace regrasp::sim
