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

/// Compares random grasps of a polygon with its graph.
class BruteForce {
 public:
  BruteForce(const object::Polygon& polygon, const PolygonGraph& graph, double friction_angle,
             planning::Spanning spanning, std::uint64_t seed);

  /// Draw pairs of contacts on every two edges, and a third contact on every other edge.
  ///
  /// Each grasp must be in exactly one vertex per kind (KindsOfTwo, KindsOfThree) and be force
  /// closure. Vertices that share two contacts must be connected if one of them is parallel.
  void DrawGrasps(int pairs, int thirds);

  /// Draw focus points of every concurrent vertex.
  ///
  /// Contacts that they see must form a grasp of the vertex. All vertices of these contacts must be
  /// connected if they have two common edges.
  void DrawFocusPoints(int points);

  /// Draw more grasps for vertices without a grasp and for switches that were not found.
  void SearchMissing(int draws, int thirds);

  /// Check that 2-finger vertices are connected with others if their drawn contacts overlap on an
  /// edge. Call it last.
  void CompareTwoFingerSwitches();

  int grasps = 0;                         ///< number of certainly classified grasps
  int too_close = 0;                      ///< number of uncertain grasps, which are ignored
  std::vector<int> hits;                  ///< number of grasps in each vertex
  std::set<std::array<int, 2>> switches;  ///< found switches of all types
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
  /// Return the vertices of contacts, sorted by edge, and check each of them.
  std::vector<int> Vertices(std::vector<Drawn> drawn);
  int VertexOf(GraspType type, const std::vector<int>& edges, int part) const;
  bool Joined(int a, int b) const { return graph_switches_.contains(std::minmax(a, b)); }
  void Expect(int a, int b, const char* why);
  void Fail(const std::string& what);
  std::string Text(int vertex) const;
  void DrawFor(int v, int w, int draws, int thirds);
  void DrawThirds(const Drawn& first, const Drawn& second, int thirds);
  void CheckFocusPoint(int vertex, const Eigen::Vector2d& x);
  /// Compute the range of contacts on an edge that x sees at an angle. @returns whether there is
  /// any.
  bool Sees(const Eigen::Vector2d& x, int edge, double phi, bool& outer, double& low,
            double& high) const;

  const object::Polygon& polygon_;
  const PolygonGraph& graph_;
  double friction_angle_;
  planning::Spanning spanning_;
  std::mt19937_64 engine_;
  std::map<Key, int> vertex_of_;
  std::set<std::pair<int, int>> graph_switches_;
  std::map<std::pair<int, int>, std::pair<double, double>> range_;  ///< ranges by vertex and edge
};

}  // namespace regrasp::polygon
