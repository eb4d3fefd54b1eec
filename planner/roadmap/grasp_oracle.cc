#include "planner/roadmap/grasp_oracle.h"

#include <algorithm>
#include <utility>

namespace regrasp::roadmap {

GraspOracle::GraspOracle(const object::Object& object, std::span<const grasp::Contact> contacts,
                         const criteria::GraspCriteria& criteria, const hand::Hand& hand,
                         Deadline deadline)
    : GraspMemory(object, criteria, hand), deadline_(std::move(deadline)) {
  Append(contacts);
}

bool GraspOracle::Admits(const Quadruple& ascending) {
  deadline_.Check();
  // One contact cannot be held twice.
  if (std::ranges::adjacent_find(ascending) != ascending.end()) return false;
  criteria::ContactSet set;
  for (const int contact : ascending) set.Insert(contact);
  return GraspMemory::Admits(set);
}

}  // namespace regrasp::roadmap
