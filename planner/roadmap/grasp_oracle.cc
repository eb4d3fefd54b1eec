#include "planner/roadmap/grasp_oracle.h"

#include <algorithm>
#include <utility>

namespace regrasp::roadmap {

GraspOracle::GraspOracle(std::span<const grasp::Contact> contacts, const object::WrenchFrame& frame,
                         double same_point, const criteria::GraspCriteria& criteria,
                         const hand::Hand& hand, Deadline deadline)
    : memory_(frame, same_point, criteria, hand), deadline_(std::move(deadline)) {
  memory_.Append(contacts);
}

grasp::Grasp GraspOracle::GraspOf(const Quadruple& contacts) const {
  grasp::Grasp grasp;
  for (const int contact : contacts) grasp.push_back(memory_.contact(contact));
  return grasp;
}

bool GraspOracle::Admits(const Quadruple& ascending) {
  deadline_.Check();
  // One contact cannot be held twice.
  if (std::ranges::adjacent_find(ascending) != ascending.end()) return false;
  criteria::ContactSet set;
  for (const int contact : ascending) set.Insert(contact);
  return memory_.Admits(set);
}

}  // namespace regrasp::roadmap
