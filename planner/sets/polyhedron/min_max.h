#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>

#include "planner/lp/simplex.h"
#include "planner/sets/polyhedron/union_volume.h"

namespace regrasp::polyhedron {

/// Whether some convex sets, each { x : g_i(x) < 0 }, have common points.
enum class Overlap {
  kNone,     ///< certain: max g_i is positive everywhere
  kSome,     ///< certain: `point` is inside all of them
  kUnclear,  ///< doubles cannot tell: the sets touch, or nearly do
};

struct MinMaxResult {
  Overlap overlap = Overlap::kUnclear;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double value = 0;  ///< max g_i(point)
};

/// Minimises the largest of some convex functions over space by cutting planes (Kelley 1960), as
/// the simplex method sees them (lp::Simplex): the lower bound is the value t of a basis of four
/// cuts whose gradients have the origin in their hull,
///
///     t = Σ λ_k offset_k  with  Σ λ_k gradient_k = 0, Σ λ_k = 1, λ ≥ 0,
///
/// the largest there is; the dual solution is the point where the four are equal, with −t, and the
/// cut of the function that is largest there enters next: its reduced cost is how far it is above
/// t.
class MinMax {
 public:
  /// @param centre, reach  the minimum is looked for within `reach` of `centre`, and not farther;
  ///                       roundings are measured by it.
  MinMax(const Eigen::Vector3d& centre, double reach);

  /// When to stop.
  enum class Until {
    kSign,     ///< overlap is decided
    kMinimum,  ///< and the minimum is found, to a hundredth of its value
  };

  /// Gives the cut that is largest at a point, of the functions whose largest is minimised.
  using LargestCut = std::function<Cut(const Eigen::Vector3d& point)>;

  /// Looks for the minimum from the current basis on: at first one that every set of functions has,
  /// later that of the last call, which is valid as long as no function is taken away.
  [[nodiscard]] MinMaxResult Solve(std::span<const UnionVolume> volumes, Until until);
  [[nodiscard]] MinMaxResult Solve(const LargestCut& largest_cut, Until until);

  /// Values this close to zero decide nothing.
  [[nodiscard]] double rounding() const { return rounding_; }

  /// Back to the first basis.
  void Restart() { program_ = first_; }

  /// To go on later from the basis at hand.
  using Basis = std::array<Cut, 4>;
  [[nodiscard]] Basis basis() const;
  void Resume(const Basis& basis);

 private:
  static constexpr int kRows = 4;

  struct Column {
    Cut cut;  ///< about the centre

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
  Program first_;  ///< with the first basis
};

}  // namespace regrasp::polyhedron
