#include "planner/gait/supported_grasps.h"

namespace regrasp::gait {
namespace {

/// Fewest contacts of a grasp of hard fingers.
constexpr int kFewestContacts = 3;

}  // namespace

bool SupportedGrasps::Holds(const criteria::ContactSet& set, int node) {
  if (memory_.Admits(set)) return true;
  if (setup_.carrier == nullptr) return false;
  const auto [found, is_new] = supported_.try_emplace({set, node});
  if (is_new) {
    found->second = setup_.carrier->HoldsAt(memory_.GraspOf(set), grid_.PoseAt(node));
  }
  return found->second;
}

bool SupportedGrasps::Holds(const ContactAssignment& assignment, int node) {
  criteria::ContactSet set;
  for (const int point : assignment) {
    if (point != kNone && !set.Has(point)) set.Insert(point);
  }
  return set.size() < kFewestContacts || Holds(set, node);
}

}  // namespace regrasp::gait
