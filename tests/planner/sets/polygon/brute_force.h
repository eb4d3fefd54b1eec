#pragma once

#include <array>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "tests/planner/sets/polygon/direct_conditions.h"

namespace regrasp::polygon {

/// Random grasps of a polygon held against its graph.
class BruteForce {
 public:
  BruteForce(const object::Polygon& polygon, const PolygonGraph& graph, double half_angle,
             planning::Spanning spanning, std::uint64_t seed);

  /// Draws contacts on every two edges, and third contacts on every other edge to each: what they
  /// are by KindsOfTwo and KindsOfThree must be in exactly one vertex each, force closure, and
  /// joined by the switches that share two contacts.
  void DrawGrasps(int pairs, int thirds);

  /// Draws focus points of every concurrent vertex: contacts that they see must be a grasp of the
  /// vertex, and all vertices that they belong to be joined where two edges are common.
  void DrawFocusPoints(int points);

  /// Draws more where a vertex was not hit or a switch not found.
  void SearchMissing(int draws, int thirds);

  /// After the others: 2-finger vertices and others whose drawn contacts overlap on an edge must be
  /// joined.
  void CompareTwoFingerSwitches();

  int grasps = 0;                         ///< classified, certain
  int too_close = 0;                      ///< left out
  std::vector<int> hits;                  ///< grasps of each vertex
  std::set<std::array<int, 2>> switches;  ///< found, of any type
  std::vector<std::string> failures;

 private:
  using Key = std::array<int, 5>;  ///< type, edges (−1 for none), part

  struct Drawn {
    int edge;
    double u;
    grasp::Contact contact;
  };

  Drawn Draw(int edge);
  grasp::Contact At(int edge, double u) const;
  /// The vertices that contacts (by ascending edge) belong to; checks each of them.
  std::vector<int> Vertices(std::vector<Drawn> drawn);
  int VertexOf(GraspType type, const std::vector<int>& edges, int part) const;
  bool Joined(int a, int b) const { return graph_switches_.contains(std::minmax(a, b)); }
  void Expect(int a, int b, const char* why);
  void Fail(const std::string& what);
  std::string Text(int vertex) const;
  void DrawFor(int v, int w, int draws, int thirds);
  void DrawThirds(const Drawn& first, const Drawn& second, int thirds);
  void CheckFocusPoint(int vertex, const Eigen::Vector2d& x);
  /// The range of contacts on the edge that x sees at a half-angle; empty where it sees none.
  bool Sees(const Eigen::Vector2d& x, int edge, double phi, bool& outer, double& low,
            double& high) const;

  const object::Polygon& polygon_;
  const PolygonGraph& graph_;
  double half_angle_;
  planning::Spanning spanning_;
  std::mt19937_64 engine_;
  std::map<Key, int> vertex_of_;
  std::set<std::pair<int, int>> graph_switches_;
  std::map<std::pair<int, int>, std::pair<double, double>> range_;  ///< by vertex and edge
};

}  // namespace regrasp::polygon
