#pragma once

#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// Decides force closure of one grasp at one friction half-angle after another, which all of its
/// contacts have, or one of them while the others keep theirs. Decisions are proved as those of
/// TestForceClosure are, of which one may call too close what the other one decides. They cost less
/// the more there were before: a twist that separated often does so at larger half-angles, too, and
/// columns of the simplex that balance at one half-angle nearly balance at another one
/// (WrenchSimplex::Resume).
template <int kDim>
class FrictionSearch {
 public:
  /// Of all contacts.
  explicit FrictionSearch(UnitContacts contacts);
  /// Of one; rims of the others are set.
  FrictionSearch(UnitContacts contacts, std::size_t finger);
  // The simplex refers to the contacts.
  FrictionSearch(const FrictionSearch&) = delete;
  FrictionSearch& operator=(const FrictionSearch&) = delete;

  [[nodiscard]] Decision Decide(double half_angle);

  /// The same without help of earlier ones: what TestForceClosure says.
  [[nodiscard]] Decision DecideAlone(double half_angle);

 private:
  using Twist = typename WrenchSimplex<kDim>::Vector;

  [[nodiscard]] std::span<UnitContact> searched() { return {contacts_.data() + first_, count_}; }
  void SetRims(double half_angle);
  Decision DecideAtRims(Twist& twist);
  void RefuteUpTo(const Twist& twist);

  UnitContacts contacts_;
  std::size_t first_;
  std::size_t count_;
  std::optional<WrenchSimplex<kDim>> simplex_;
  double refuted_ = 0;  ///< up to this half-angle some twist separates
};

extern template class FrictionSearch<3>;
extern template class FrictionSearch<6>;

}  // namespace regrasp::grasp
