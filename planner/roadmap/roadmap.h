#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"
#include "planner/search/switching_graph.h"

namespace regrasp::roadmap {

/// Return the binomial coefficient of n over K; 0 if n < K. K is a template parameter, so that
/// divisions are by constants.
template <int K>
[[nodiscard]] constexpr std::int64_t Binomial(int n) {
  if constexpr (K == 0) {
    return 1;
  } else {
    return Binomial<K - 1>(n) * (n - K + 1) / K;
  }
}

/// Return the rank of an ascending triple in colexicographic order.
/// The rank is Σ (c_i over i + 1), the combinatorial number system (Knuth, TAOCP 4A, 7.2.1.3).
///
/// Law: a bijection between the triples of {0, …, n − 1} and {0, …, (n over 3) − 1}.
[[nodiscard]] constexpr std::int64_t CombinationRank(const std::array<int, 3>& ascending) {
  return Binomial<1>(ascending[0]) + Binomial<2>(ascending[1]) + Binomial<3>(ascending[2]);
}

/// Indices of four contact points in ascending order.
using Quadruple = std::array<int, 4>;

/// Roadmap without clusters (Kavraki et al. 1996; for grasps Phoka 2010, chapter 6).
/// Every force-closure grasp of four contact points is a vertex. Two grasps that share three
/// contacts are connected, because the fifth finger can make the new contact before the old one is
/// released.
///
/// Edges are not stored. Grasps are listed by the triples of contacts that they contain, and two
/// different grasps share at most one triple. Contacts at the same point, such as two normals on an
/// edge of the solid, are neither in one grasp nor exchanged in one switch, because two fingers
/// cannot touch one point. The same applies to contacts at which fingers of positive radius would
/// overlap.
class Roadmap final : public search::SwitchingGraph {
 public:
  /// Test all subsets of four points.
  /// @param friction_angle  friction angle, radians.
  /// @param same_point  distance within which contacts are at the same point.
  /// @param finger_radius  radius of the fingers; 0: points (reach.h).
  /// @throws std::invalid_argument  as TestForceClosure.
  /// @throws TimeUp  if the deadline passes.
  Roadmap(std::vector<grasp::Contact> points, const object::WrenchFrame& frame,
          double friction_angle, double same_point, double finger_radius = 0,
          const Deadline& deadline = {}, const Tell& tell = {});

  [[nodiscard]] const std::vector<grasp::Contact>& points() const { return points_; }
  [[nodiscard]] const Quadruple& vertex(int index) const { return vertices_[index]; }
  [[nodiscard]] grasp::Grasp grasp(int index) const;
  /// Return the vertex of four contact points in any order; nullopt if they are not a vertex.
  [[nodiscard]] std::optional<int> Find(std::span<const int> points) const;

  [[nodiscard]] int vertex_count() const override { return static_cast<int>(vertices_.size()); }
  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override;
  /// Return the number of contacts in which two grasps differ, because a switch changes one.
  [[nodiscard]] int MinSwitches(int from, int to) const override;

  /// Return the number of subsets of four contact points, force closure or not.
  [[nodiscard]] std::int64_t candidate_count() const;
  /// Return the number of edges: unordered pairs of vertices connected by a switch.
  /// @throws TimeUp  if the deadline passes.
  [[nodiscard]] std::int64_t CountEdges(const Deadline& deadline = {}) const;
  /// Find the connected components.
  /// @throws TimeUp  if the deadline passes.
  [[nodiscard]] search::Components FindComponents(const Deadline& deadline = {}) const;

 private:
  void ListByTriples();
  [[nodiscard]] int triple_count() const;
  [[nodiscard]] std::span<const int> VerticesWith(int triple) const;
  /// Return whether the switch between two grasps with a common triple is impossible.
  /// It is if the exchanged contacts exclude each other.
  [[nodiscard]] bool IsExcluded(int vertex, int other) const;
  [[nodiscard]] bool ExcludeEachOther(int a, int b) const {
    return excluded_[a * points_.size() + b];
  }
  [[nodiscard]] std::int64_t EdgesWith(int triple) const;

  std::vector<grasp::Contact> points_;
  std::vector<Quadruple> vertices_;  ///< vertices in lexicographic order
  /// Vertices that contain a triple: triple_begin_[triple] … triple_begin_[triple + 1].
  std::vector<int> triple_begin_;
  std::vector<int> triple_vertices_;
  std::vector<bool> excluded_;  ///< whether two fingers cannot be at both, by pair of points
  bool any_excluded_ = false;   ///< rarely true for point fingers
};

}  // namespace regrasp::roadmap
