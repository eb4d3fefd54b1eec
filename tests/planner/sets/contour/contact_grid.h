#pragma once

#include <string>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/sets/contour/contour_graph.h"

namespace regrasp::contour {

enum class Sense { kNone, kSqueezing, kStretching, kTooClose };

/// Classify two contacts of a polygon by the general force-closure test and the direction between
/// them.
[[nodiscard]] Sense SenseOf(const object::Polygon& polygon, double friction_angle,
                            const grasp::Contact& a, const grasp::Contact& b);

/// All pairs of sampled contacts of a polygon, classified one by one, with their connected
/// components. The components approximate a graph's sets.
///
/// The lines of the grid are contacts on all rings: `lines` in total, with a minimum per edge, each
/// drawn in its part of the edge. Two pairs are connected in two cases. They are on the same edges
/// in the same sense, because the differences p_b − p_a of grasps from outside form a convex cone.
/// Or one contact moves to the next line across a vertex of the polygon, and the pair at the vertex
/// is a grasp in the same sense with either normal. A component is therefore part of one set. A
/// thin set can have several components or none.
class ContactGrid {
 public:
  ContactGrid(const object::Polygon& polygon, double friction_angle, int lines, std::uint64_t seed);

  [[nodiscard]] int line_count() const { return static_cast<int>(lines_.size()); }
  [[nodiscard]] const grasp::Contact& line(int i) const { return lines_[i]; }
  [[nodiscard]] Sense sense(int i, int j) const { return sense_[i * line_count() + j]; }
  /// Component of a pair; −1 if it is not a grasp.
  [[nodiscard]] int component(int i, int j) const { return component_[i * line_count() + j]; }
  [[nodiscard]] int component_count() const { return component_count_; }

 private:
  void JoinCells();

  const object::Polygon& polygon_;
  double friction_angle_;
  std::vector<grasp::Contact> lines_;
  std::vector<int> next_;  ///< next line on the ring
  std::vector<Sense> sense_;
  std::vector<int> component_;
  int component_count_ = 0;
};

/// Result of the comparison of a grid with a graph.
struct GridComparison {
  std::int64_t pairs = 0;   ///< number of classified pairs
  std::int64_t grasps = 0;  ///< number of force-closure pairs
  int too_close = 0;
  int sets = 0;         ///< sets with at least one component
  int split_sets = 0;   ///< sets with several components
  int missed_sets = 0;  ///< sets without a component
  int switches = 0;     ///< found switches: two sets share a line
  int missed_switches = 0;
  std::vector<std::string> failures;
};

/// Compare a grid with a graph.
///
/// Every grasp of the grid must be in exactly one piece, which has its sense, and every other pair
/// in none. A component must be in one set. Sets that share a line must be connected.
[[nodiscard]] GridComparison CompareWithGrid(const object::Polygon& polygon,
                                             const ContourGraph& graph, const ContactGrid& grid);

}  // namespace regrasp::contour
