#include "tests/planner/sets/polygon/brute_force.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "planner/grasp/force_closure.h"
#include "planner/sets/polygon/concurrent.h"

namespace regrasp::polygon {
namespace {

constexpr std::size_t kMostFailures = 20;  // more add no information
constexpr double kCrowding = 4;            // contacts near ends are at distance v^kCrowding

std::vector<int> EdgesWithout(const std::vector<int>& edges, int edge) {
  std::vector<int> rest;
  for (const int e : edges) {
    if (e != edge) rest.push_back(e);
  }
  return rest;
}

}  // namespace

BruteForce::BruteForce(const object::Polygon& polygon, const PolygonGraph& graph,
                       double friction_angle, planning::Spanning spanning, std::uint64_t seed)
    : hits(graph.vertex_count()),
      polygon_(polygon),
      graph_(graph),
      friction_angle_(friction_angle),
      spanning_(spanning),
      engine_(seed) {
  std::vector<int> neighbours;
  for (int v = 0; v < graph.vertex_count(); ++v) {
    const GraspSet& set = graph.sets()[v];
    for (const int part : set.parts) {
      Key key{static_cast<int>(set.type), set.edges[0], set.edges[1],
              set.edges.size() > 2 ? set.edges[2] : -1, part};
      if (!vertex_of_.emplace(key, v).second) Fail("a part is in two vertices: " + Text(v));
    }
    graph.GetNeighbours(v, neighbours);
    for (const int w : neighbours) graph_switches_.insert(std::minmax(v, w));
  }
}

void BruteForce::Fail(const std::string& what) {
  if (failures.size() < kMostFailures) failures.push_back(what);
}

std::string BruteForce::Text(int vertex) const {
  const GraspSet& set = graph_.sets()[vertex];
  std::ostringstream out;
  out << "type " << static_cast<int>(set.type) << " edges";
  for (const int e : set.edges) out << ' ' << e;
  out << " parts";
  for (const int p : set.parts) out << ' ' << p;
  return out.str();
}

grasp::Contact BruteForce::At(int edge, double u) const {
  const auto [a, b] = polygon_.edge(FaceIndex(edge));
  return {a + u * (b - a), polygon_.inward_normal(FaceIndex(edge)), FaceIndex(edge)};
}

BruteForce::Drawn BruteForce::Draw(int edge) {
  // Half of the contacts are near an end, because small sets are at corners.
  std::uniform_real_distribution<double> uniform(0, 1);
  double u = uniform(engine_);
  if (uniform(engine_) < 0.5) {
    const double near = std::pow(uniform(engine_), kCrowding);
    u = uniform(engine_) < 0.5 ? near : 1 - near;
  }
  return {edge, u, At(edge, u)};
}

int BruteForce::VertexOf(GraspType type, const std::vector<int>& edges, int part) const {
  const auto found = vertex_of_.find(
      {static_cast<int>(type), edges[0], edges[1], edges.size() > 2 ? edges[2] : -1, part});
  return found == vertex_of_.end() ? -1 : found->second;
}

std::vector<int> BruteForce::Vertices(std::vector<Drawn> drawn) {
  std::sort(drawn.begin(), drawn.end(),
            [](const Drawn& a, const Drawn& b) { return a.edge < b.edge; });
  grasp::Grasp grasp;
  std::vector<int> edges;
  for (const Drawn& d : drawn) {
    grasp.push_back(d.contact);
    edges.push_back(d.edge);
  }
  const auto kinds = grasp.size() == 2
                         ? KindsOfTwo(grasp, friction_angle_)
                         : KindsOfThree(grasp, friction_angle_, spanning_, polygon_.diameter());
  std::vector<int> vertices;
  for (const DirectKind& kind : kinds) {
    if (!kind.certain) {
      ++too_close;
      continue;
    }
    ++grasps;
    if (grasp::TestForceClosure(grasp, polygon_.wrench_frame(), friction_angle_).decision ==
        grasp::Decision::kNo) {
      Fail("not force closure, type " + std::to_string(static_cast<int>(kind.type)));
    }
    const int vertex = VertexOf(kind.type, edges, kind.part);
    if (vertex < 0) {
      std::ostringstream out;
      out.precision(17);
      out << "no vertex has type " << static_cast<int>(kind.type) << " part " << kind.part << " at";
      for (const Drawn& d : drawn) out << ' ' << d.edge << ':' << d.u;
      Fail(out.str());
      continue;
    }
    if (std::count(vertices.begin(), vertices.end(), vertex) > 0) continue;
    vertices.push_back(vertex);
    ++hits[vertex];
    for (const Drawn& d : drawn) {
      auto& range = range_.try_emplace({vertex, d.edge}, d.u, d.u).first->second;
      range = {std::min(range.first, d.u), std::max(range.second, d.u)};
    }
  }
  return vertices;
}

void BruteForce::Expect(int a, int b, const char* why) {
  switches.insert({std::min(a, b), std::max(a, b)});
  if (!Joined(a, b)) Fail(std::string(why) + " but not joined: " + Text(a) + " and " + Text(b));
}

void BruteForce::DrawGrasps(int pairs, int thirds) {
  const int n = polygon_.face_count();
  for (int k = 0; k < n; ++k) {
    for (int l = k + 1; l < n; ++l) {
      for (int s = 0; s < pairs; ++s) {
        const Drawn first = Draw(k);
        const Drawn second = Draw(l);
        Vertices({first, second});
        DrawThirds(first, second, thirds);
      }
    }
  }
}

void BruteForce::SearchMissing(int draws, int thirds) {
  std::vector<int> neighbours;
  for (int v = 0; v < graph_.vertex_count(); ++v) {
    if (hits[v] == 0) DrawFor(v, v, draws, thirds);
    graph_.GetNeighbours(v, neighbours);
    for (const int w : neighbours) {
      if (w > v && !switches.contains({v, w})) DrawFor(v, w, draws, thirds);
    }
  }
}

void BruteForce::DrawFor(int v, int w, int draws, int thirds) {
  const std::vector<FaceIndex>& a = graph_.sets()[v].edges;
  const std::vector<FaceIndex>& b = graph_.sets()[w].edges;
  std::vector<int> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  for (int s = 0; s < draws; ++s) {
    if (common.size() == 2 && a.size() == 3 && b.size() == 3) {
      DrawThirds(Draw(common[0]), Draw(common[1]), thirds);
      continue;
    }
    for (const auto& edges : {a, b}) {
      std::vector<Drawn> drawn;
      for (const int e : edges) drawn.push_back(Draw(e));
      Vertices(drawn);
    }
  }
}

void BruteForce::DrawThirds(const Drawn& first, const Drawn& second, int thirds) {
  std::vector<std::set<int>> by_third;
  for (int c = 0; c < polygon_.face_count(); ++c) {
    if (c == first.edge || c == second.edge) continue;
    std::set<int>& reached = by_third.emplace_back();
    for (int t = 0; t < thirds; ++t) {
      const std::vector<int> vertices = Vertices({first, second, Draw(c)});
      reached.insert(vertices.begin(), vertices.end());
      for (const int v : vertices) {
        for (const int w : vertices) {
          if (graph_.sets()[v].type < graph_.sets()[w].type) Expect(v, w, "one grasp");
        }
      }
    }
  }
  // Two concurrent sets also need a common focus point: see DrawFocusPoints.
  for (std::size_t c = 0; c < by_third.size(); ++c) {
    for (std::size_t d = c + 1; d < by_third.size(); ++d) {
      for (const int v : by_third[c]) {
        for (const int w : by_third[d]) {
          const bool parallel = graph_.sets()[v].type == GraspType::kParallel ||
                                graph_.sets()[w].type == GraspType::kParallel;
          const bool both = graph_.sets()[v].type == graph_.sets()[w].type;
          if (parallel && (both || spanning_ == planning::Spanning::kAdaptive)) {
            Expect(v, w, "two common contacts");
          }
        }
      }
    }
  }
}

bool BruteForce::Sees(const Eigen::Vector2d& x, int edge, double phi, bool& outer, double& low,
                      double& high) const {
  const auto [a, b] = polygon_.edge(FaceIndex(edge));
  const Eigen::Vector2d along = (b - a).head<2>();
  const double length = along.norm();
  const Eigen::Vector2d t = along / length;
  const Eigen::Vector2d r = x - a.head<2>();
  const double height = t.x() * r.y() - t.y() * r.x();
  const double reach = std::abs(height) * std::tan(phi);
  const double margin = kDirectMargin * polygon_.diameter();
  outer = height < 0;
  low = std::max(0.0, t.dot(r) - reach) / length;
  high = std::min(length, t.dot(r) + reach) / length;
  return std::abs(height) > margin && (high - low) * length > margin;
}

void BruteForce::DrawFocusPoints(int points) {
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int v = 0; v < graph_.vertex_count(); ++v) {
    if (graph_.sets()[v].type != GraspType::kConcurrent) continue;
    for (const auto& cell : FocusCell(polygon_, graph_.sets()[v])) {
      for (int k = 0; k < points; ++k) {
        // Random weights of the corners reach every point of a convex polygon.
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        double weights = 0;
        for (const Eigen::Vector2d& corner : cell) {
          const double weight = -std::log(1 - uniform(engine_));
          sum += weight * corner;
          weights += weight;
        }
        CheckFocusPoint(v, sum / weights);
      }
    }
  }
}

