#include "tests/sim/control/boundary_walk.h"

#include <algorithm>
#include <limits>

namespace regrasp::sim {

namespace {

/// Position of a finger on the path.
struct Walker {
  const object::Polygon& polygon;
  FingerIndex finger;
  FaceIndex edge;
  double at;                 ///< distance from the edge's start
  double rate;               ///< total length of the walk
  int first = 0, count = 0;  ///< edges of its ring

  Walker(const object::Polygon& body, const Walk& walk)
      : polygon(body),
        finger(walk.finger),
        edge(walk.edge),
        at(walk.share * body.face_measure(edge)),
        rate(walk.length) {
    for (const auto& ring : body.rings()) {
      first += count;
      count = static_cast<int>(ring.size());
      if (edge < first + count) break;
    }
  }

  /// Return the share of the path up to the next vertex.
  [[nodiscard]] double Rest() const {
    if (rate == 0) return std::numeric_limits<double>::infinity();
    return (rate > 0 ? polygon.face_measure(edge) - at : at) / std::abs(rate);
  }
  void Go(double share, bool to_vertex) {
    at += rate * share;
    if (to_vertex) at = rate > 0 ? polygon.face_measure(edge) : 0;
  }
  void Turn() {
    edge = FaceIndex(first + (edge - first + (rate > 0 ? 1 : count - 1)) % count);
    at = rate > 0 ? 0 : polygon.face_measure(edge);
  }
  [[nodiscard]] plan::FingerContact Contact() const {
    return OnEdge(polygon, finger, edge, std::clamp(at / polygon.face_measure(edge), 0.0, 1.0));
  }
};

/// Share of the path within which fingers reach their vertices simultaneously.
constexpr double kAtOnce = 1e-9;

}  // namespace

plan::Align WalkBoundary(const object::Polygon& polygon, const std::vector<Walk>& walks) {
  std::vector<Walker> walkers;
  for (const Walk& walk : walks) walkers.emplace_back(polygon, walk);
  plan::Align align;
  const auto add = [&] {
    plan::FingerGrasp grasp;
    for (const Walker& walker : walkers) grasp.push_back(walker.Contact());
    align.waypoints.push_back(std::move(grasp));
  };
  add();
  double left = 1;
  while (left > 0) {
    double next = left;
    for (const Walker& walker : walkers) next = std::min(next, walker.Rest());
    std::vector<Walker*> turning;
    for (Walker& walker : walkers) {
      const bool turns = walker.Rest() <= next + kAtOnce && next < left;
      walker.Go(next, turns);
      if (turns) turning.push_back(&walker);
    }
    left -= next;
    add();
    if (turning.empty()) break;
    for (Walker* walker : turning) walker->Turn();
    add();
  }
  return align;
}

plan::Plan MakeWalkPlan(const object::Polygon& polygon, const std::vector<Walk>& walks,
                        double friction_angle_deg) {
  plan::Align align = WalkBoundary(polygon, walks);
  plan::Plan plan = MakePlanarPlan(align.waypoints.front(), friction_angle_deg, 3);
  plan.goal = plan::ContactsOf(align.waypoints.back());
  plan.steps = {std::move(align)};
  return plan;
}

int CountTurns(const plan::Align& align) {
  int turns = 0;
  for (std::size_t j = 1; j < align.waypoints.size(); ++j) {
    for (std::size_t k = 0; k < align.waypoints[j].size(); ++k) {
      turns += align.waypoints[j][k].contact.face != align.waypoints[j - 1][k].contact.face;
    }
  }
  return turns;
}

namespace {

Eigen::Vector2d At(double turn, double radius) {
  const double angle = 2 * std::numbers::pi * turn;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

object::Polygon MakeGear(int teeth, double depth) {
  std::vector<Eigen::Vector2d> ring;
  for (int i = 0; i < 2 * teeth; ++i) {
    ring.push_back(At(0.5 * i / teeth, kDiscRadius * (i % 2 == 0 ? 1 : 1 - depth)));
  }
  return object::Polygon::FromRings({ring}, "gear");
}

object::Polygon MakeRing(int edges) {
  std::vector<Eigen::Vector2d> hole = Circle(edges, 0.6 * kDiscRadius);
  std::ranges::reverse(hole);
  return object::Polygon::FromRings({Circle(edges, kDiscRadius), hole}, "ring");
}

object::Polygon DrawOutline(int edges, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::pair<double, double>> waves;  // amplitude and phase of the radius
  for (int k = 2; k < 8; ++k) waves.emplace_back(0.15 * unit(random) / k, unit(random));
  std::vector<double> turns;
  for (int i = 0; i < edges; ++i) turns.push_back((i + 0.95 * unit(random)) / edges);
  std::vector<Eigen::Vector2d> ring;
  for (const double turn : turns) {
    double radius = 1;
    for (std::size_t k = 0; k < waves.size(); ++k) {
      const auto& [size, phase] = waves[k];
      radius += size * std::sin(2 * std::numbers::pi * ((k + 2.0) * turn + phase));
    }
    ring.push_back(At(turn, kDiscRadius * radius));
  }
  return object::Polygon::FromRings({ring}, "outline");
}

}  // namespace regrasp::sim
