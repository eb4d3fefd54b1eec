#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>

#include "planner/lp/simplex.h"
#include "planner/sets/polyhedron/union_volume.h"

namespace regrasp::polyhedron {

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
