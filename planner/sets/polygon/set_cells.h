#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/base/index.h"
#include "planner/grasp/contact.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/object/polygon.h"
#include "planner/planning/plan_request.h"  // IWYU pragma: export
#include "planner/sets/candidate_search.h"

namespace regrasp::polygon {

/// Inequalities rows · z + offsets > 0 of a convex set.
struct Inequalities {
  Eigen::MatrixXd rows;
  Eigen::VectorXd offsets;

  /// Return the smallest element of rows · z + offsets.
  [[nodiscard]] double SlackAt(const Eigen::VectorXd& z) const {
    return (rows * z + offsets).minCoeff();
  }
};

struct SlackSolution {
  Eigen::VectorXd z;
  double slack = 0;  ///< see SlackAt; not positive if the set has no interior
};

/// Find the point of a convex set that maximizes its slack, by a linear program (GLPK's simplex).
/// @param enough  upper bound on the slack, so that there is always a solution.
/// @throws std::runtime_error  if the solver fails.
[[nodiscard]] SlackSolution MaximizeSlack(const Inequalities& set, double enough = 1);

/// Substitution of variables: some have fixed values, and some pairs are equal. The remaining ones
/// are free.
class Substitution {
 public:
  explicit Substitution(Eigen::Index variables)
      : values_(Eigen::VectorXd::Zero(variables)), fixed_(variables), column_(variables) {}

  void Fix(Eigen::Index variable, double value);
  /// Declare two variables equal.
  /// @param second  index above `first`; not joined with any other variable.
  void Join(Eigen::Index first, Eigen::Index second) { joined_.emplace_back(first, second); }

  /// Number the free variables. Call it before the functions below.
  /// @returns false if two fixed values of equal variables differ.
  [[nodiscard]] bool Finish();

  /// Convert inequalities of all variables to inequalities of the free ones.
  [[nodiscard]] Inequalities Apply(const Inequalities& all) const;
  /// Return the values of all variables for values of the free ones.
  [[nodiscard]] Eigen::VectorXd Expand(const Eigen::VectorXd& free) const;

