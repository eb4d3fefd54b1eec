#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "planner/lp/simplex.h"
#include "planner/sets/polyhedron/face_part.h"

namespace regrasp::polyhedron {

/// Linear function gradient · x + offset.
struct Cut {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double offset = 0;

  [[nodiscard]] double At(const Eigen::Vector3d& x) const { return gradient.dot(x) + offset; }
};

/// Half of the union volume of a convex part of a face (Phoka 2010, definition 5.4).
///
/// It contains the points that see a contact of the part inside its friction cone. They are on the
/// inner side of the face, to which the contact's force points, or on the outer side. With h the
/// height of x over the face's plane on that side and d the distance of its foot from the part, x
/// is inside iff
///
///     g(x) = cos φ · d(x) − sin φ · h(x) < 0.
///
/// g is convex with slopes of at most 1. If g(x) is negative, −g(x) is the distance of x from the
/// border of the cone about the part's point nearest to its foot.
class UnionVolume {
 public:
  /// @param part     must outlive this object. For a single point, the two halves are its
  ///     double-sided cone.
  /// @param tangent  tan φ of the cones.
  UnionVolume(const FacePart& part, bool inner, double tangent)
      : part_(&part),
        cos_(1 / std::sqrt(1 + tangent * tangent)),
        sin_((inner ? 1 : -1) * tangent * cos_) {}

  /// Return the linear function that equals g at x and is at most g everywhere.
  [[nodiscard]] Cut CutAt(const Eigen::Vector3d& x) const;

  /// Return g(x).
  [[nodiscard]] double At(const Eigen::Vector3d& x) const { return CutAt(x).At(x); }

 private:
  const FacePart* part_;
  double cos_;
  double sin_;  ///< negative on the outer side
};

/// Return the cut at x that is largest there among those of some volumes; the first of equal ones.
[[nodiscard]] inline Cut LargestCutAt(std::span<const UnionVolume> volumes,
                                      const Eigen::Vector3d& x) {
  Cut largest = volumes.front().CutAt(x);
  double value = largest.At(x);
  for (const UnionVolume& volume : volumes.subspan(1)) {
    const Cut cut = volume.CutAt(x);
    const double at = cut.At(x);
    if (at <= value) continue;
    value = at;
    largest = cut;
  }
  return largest;
}

/// Result of whether convex sets { x : g_i(x) < 0 } have common points.
enum class Overlap {
  kNone,     ///< certain: max g_i is positive everywhere
  kSome,     ///< certain: `point` is inside all of them
  kUnclear,  ///< doubles cannot decide: the sets touch, or nearly do
};

struct MinMaxResult {
  Overlap overlap = Overlap::kUnclear;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double value = 0;  ///< max g_i(point)
};

/// Minimizes the maximum of some convex functions over space by cutting planes (Kelley 1960).
///
/// The solver is a simplex method (lp::Simplex). A basis consists of four cuts whose gradients have
/// the origin in their hull. Its value t is a lower bound, and the method maximizes it:
///
///     t = Σ λ_k offset_k  with  Σ λ_k gradient_k = 0, Σ λ_k = 1, λ ≥ 0.
///
/// The dual solution is the point at which the four cuts are equal, with −t. The cut of the largest
/// function at this point enters the basis next. Its reduced cost is its height above t.
class MinMax {
 public:
  /// @param centre  centre of the search.
  /// @param reach  radius of the search about `centre`; roundings are relative to it.
  MinMax(const Eigen::Vector3d& centre, double reach);

  /// Stopping criterion.
  enum class Until {
    kSign,     ///< overlap is decided
    kMinimum,  ///< the minimum is also found, to a hundredth of its value
  };

  /// Function that returns the cut of the largest function at a point.
  using LargestCut = std::function<Cut(const Eigen::Vector3d& point)>;

  /// Find the minimum, starting from the current basis.
  ///
  /// The first basis is valid for every set of functions. The basis of the last call is valid as
  /// long as no function is removed.
  [[nodiscard]] MinMaxResult Solve(std::span<const UnionVolume> volumes, Until until);
  [[nodiscard]] MinMaxResult Solve(const LargestCut& largest_cut, Until until);

  /// Bound on roundings; values closer to zero decide nothing.
  [[nodiscard]] double rounding() const { return rounding_; }

  /// Return to the first basis.
  void Restart() { program_ = first_; }

  /// Four cuts from which a later call of Resume can continue.
  using Basis = std::array<Cut, 4>;
  [[nodiscard]] Basis basis() const;
  void Resume(const Basis& basis);

 private:
  static constexpr int kRows = 4;

  struct Column {
    Cut cut;  ///< cut relative to the centre

    template <class Visit>
    void ForEachEntry(const Visit& visit) const {
      for (int axis = 0; axis < 3; ++axis) visit(axis, cut.gradient[axis]);
      visit(3, 1);
    }
    [[nodiscard]] double cost() const { return -cut.offset; }
  };
  using Program = lp::Simplex<kRows, Column>;

  template <class Oracle>
  [[nodiscard]] MinMaxResult SolveWith(const Oracle& largest_cut, Until until);
  [[nodiscard]] bool IsSeparated() const;

  Eigen::Vector3d centre_;
  double reach_;
  double rounding_;
  Program program_;
  Program first_;  ///< program with the first basis
};

}  // namespace regrasp::polyhedron
