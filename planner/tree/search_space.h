#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/grasp/contact.h"
#include "planner/grasp/quality_filter.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/object/object.h"
#include "planner/tree/contact_set.h"

namespace regrasp {

/// What is asked of the grasps that a search passes.
struct GraspDemands {
  double half_angle = 0;  ///< friction, radians
  /// Force closure is asked for at a half-angle smaller by this, radians.
  double margin = 0;
  /// Grasps are clearly of at least this quality (QualityFilter); 0: force closure is enough.
  double min_quality = 0;
  /// Of fingers that are not points (KeepApart), the object's unit of length.
  double finger_radius = 0;
};

/// When a search gives up.
struct SearchLimits {
  std::int64_t most_tests = std::numeric_limits<std::int64_t>::max();
  Deadline deadline = {};
};

/// What a search may look at: contacts as they come up, numbered, and which sets of them are grasps
/// that a sequence may pass. Counts what it tests, which is what searches spend.
class SearchSpace {
 public:
  /// @param object  outlives this object.
  SearchSpace(const Object& object, const GraspDemands& demands);

  /// From now on force closure is asked for at this half-angle, radians. What is known of a grasp
  /// stays known: one that holds does so with more friction, one that does not neither with less.
  void SetHalfAngle(double half_angle);
  /// From now on grasps are asked to be clearly of this quality (QualityFilter).
  void SetMinQuality(double min_quality) { demands_.min_quality = min_quality; }

  [[nodiscard]] const Object& object() const { return object_; }
  [[nodiscard]] int dimension() const { return frame_.dimension; }
  [[nodiscard]] const GraspDemands& demands() const { return demands_; }
  /// At which grasps and aligns are force closure, radians.
  [[nodiscard]] double half_angle() const { return half_angle_; }
  /// That the hand has: 5 in space, 4 in the plane.
  [[nodiscard]] int fingers() const { return dimension() == 3 ? 5 : 4; }
  /// Contacts that a force-closure grasp has at least.
  [[nodiscard]] int fewest_contacts() const { return dimension() == 3 ? 3 : 2; }

  /// @param contact  knows its face. @returns its number, the old one where it is known.
  int Add(const Contact& contact);
  [[nodiscard]] ContactSet Add(const Grasp& grasp);
  /// Whether another grasp's contacts can be added.
  [[nodiscard]] bool has_room() const {
    return count() + ContactSet::kMostHeld <= ContactSet::kMostNumbers;
  }
  [[nodiscard]] int count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] const Contact& contact(int number) const { return contacts_[number]; }
  [[nodiscard]] Grasp GraspOf(const ContactSet& set) const;

  /// Whether two fingers can stand at two contacts at once.
  [[nodiscard]] bool CanMeet(int a, int b) const { return CanMeet(contacts_[a], contacts_[b]); }
  [[nodiscard]] bool CanMeet(const Contact& a, const Contact& b) const;
  /// Whether a finger can come to `contact` while others hold `set`.
  [[nodiscard]] bool CanMeet(const ContactSet& set, int contact) const;

  /// Whether a sequence may pass this grasp: force closure, and good enough. Remembered.
  /// @param set  contacts that can meet.
  [[nodiscard]] bool Admits(const ContactSet& set);
  /// The same for contacts that have no numbers yet, which need not be able to meet.
  [[nodiscard]] bool IsAdmitted(const Grasp& grasp);
  /// Force closure alone, at any half-angle, radians.
  [[nodiscard]] bool HoldsAt(const Grasp& grasp, double half_angle);
  /// The half-angle at which it is force closure, to 1e-5, radians; π/2 where there is none.
  /// Remembered.
  [[nodiscard]] double RequiredHalfAngle(const ContactSet& set);
  /// Takes a grasp as it is, whatever it is worth: the ends of a sequence.
  void Accept(const ContactSet& set) { known_[set] = kAccepted; }

  /// Tests of force closure so far, those of certificates included.
  [[nodiscard]] std::int64_t tests() const { return tests_; }
  void CountTests(std::int64_t tests) { tests_ += tests; }
  void SetLimits(const SearchLimits& limits) { limits_ = limits; }
  /// Whether the search has to give up. Looks at the clock now and then only.
  [[nodiscard]] bool IsSpent();
  [[nodiscard]] bool out_of_time() const { return out_of_time_; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  /// What is known of a grasp.
  struct Known {
    double fails_at = 0;  ///< half-angles at which it does not hold and does
    double holds_at = kInfinity;
    double good_at = 0;  ///< qualities that it clearly has and has not
    double poor_at = kInfinity;
    double required = kUnknown;  ///< half-angle
  };
  static constexpr double kUnknown = -1;
  static constexpr Known kAccepted = {0, 0, kInfinity, kInfinity, kUnknown};

  /// Force closure of contacts in the object's frame with their rims set.
  [[nodiscard]] bool Holds(UnitContacts contacts);
  [[nodiscard]] bool IsGood(const Grasp& grasp);

  const Object& object_;
  WrenchFrame frame_;
  GraspDemands demands_;
  double half_angle_;
  QualityFilter filter_;
  double same_point_;
  std::vector<Contact> contacts_;
  UnitContacts units_;  ///< of the contacts, in the object's frame
  std::unordered_map<ContactSet, Known, ContactSetHash> known_;
  std::int64_t tests_ = 0;
  SearchLimits limits_;
  std::int64_t next_look_ = 0;  ///< at the clock, by tests
  bool out_of_time_ = false;
};

}  // namespace regrasp
