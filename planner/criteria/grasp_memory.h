#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/criteria/contact_set.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/contact.h"
#include "planner/grasp/quality_filter.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/hand/hand.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::criteria {

/// How the quality of grasps is decided: exactly (QualityAtLeast), or quickly, which refuses a few
/// grasps just above the threshold too (QualityFilter).
enum class QualityTest { kExact, kQuick };

/// Numbered contacts, and which sets of them are grasps that a sequence may pass: worked out when
/// first asked, then remembered. Contacts are reachable (GraspEvaluator) before they come here.
///
/// What is known of a grasp at one friction or quality is used at others: one that holds does so
/// with more friction, one that does not neither with less.
class GraspMemory {
 public:
  /// @param same_point  contacts no farther apart than this are at the same point (kSamePoint).
  /// @throws std::invalid_argument  the half-angle is outside (0, π/2).
  GraspMemory(const object::WrenchFrame& frame, double same_point, const GraspCriteria& criteria,
              const hand::Hand& hand = {}, QualityTest quality = QualityTest::kExact);

  /// From now on force closure is asked for at this half-angle, radians; the quality stays that at
  /// the criteria's friction.
  void SetHalfAngle(double half_angle);
  /// From now on grasps are asked to be of this quality.
  void SetMinQuality(double min_quality) { criteria_.min_quality = min_quality; }

  [[nodiscard]] const object::WrenchFrame& frame() const { return frame_; }
  [[nodiscard]] int dimension() const { return frame_.dimension; }
  [[nodiscard]] const GraspCriteria& criteria() const { return criteria_; }
  [[nodiscard]] double min_quality() const { return criteria_.min_quality; }
  [[nodiscard]] double finger_radius() const { return finger_radius_; }
  /// At which grasps are force closure, radians.
  [[nodiscard]] double half_angle() const { return half_angle_; }
  /// Contacts that a force-closure grasp has at least.
  [[nodiscard]] int fewest_contacts() const { return dimension() == 3 ? 3 : 2; }

  /// @param contact  knows its face. @returns its number, the old one where it is known.
  int Add(const grasp::Contact& contact);
  [[nodiscard]] ContactSet Add(const grasp::Grasp& grasp);
  /// Adds contacts under the next numbers, whether they are known or not.
  /// @throws std::invalid_argument  there would be more than ContactSet::kMostNumbers.
  void Append(std::span<const grasp::Contact> contacts);
  /// Whether another grasp's contacts can be added.
  [[nodiscard]] bool has_capacity() const {
    return count() + ContactSet::kMostHeld <= ContactSet::kMostNumbers;
  }
  [[nodiscard]] int count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] const grasp::Contact& contact(int number) const { return contacts_[number]; }
  [[nodiscard]] grasp::Grasp GraspOf(const ContactSet& set) const;

  /// Whether two fingers can be at two contacts at once.
  [[nodiscard]] bool CanMeet(const grasp::Contact& a, const grasp::Contact& b) const {
    return criteria::CanMeet(a, b, same_point_, finger_radius_);
  }
  [[nodiscard]] bool CanMeet(int a, int b) const { return CanMeet(contacts_[a], contacts_[b]); }
  /// Whether a finger can come to `contact` while others hold `set`.
  [[nodiscard]] bool CanMeet(const ContactSet& set, int contact) const;

  /// Whether a sequence may pass this grasp: its contacts can meet, it is force closure, and it
  /// meets the criteria. Remembered.
  [[nodiscard]] bool Admits(const ContactSet& set);
  /// The same for contacts that have no numbers yet.
  [[nodiscard]] bool IsAdmitted(const grasp::Grasp& grasp);
  /// Force closure alone, at any half-angle, radians.
  [[nodiscard]] bool HoldsAt(const grasp::Grasp& grasp, double half_angle);
  /// The half-angle at which it is force closure, to 1e-5, radians; π/2 where there is none.
  /// Remembered.
  [[nodiscard]] double RequiredHalfAngle(const ContactSet& set);
  /// Takes a grasp as it is, whatever it is worth: the ends of a sequence.
  void Accept(const ContactSet& set) { known_[set] = kAccepted; }

  /// What was worked out so far.
  struct Counts {
    std::int64_t force_closure = 0;  ///< grasps tested for it
    std::int64_t criteria = 0;       ///< grasps tested for what is asked beyond it
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Grasps whose quality the quick test could not decide at once.
  [[nodiscard]] std::int64_t shot_count() const { return filter_.shot_count(); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kUnknown = -1;
  /// What is known of a grasp.
  struct Known {
    double fails_at = 0;  ///< half-angles at which it is not force closure and is
    double holds_at = kInfinity;
    double good_at = kUnknown;  ///< qualities at which it meets the criteria and does not
    double poor_at = kInfinity;
    double required = kUnknown;  ///< half-angle
  };
  static constexpr Known kAccepted = {0, 0, kInfinity, kInfinity, kUnknown};

  /// Force closure of contacts in the object's frame with their rims set.
  [[nodiscard]] bool Holds(grasp::UnitContacts contacts);
  [[nodiscard]] bool CanAllMeet(const grasp::Grasp& grasp) const;
  [[nodiscard]] bool IsGoodEnough(const grasp::Grasp& grasp);

  object::WrenchFrame frame_;
  double same_point_;
  GraspCriteria criteria_;
  double finger_radius_;
  QualityTest quality_;
  double half_angle_;
  grasp::QualityFilter filter_;
  std::vector<grasp::Contact> contacts_;
  grasp::UnitContacts units_;  ///< of the contacts, in the object's frame
  std::unordered_map<ContactSet, Known, ContactSetHash> known_;
  Counts counts_;
};

}  // namespace regrasp::criteria
