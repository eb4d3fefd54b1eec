#include "planner/roadmap/grasp_oracle.h"

#include <algorithm>
#include <stdexcept>

#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure.h"

namespace regrasp {

GraspOracle::GraspOracle(const std::vector<Contact>& contacts, const WrenchFrame& frame,
                         double half_angle, double same_point,
                         std::function<bool(const Grasp&)> is_good, double finger_radius)
    : contacts_(contacts),
      frame_(frame),
      half_angle_(half_angle),
      same_point_(same_point),
      is_good_(std::move(is_good)),
      finger_radius_(finger_radius) {
  if (contacts.size() > kMostOracleContacts) {
    throw std::invalid_argument("too many contact points");
  }
}

Grasp GraspOracle::GraspOf(const Quadruple& contacts) const {
  Grasp grasp;
  for (const int contact : contacts) grasp.push_back(contacts_[contact]);
  return grasp;
}

bool GraspOracle::Admits(const Quadruple& ascending) {
  const auto [entry, is_new] = known_.try_emplace(GraspKey(ascending), false);
  if (is_new) entry->second = Test(ascending);
  return entry->second;
}

bool GraspOracle::ExcludeEachOther(int a, int b) const {
  return (contacts_[a].p - contacts_[b].p).norm() <= same_point_ ||
         !KeepApart(std::array{contacts_[a], contacts_[b]}, finger_radius_);
}

bool GraspOracle::Test(const Quadruple& grasp) {
  ++test_count_;
  const std::array contacts = {contacts_[grasp[0]], contacts_[grasp[1]], contacts_[grasp[2]],
                               contacts_[grasp[3]]};
  if (!IsForceClosure(contacts, frame_, half_angle_)) return false;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) {
      if (ExcludeEachOther(grasp[i], grasp[j])) return false;
    }
  }
  if (!is_good_) return true;
  ++good_count_;
  return is_good_({contacts.begin(), contacts.end()});
}

}  // namespace regrasp
