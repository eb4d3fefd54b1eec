#include "planner/plan/invented_contacts.h"

namespace regrasp::plan {

namespace {

/// Counts contacts on invented surface, and remembers the first.
struct Found {
  int count = 0;
  std::string first;

  void Add(const object::Object& object, const FingerGrasp& grasp, const std::string& where) {
    for (const FingerContact& contact : grasp) {
      if (!contact.contact.face.valid() || !object.IsInvented(contact.contact.face)) continue;
      if (count++ == 0) first = "finger " + std::to_string(contact.finger) + " in " + where;
    }
  }
};

}  // namespace

std::string InventedContactsWarning(const object::Object& object, const Plan& located) {
  Found found;
  found.Add(object, located.initial, "the initial grasp");
  for (std::size_t i = 0; i < located.steps.size(); ++i) {
    const std::string where = "step " + std::to_string(i + 1);
    if (const auto* step = std::get_if<Switch>(&located.steps[i])) {
      found.Add(object, step->place, where);
    } else if (const auto* align = std::get_if<Align>(&located.steps[i])) {
      found.Add(object, align->waypoints.back(), where);
    }
  }
  if (found.count == 0) return "";
  return std::to_string(found.count) + (found.count == 1 ? " contact lies" : " contacts lie") +
         " on surface that a repair invented (" + found.first + "): nobody knows what is there";
}

}  // namespace regrasp::plan
