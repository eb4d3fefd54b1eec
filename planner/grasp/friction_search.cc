#include "planner/grasp/friction_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure_core.h"

namespace regrasp::grasp {

template <int kDim>
FrictionSearch<kDim>::FrictionSearch(UnitContacts contacts)
    : contacts_(std::move(contacts)), first_(0), count_(contacts_.size()) {}

template <int kDim>
FrictionSearch<kDim>::FrictionSearch(UnitContacts contacts, std::size_t finger)
    : contacts_(std::move(contacts)), first_(finger), count_(1) {}

template <int kDim>
Decision FrictionSearch<kDim>::Decide(double friction_angle) {
  if (friction_angle <= refuted_) return Decision::kNo;
  SetRims(friction_angle);
  Twist twist{};
  const Decision decision = DecideAtRims(twist);
  if (decision == Decision::kNo) RefuteUpTo(twist);
  return decision;
}

template <int kDim>
Decision FrictionSearch<kDim>::DecideAlone(double friction_angle) {
  SetRims(friction_angle);
  return DecideForceClosure<kDim>(contacts_).decision;
}

template <int kDim>
void FrictionSearch<kDim>::SetRims(double friction_angle) {
  for (UnitContact& contact : searched()) {
    contact.axial = std::cos(friction_angle);
    contact.tangential = std::sin(friction_angle);
  }
}

template <int kDim>
Decision FrictionSearch<kDim>::DecideAtRims(Twist& twist) {
  using Status = typename WrenchSimplex<kDim>::Status;
  if (simplex_) {
    const Status status = simplex_->Resume(twist);
    if (status == Status::kInfeasible) return Decision::kNo;
    if (status == Status::kFeasible && simplex_->BallRadius() > kForceClosureEpsilon) {
      return Decision::kYes;
    }
  }
  return DecideForceClosure<kDim>(contacts_, nullptr, &twist, &simplex_).decision;
}

template <int kDim>
void FrictionSearch<kDim>::RefuteUpTo(const Twist& twist) {
  double angle = std::numbers::pi / 2;
  for (const UnitContact& contact : searched()) {
    angle = std::min(angle, HeldOffFrictionAngle<kDim>(contact, twist.data()));
  }
  refuted_ = std::max(refuted_, angle - kClearlyRefuted);
}

template class FrictionSearch<3>;
template class FrictionSearch<6>;

}  // namespace regrasp::grasp
