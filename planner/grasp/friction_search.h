#pragma once

#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// Decide force closure of one grasp at a sequence of friction angles.
/// The angle applies to all contacts, or to one contact while the others keep theirs. Decisions are
/// proved as in TestForceClosure, but near the threshold one of the two may return kTooClose and
/// the other a decision. Later decisions cost less: a twist that separated often does so at larger
/// angles, and columns of the simplex that balance at one angle nearly balance at another
/// (WrenchSimplex::Resume).
template <int kDim>
class FrictionSearch {
 public:
  /// Search the friction angle of all contacts.
  explicit FrictionSearch(UnitContacts contacts);
  /// Search the friction angle of one contact; all other rims must be set.
  FrictionSearch(UnitContacts contacts, std::size_t finger);
  // Not copyable, because the simplex refers to the contacts.
  FrictionSearch(const FrictionSearch&) = delete;
  FrictionSearch& operator=(const FrictionSearch&) = delete;

  [[nodiscard]] Decision Decide(double friction_angle);

  /// Decide without reuse of earlier decisions, as TestForceClosure does.
  [[nodiscard]] Decision DecideAlone(double friction_angle);

 private:
  using Twist = typename WrenchSimplex<kDim>::Vector;

  [[nodiscard]] std::span<UnitContact> searched() { return {contacts_.data() + first_, count_}; }
  void SetRims(double friction_angle);
  Decision DecideAtRims(Twist& twist);
  void RefuteUpTo(const Twist& twist);

  UnitContacts contacts_;
  std::size_t first_;
  std::size_t count_;
  std::optional<WrenchSimplex<kDim>> simplex_;
  double refuted_ = 0;  ///< largest friction angle at which a known twist separates
};

extern template class FrictionSearch<3>;
extern template class FrictionSearch<6>;

}  // namespace regrasp::grasp