 private:
  Eigen::VectorXd values_;
  std::vector<bool> fixed_;
  std::vector<Eigen::Index> column_;  ///< number of each free variable
  std::vector<std::pair<Eigen::Index, Eigen::Index>> joined_;
  Eigen::Index free_count_ = 0;
};

/// Types of force-closure grasps of a polygon (Phoka 2010, section 3.2).
enum class GraspType {
  kConcurrent,  ///< three contacts whose cones see one focus point, normals φ-positively spanning
  kTwoFinger,   ///< two contacts, the line through them inside both cones
  kParallel,    ///< three contacts with parallel forces, the middle one opposing the two others
};

/// Vertex of the switching graph: a connected component of the grasps of one type on distinct
/// edges.
///
/// A contact is a + u (b − a), 0 < u < 1, on an edge from a to b with the material on the left. A
/// set is a union of convex parts. A part is given by linear inequalities:
/// - concurrent: bit k of a part is set iff the focus point is on the outer side of the line of
///   edges[k]. A part contains the focus points x and contacts p_k with ±(x − p_k) in the cone of
///   angle φ about the inward normal (+ on the inner side).
/// - two-finger: part 0 is the grasps from outside, p_1 − p_0 in the cone at p_0 and p_0 − p_1 in
///   the cone at p_1. Part 1 is the stretching grasps, with both signs reversed.
/// - parallel: a part is the position in `edges` of the centre contact, whose force opposes the two
///   others (more than one only for θ ≥ 45°). It is itself a union of convex polytopes
///   (planner/sets/polygon/parallel.h), and always connected.
struct GraspSet {
  GraspType type = GraspType::kConcurrent;
  std::vector<FaceIndex> edges;  ///< three in ascending order, or two for a two-finger set
  double tangent = 0;            ///< tan φ of a concurrent set, otherwise tan θ; taken as exact
  std::vector<int> parts;        ///< parts in ascending order
};

/// Return whether the focus points of a part of a concurrent set are on the outer side of the k-th
/// edge.
[[nodiscard]] inline bool IsOuter(int part, int k) { return (part >> k & 1) != 0; }

/// Return the positions of the two other contacts of a parallel grasp, in ascending order.
[[nodiscard]] inline std::array<int, 2> OuterOf(int centre) {
  return {centre == 0 ? 1 : 0, centre == 2 ? 1 : 2};
}

inline constexpr int kGraspTypes = 3;

/// Counts for one grasp type, as in tables 3.1 and 3.2 of Phoka 2010.
struct GraspTypeCounts {
  std::int64_t candidates = 0;    ///< combinations of edges permitted by their normals
  std::int64_t combinations = 0;  ///< combinations of edges with a set that has interior
  std::int64_t vertices = 0;      ///< connected components of these interiors
  std::int64_t components = 0;    ///< components of the graph of this type alone
};

/// Common edges of two sets, by their positions in the first and in the second.
using CommonEdges = boost::container::static_vector<std::pair<int, int>, 3>;
/// Find the common edges of two sets.
/// @param a, b  edges in ascending order.
[[nodiscard]] CommonEdges FindCommonEdges(std::span<const FaceIndex> a,
                                          std::span<const FaceIndex> b);

/// Convex set of grasps, given by linear inequalities.
///
/// Variables: the contact parameters (0 to 1 along the edges), in the order of the set's edges. For
/// a concurrent set, the focus point relative to the centroid, divided by D, follows. A slack is a
/// length divided by D: the distance of the focus point or a contact from the border of a cone, or
/// of a contact from the ends of its edge. Straight lines between points of a cell are sliding
/// steps inside the set.
struct GraspCell {
  int part = 0;  ///< part of the set (GraspSet::parts)
  Inequalities inequalities;
  SlackSolution centre;  ///< point of largest slack
};

/// Grasp set as a union of cells, all with interior.
class SetCells {
 public:
  /// Compute the cells in doubles. Existence was decided exactly when the set was found; cells that
  /// are too thin for doubles are dropped. Polygon and set must outlive this object.
  SetCells(const object::Polygon& polygon, const GraspSet& set);

  [[nodiscard]] const std::vector<GraspCell>& cells() const { return cells_; }

  /// Find the grasp of largest slack at which a sliding step can pass from one cell to another.
  ///
  /// It is in the intersection of the cells, or its focus point is on the edge that separates them.
  /// @returns its contact parameters; nullopt if the cells do not meet.
  [[nodiscard]] std::optional<Eigen::VectorXd> Passage(sets::PieceIndex from,
                                                       sets::PieceIndex to) const;

  /// Largest slack of a grasp in the set.
  [[nodiscard]] double width() const;

  /// Length of the set's k-th edge, divided by D.
  [[nodiscard]] double edge_length(int k) const {
    return polygon_.face_measure(set_.edges[k]) / polygon_.diameter();
  }

 private:
  const object::Polygon& polygon_;
  const GraspSet& set_;
  std::vector<GraspCell> cells_;
};

/// Return the largest slack of the grasps of a parallel set with outer contacts on different sides
/// of the whole common cone.
///
/// It is 0 if there are none. This takes two linear programs per centre instead of eight.
[[nodiscard]] double ClearWidth(const object::Polygon& polygon, const GraspSet& parallel);

/// Largest slack, divided by D, that counts as zero: a few hundred roundings of the inequalities.
inline constexpr double kNoSlack = 1e-12;

/// Return the slack of a grasp in a cell, with the best focus point if the set is concurrent.
/// @param parameters  contact parameters, in the order of the set's edges.
[[nodiscard]] double SlackInCell(const GraspCell& cell, const Eigen::VectorXd& parameters);

/// Return whether the slack of a grasp exceeds `slack` in one of the cells.
[[nodiscard]] bool IsInSet(const SetCells& set, const Eigen::VectorXd& parameters,
                           double slack = kNoSlack);

}  // namespace regrasp::polygon
