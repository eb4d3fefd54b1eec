#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <limits>
#include <optional>
#include <span>

#include "planner/grasp/unit_contacts.h"
#include "planner/lp/simplex.h"

namespace regrasp::grasp {

/// The simplex method (lp::Simplex) over the wrenches of friction cones, with the true circular
/// cone as its pricing step: one linear program with infinitely many columns decides force closure,
/// quality and grasp forces.
///
/// The columns are the wrenches w(g) = (g, q × g) of the rim forces g = axial n + tangential t of
/// every contact, t ⟂ n any unit vector (the two cone edges in the plane). With weights λ ≥ 0,
/// Σ λ = 1, the program asks for Σ λ_j w_j = target: first whether there is a solution, then for
/// the solution that maximises the weight of one further column. The best column for a twist
/// y = (v, ω) is closed form: contact q moves with u = v + ω × q, and
///
///     max over t of y · w = axial n·u + tangential |u − (n·u) n|        (the cone's support).
///
/// So it is for soft fingers, whose rim has torques about n too (planner/grasp/cone_support.h): the
/// rest of the method knows nothing of the kind of contact.
///
/// Column generation: Dantzig and Wolfe 1960; that extreme wrenches are all a method needs: Zheng
/// and Chew 2009. The program starts from a point inside the hull with uneven weights, so that
/// symmetric grasps cause no degenerate pivots; a limit on pivots ends what would still stall.
///
/// @tparam kDim  6 in space, 3 in the plane (force x, y and torque z).
template <int kDim>
class WrenchSimplex {
 public:
  using Vector = std::array<double, kDim>;

  enum class Status {
    kFeasible,    ///< weights found
    kInfeasible,  ///< certain: `twist` separates the target from all columns
    kStalled,     ///< neither could be made certain
  };

  /// @param contacts  must stay alive; their rims are set.
  WrenchSimplex(std::span<const UnitContact> contacts, const Vector& target);

  /// Looks for weights: minimises the L1 distance from the target to the hull of the columns.
  /// @param stop_early  end with the first twist that separates, not with the nearest point.
  Status FindWeights(bool stop_early);

  /// Looks for weights again after the rims of contacts have been changed, from the columns that
  /// the last search ended with, turned to where their rims are now: by the dual simplex method,
  /// which replaces a column whose weight is negative, that with the farthest facet first, by the
  /// one that reaches farthest over this facet. For rims that are nearly the same it takes a pivot
  /// or two.
  /// @param twist  set after kInfeasible: it separates.
  /// @returns kStalled also where there is no full basis to begin from: FindWeights ended without
  ///          weights, or Maximise came after it.
  Status Resume(Vector& twist);

  /// Where no weights are: those whose sum is nearest to the target, by the sum of the absolute
  /// values of what is unbalanced, to a millionth of it. FindWeights does not find them: an entry
  /// of the wrench that it has balanced stays so.
  void FindNearest();

  struct Maximum {
    double lower;  ///< reached
    double upper;  ///< cannot be exceeded; infinite where there is no bound
  };

  /// Where Maximise may end.
  struct Goal {
    double gap = 0;                                           ///< upper − lower ≤ gap
    double enough = std::numeric_limits<double>::infinity();  ///< lower > enough
  };

  /// Once weights are found: maximises the weight of `column`, a wrench, whose part of the sum
  /// Σ λ = 1 is `share`.
  Maximum Maximise(const Vector& column, double share, const Goal& goal);

  /// Σ a_i axial w(n_i), a point inside the hull; a_i are the uneven StartWeights.
  [[nodiscard]] Vector start() const { return start_; }

  /// The weights of start(), which sum to 1.
  [[nodiscard]] double StartWeight(int contact) const;

  /// Radius about the target of a ball inside the simplex of the basic columns; ≤ 0 where none, or
  /// where an artificial column is left in it.
  [[nodiscard]] double BallRadius() const;

  /// Largest s such that target + s · direction lies in the simplex of the basic columns.
  [[nodiscard]] double Reach(const Vector& direction) const;

  /// The force of contact i in the solution, without that of Maximise's column.
  [[nodiscard]] Eigen::Vector3d ForceOf(int contact) const;

  /// Its torque about the normal of contact i; 0 of a hard point.
  [[nodiscard]] double TorqueOf(int contact) const;

  /// The dual solution: the twist that the last column was chosen for. After kInfeasible it
  /// separates: twist · w < twist · target for all columns.
  [[nodiscard]] Vector twist() const;

  /// Σ |target − Σ λ w|.
  [[nodiscard]] double unbalanced() const;

  /// The largest y · w of all columns, y a twist.
  [[nodiscard]] static double Support(std::span<const UnitContact> contacts, const Vector& twist);

 private:
  static constexpr int kRows = kDim + 1;  // balance, and Σ λ = 1

  struct Column {
    int contact;  ///< or what else it is, negative
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

  /// What goes by the rims, but for the columns: the start, and how large columns are.
  void SetRims();
  /// A column that was made for other rims, where they are now; nullopt of one that has none.
  [[nodiscard]] std::optional<Column> Turned(const Column& column, const Rims& before) const;
  /// The row whose weight is the most negative one over the rate at which it grows, the distance of
  /// the target from the facet of the other columns; −1 where none is negative.
  [[nodiscard]] int FarthestFacet() const;
  /// @returns its reduced cost.
  double FindBest(const Dual& dual, Column& column) const;
  [[nodiscard]] static Column Unbalanced(int row, double sign);
  [[nodiscard]] bool Separates(const Dual& dual, double reduced_cost) const;

  std::span<const UnitContact> contacts_;
  Rims rims_;  ///< that the columns were made for
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