void BruteForce::CheckFocusPoint(int vertex, const Eigen::Vector2d& x) {
  const std::vector<FaceIndex>& edges_of_set = graph_.sets()[vertex].edges;
  const std::vector<int> own(edges_of_set.begin(), edges_of_set.end());
  std::vector<int> members;
  const auto add = [&](std::vector<int> edges) {
    std::sort(edges.begin(), edges.end());
    grasp::Grasp normals;
    for (const int e : edges) normals.push_back(At(e, 0.5));
    const double phi = ConcurrentFrictionAngle(normals, friction_angle_, spanning_);
    if (phi < kDirectMargin) return;
    std::vector<Drawn> drawn;
    int part = 0;
    for (int k = 0; k < 3; ++k) {
      bool outer;
      double low;
      double high;
      if (!Sees(x, edges[k], phi, outer, low, high)) return;
      if (outer) part |= 1 << k;
      const double u = std::uniform_real_distribution<double>(low, high)(engine_);
      drawn.push_back({edges[k], u, At(edges[k], u)});
    }
    const int member = VertexOf(GraspType::kConcurrent, edges, part);
    if (member < 0) {
      Fail("a focus point is in no vertex");
      return;
    }
    members.push_back(member);
    if (member != vertex) return;
    const std::vector<int> found = Vertices(drawn);
    if (std::count(found.begin(), found.end(), vertex) == 0) ++too_close;
  };
  add(own);
  if (members.empty()) {
    ++too_close;  // the cell is too thin for doubles
    return;
  }
  if (members.front() != vertex) Fail("a focus point is in another component: " + Text(vertex));
  for (const int leaving : own) {
    for (int c = 0; c < polygon_.face_count(); ++c) {
      if (std::count(own.begin(), own.end(), c) > 0) continue;
      std::vector<int> edges = EdgesWithout(own, leaving);
      edges.push_back(c);
      add(edges);
    }
  }
  for (std::size_t k = 1; k < members.size(); ++k) {
    Expect(vertex, members[k], "a common focus point");
  }
}

void BruteForce::CompareTwoFingerSwitches() {
  for (auto a = range_.begin(); a != range_.end(); ++a) {
    const auto [v, edge] = a->first;
    if (graph_.sets()[v].type != GraspType::kTwoFinger) continue;
    for (int w = 0; w < graph_.vertex_count(); ++w) {
      if (graph_.sets()[w].type == GraspType::kTwoFinger) {
        if (v < w) Expect(v, w, "two 2-finger sets");
        continue;
      }
      const auto b = range_.find({w, edge});
      if (b == range_.end()) continue;
      if (std::max(a->second.first, b->second.first) <
          std::min(a->second.second, b->second.second)) {
        Expect(v, w, "a common contact");
      }
    }
  }
}

}  // namespace regrasp::polygon
