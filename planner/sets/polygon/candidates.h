#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/object/polygon.h"
#include "planner/sets/polygon/plane.h"
#include "planner/sets/polygon/set_cells.h"

namespace regrasp::polygon {

/// Edges of a polygon in the form that exact predicates require. Construct it in an IntervalScope.
class EdgeTable {
 public:
  /// @param tangent  tan θ, with θ the friction angle.
  EdgeTable(const object::Polygon& polygon, double tangent);

  /// Return the table of some of the edges, as if the polygon had no others.
  /// @param edges  edges in ascending order; they are renumbered from 0.
  [[nodiscard]] EdgeTable Of(const std::vector<FaceIndex>& edges) const;

  [[nodiscard]] int size() const { return static_cast<int>(ends_.size()); }
  [[nodiscard]] double tangent() const { return tangent_; }
  [[nodiscard]] const EdgeEnds& ends(FaceIndex edge) const { return ends_[edge]; }
  /// Vertices at the start and the end of an edge, numbered through all rings.
  [[nodiscard]] const std::array<int, 2>& vertices(FaceIndex edge) const { return vertices_[edge]; }

  /// Return an edge with cones of angle θ, or of another angle.
  template <class NT>
  [[nodiscard]] EdgeFrame<NT> frame(FaceIndex edge, double tangent) const {
    if constexpr (std::is_same_v<NT, Interval>) {
      if (tangent == tangent_) return frames_[edge];
    }
    return MakeEdgeFrame<NT>(ends_[edge], tangent);
  }
  template <class NT>
  [[nodiscard]] EdgeFrame<NT> frame(FaceIndex edge) const {
    return frame<NT>(edge, tangent_);
  }

 private:
  explicit EdgeTable(double tangent) : tangent_(tangent) {}

  double tangent_;
  std::vector<EdgeEnds> ends_;
  std::vector<std::array<int, 2>> vertices_;
  std::vector<EdgeFrame<Interval>> frames_;  ///< frames with cones of angle θ
};

/// Three edges in ascending order.
using EdgeTriple = std::array<FaceIndex, 3>;

/// Three edges whose normals permit concurrent grasps.
struct ConcurrentCandidate {
  EdgeTriple edges;
  double tangent;  ///< tan φ
};

/// Two edges in ascending order.
using TwoFingerCandidate = std::array<FaceIndex, 2>;

/// Three edges, and the positions among them of possible centres, in ascending order.
struct ParallelCandidate {
  EdgeTriple edges;
  std::vector<int> centres;
};

/// Find the triples of edges whose inward normals span the plane, in lexicographic order.
///
/// With `uniform`, the normals must θ-positively span it: gaps between adjacent normals are below π
/// − 2θ. With `adaptive`, they must positively span it: gaps are below π. Then tan φ = min(tan θ,
/// tan φ*), rounded down, with φ* = (π − largest gap) / 2.
///
/// For the first two normals, the third ones are consecutive in the order of angles (Phoka 2010,
/// section 3.3.4.1). The time is therefore proportional to the number of results. The decision is
/// exact. Call this and the functions below in an IntervalScope.
/// @throws TimeUp  if the deadline is reached; the same for the functions below.
[[nodiscard]] std::vector<ConcurrentCandidate> FindConcurrentCandidates(
    const EdgeTable& edges, planning::Spanning spanning, const Deadline& deadline = {});

/// Find the pairs of edges whose normals are within 2θ of opposite.
///
/// Equivalently, the cones C(n_a) and −C(n_b) have a common interior.
[[nodiscard]] std::vector<TwoFingerCandidate> FindTwoFingerCandidates(
    const EdgeTable& edges, const Deadline& deadline = {});

/// Number of 2-finger candidates, and a uniform random sample of them. Drawn in O(n log n).
struct CandidateSample {
  std::int64_t total = 0;
  std::vector<TwoFingerCandidate> drawn;
};
[[nodiscard]] CandidateSample DrawTwoFingerCandidates(const EdgeTable& edges, int count,
                                                      RandomStream& random);

/// Find the triples and centres with a common cone.
///
/// −C(n_centre) and the cones of the two other normals must have a common interior. Two normals can
/// therefore differ by 2θ, not only by θ.
[[nodiscard]] std::vector<ParallelCandidate> FindParallelCandidates(const EdgeTable& edges,
                                                                    const Deadline& deadline = {});

}  // namespace regrasp::polygon
