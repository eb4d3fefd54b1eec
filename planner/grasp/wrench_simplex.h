#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <limits>
#include <optional>
#include <span>

#include "planner/grasp/unit_contacts.h"
#include "planner/lp/simplex.h"

namespace regrasp::grasp {

/// Simplex method (lp::Simplex) over the wrenches of friction cones.
/// The pricing step uses the circular cone. One linear program with infinitely many columns decides
/// force closure, quality and grasp forces.
///
/// The columns are the wrenches w(g) = (g, q × g) of the rim forces g = axial n + tangential t of
/// every contact, t ⟂ n any unit vector (the two cone edges in the plane). With weights λ ≥ 0, Σ λ
/// = 1, the program requires Σ λ_j w_j = target. It first decides whether there is a solution, then
/// finds the solution that maximizes the weight of one further column. The best column for a twist
/// y = (v, ω) has a closed form: contact q moves with u = v + ω × q, and
///
///     max over t of y · w = axial n·u + tangential |u − (n·u) n|        (the cone's support).
///
/// Soft fingers differ only in the support, because their rim has torques about n too
/// (planner/grasp/cone_support.h). The remainder of the method does not depend on the kind of
/// contact.
///
/// Column generation: Dantzig and Wolfe 1960. Extreme wrenches suffice: Zheng and Chew 2009. The
/// program starts from a point inside the hull with uneven weights, so that symmetric grasps cause
/// no degenerate pivots. A limit on pivots stops programs that stall anyway.
///
/// @tparam kDim  6 in space, 3 in the plane (force x, y and torque z).
template <int kDim>
class WrenchSimplex {
 public:
  using Vector = std::array<double, kDim>;

  enum class Status {
    kFeasible,    ///< weights found
    kInfeasible,  ///< certain: `twist` separates the target from all columns
    kStalled,     ///< neither is certain
  };

  /// @param contacts  contacts with rims set; must outlive this object.
  WrenchSimplex(std::span<const UnitContact> contacts, const Vector& target);

  /// Search for weights: minimize the L1 distance from the target to the hull of the columns.
  /// @param stop_early  whether to stop at the first twist that separates instead of the nearest
  ///     point.
  Status FindWeights(bool stop_early);

  /// Search for weights again after the rims of contacts have changed.
  /// The search starts from the columns of the last search, transformed to the new rims. It uses
  /// the dual simplex method. A column with a negative weight, the one with the farthest facet
  /// first, is replaced by the column that reaches farthest over this facet. For rims that are
  /// nearly the same this takes one or two pivots.
  /// @param twist  output after kInfeasible: the twist that separates.
  /// @returns kStalled also if there is no full basis to begin from: FindWeights ended without
  ///     weights, or Maximise was called after it.
  Status Resume(Vector& twist);

  /// Find the weights whose sum is nearest to the target, if no weights reach it.
  /// Minimizes the sum of the absolute values of the unbalanced wrench, to a millionth of it.
  /// FindWeights does not find this point, because an entry of the wrench that it has balanced
  /// stays balanced.
  void FindNearest();

  struct Maximum {
    double lower;  ///< attained value
    double upper;  ///< certified bound; infinite if there is none
  };

  /// Stopping conditions of Maximise.
  struct Goal {
    double gap = 0;                                           ///< stop if upper − lower ≤ gap
    double enough = std::numeric_limits<double>::infinity();  ///< stop if lower > enough
  };

  /// Maximize the weight of a wrench.
  /// @pre FindWeights found weights.
  /// @param share  part of `column` in the sum Σ λ = 1.
  Maximum Maximise(const Vector& column, double share, const Goal& goal);

  /// Point Σ a_i axial w(n_i) inside the hull; the a_i are the uneven StartWeights.
  [[nodiscard]] Vector start() const { return start_; }

  /// Return a weight of start(); the weights sum to 1.
  [[nodiscard]] double StartWeight(int contact) const;

  /// Return the radius about the target of a ball inside the simplex of the basic columns.
  /// ≤ 0 if there is none, or if the basis contains an artificial column.
  [[nodiscard]] double BallRadius() const;

  /// Return the largest s for which target + s · direction is in the simplex of the basic columns.
  [[nodiscard]] double Reach(const Vector& direction) const;

  /// Return the force of contact i in the solution, without that of Maximise's column.
  [[nodiscard]] Eigen::Vector3d ForceOf(int contact) const;

  /// Return the torque about the normal of contact i; 0 for a hard-finger contact.
  [[nodiscard]] double TorqueOf(int contact) const;

  /// Return the dual solution: the twist for which the last column was chosen.
  /// After kInfeasible it separates: twist · w < twist · target for all columns.
  [[nodiscard]] Vector twist() const;

  /// Σ |target − Σ λ w|.
  [[nodiscard]] double unbalanced() const;

  /// Return the largest y · w over all columns for a twist y.
  [[nodiscard]] static double Support(std::span<const UnitContact> contacts, const Vector& twist);

 private:
  static constexpr int kRows = kDim + 1;  // balance, and Σ λ = 1

  struct Column {
    int contact;  ///< contact number; negative for other kinds of columns
    std::array<double, kRows> entries;

    template <class Visit>
    void ForEachEntry(const Visit& visit) const {
      for (int r = 0; r < kRows; ++r) visit(r, entries[r]);
    }
    [[nodiscard]] double cost() const {
      return contact == kMaximised ? -1 : contact == kUnbalanced ? 1 : 0;
    }
  };
  static constexpr int kStart = -1;
  static constexpr int kMaximised = -2;
  static constexpr int kUnbalanced = -3;  ///< ± a unit of one entry of the wrench

  using Program = lp::Simplex<kRows, Column>;
  using Dual = typename Program::Vector;

  struct Rim {
    double axial;
    double tangential;
  };
  using Rims = boost::container::small_vector<Rim, kInlineContacts>;

  /// Set everything except the columns that depends on the rims: the start and the size of columns.
  void SetRims();
  /// Return a column for the current rims; nullopt if there is none.
  /// @param before  rims for which the column was made.
  [[nodiscard]] std::optional<Column> Turned(const Column& column, const Rims& before) const;
  /// Return the row of the farthest facet; −1 if no weight is negative.
  /// The distance of the target from the facet of the other columns is the negative weight over the
  /// rate at which it grows.
  [[nodiscard]] int FarthestFacet() const;
  /// Find the best column for a dual solution.
  /// @returns its reduced cost.
  double FindBest(const Dual& dual, Column& column) const;
  [[nodiscard]] static Column Unbalanced(int row, double sign);
  [[nodiscard]] bool Separates(const Dual& dual, double reduced_cost) const;

  std::span<const UnitContact> contacts_;
  Rims rims_;  ///< rims for which the columns were made
  Vector target_;
  Vector start_{};
  double start_weight_sum_ = 0;
  double target_size_ = 0;
  double column_size_ = 0;
  Program program_;
};

extern template class WrenchSimplex<3>;
extern template class WrenchSimplex<6>;

}  // namespace regrasp::grasp
