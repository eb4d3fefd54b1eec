#pragma once

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <boost/container_hash/hash.hpp>
#include <cassert>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/contact.h"
#include "planner/grasp/quality_rays.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/hand/hand.h"
#include "planner/object/object.h"

namespace regrasp::criteria {

/// Test of the grasp quality: exact (QualityAtLeast), or fast (QualityFilter). The fast test also
/// rejects a few grasps just above the threshold.
enum class QualityTest { kExact, kQuick };

/// Cached results of a GraspEvaluator for one grasp.
/// Callers that evaluate grasps repeatedly store one per grasp, under their own key, and pass it
/// with the grasp.
///
/// Results at one friction angle and share imply results at others. A force-closure grasp remains
/// so with more friction. A grasp that is not force closure is not so with less friction either.
/// The same applies to the criteria.
struct KnownGrasp {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kUnknown = -1;

  double fails_at = 0;  ///< friction angles at which the grasp is not, and is, force closure
  double holds_at = kInfinity;
  double good_at = kUnknown;  ///< shares of the criteria that the grasp meets, and does not meet
  double poor_at = kInfinity;
  double required = kUnknown;  ///< required friction angle
  double shortfall = 0;        ///< Shortfall of a grasp that does not meet the criteria; 0: unknown

  /// Return the entry of a grasp that is accepted without a test.
  [[nodiscard]] static KnownGrasp Accepted() { return {0, 0, kInfinity, kInfinity}; }
  /// Return the entry of a grasp that is force closure at a friction angle.
  [[nodiscard]] static KnownGrasp HeldAt(double friction_angle) { return {0, friction_angle}; }
};

/// Evaluator of grasps: whether they are good enough for a static grasp, and how good they are.
/// All planners use it. GraspMemory evaluates sets of numbered contacts, and a roadmap its
/// vertices. Margin and Score cache grasps by their coordinates. Not thread-safe.
///
/// A grasp is admitted if fingers can be at its contacts at the same time (CanMeet), it is force
/// closure, and it meets the criteria. An admitted grasp is good if the hand can also reach it.
class GraspEvaluator {
 public:
  /// @param object  grasped object; outlives this object.
  /// @throws std::invalid_argument  if the friction angle is outside (0, π/2).
  GraspEvaluator(const object::Object& object, const GraspCriteria& criteria,
                 const hand::Hand& hand = {}, QualityTest quality = QualityTest::kExact);

  /// Set the friction angle of force closure, radians. The quality keeps the friction of the
  /// criteria.
  void SetFrictionAngle(double friction_angle);
  /// Set the share of the criteria (GraspCriteria::Relaxed).
  void SetShare(double share);

  [[nodiscard]] const object::Object& object() const { return object_; }
  [[nodiscard]] const object::WrenchFrame& frame() const { return frame_; }
  [[nodiscard]] int dimension() const { return frame_.dimension; }
  /// Return the current criteria.
  [[nodiscard]] const GraspCriteria& criteria() const { return criteria_; }
  [[nodiscard]] double share() const { return share_; }
  /// Return the friction angle of force closure, radians.
  [[nodiscard]] double friction_angle() const { return friction_angle_; }
  [[nodiscard]] double finger_radius() const { return hand_.fingertip_radius; }
  /// Return the smallest number of contacts of a force-closure grasp.
  [[nodiscard]] int fewest_contacts() const {
    return dimension() == 3 && hand_.torsion == 0 ? 3 : 2;
  }
  /// Return the torsional friction length of the hand's contacts (grasp::Contact::torsion). It
  /// replaces the torsion of all evaluated contacts.
  [[nodiscard]] double torsion() const { return hand_.torsion; }

  /// Return whether two fingers can be at two contacts at the same time.
  [[nodiscard]] bool CanMeet(const grasp::Contact& a, const grasp::Contact& b) const {
    return criteria::CanMeet(a, b, same_point_, finger_radius());
  }
  /// Return whether the hand can be at a grasp, good or not.
  /// Its fingers must be at different points (CanMeet), each with clearance for a fingertip
  /// (CanRest) and reachable (CanReach).
  [[nodiscard]] bool IsReachable(const grasp::Grasp& grasp) const;
  /// Return whether a grasp is force closure at any friction angle, radians. No other criterion is
  /// tested.
  [[nodiscard]] bool HoldsAt(std::span<const grasp::Contact> grasp, double friction_angle) const;

  [[nodiscard]] bool IsAdmitted(const grasp::Grasp& grasp) const;
  [[nodiscard]] bool IsGood(const grasp::Grasp& grasp) const;
  /// Return whether a grasp is admitted, from cached results if they suffice.
  /// @param contacts_of  function that returns the contacts, convertible to std::span.
  template <typename ContactsOf>
  [[nodiscard]] bool Admits(KnownGrasp& known, const ContactsOf& contacts_of) const {
    const std::optional<bool> answer = Recall(known);
    return answer ? *answer : WorkOut(contacts_of(), known);
  }
  /// Return the required friction angle to `accuracy`, radians; π/2 if there is none.
  template <typename ContactsOf>
  [[nodiscard]] double RequiredFrictionAngle(KnownGrasp& known, const ContactsOf& contacts_of,
                                             double accuracy = kAngleAccuracy) const {
    if (known.required == KnownGrasp::kUnknown) {
      known.required = ComputeRequired(contacts_of(), accuracy);
    }
    return known.required;
  }
  /// Return the friction margin of a good grasp, radians; nullopt if it is not good.
  /// The margin is the friction angle minus the required friction angle. Results are cached.
  [[nodiscard]] std::optional<double> Margin(const grasp::Grasp& grasp) const;
  /// Return a score of a grasp, larger is better. Results are cached.
  /// @returns the margin of a good grasp; otherwise a negative number. It is the Shortfall, which
  ///     is expensive, or −1 if no hand can hold the grasp.
  [[nodiscard]] double Score(const grasp::Grasp& grasp) const;

  /// Counts of evaluated tests.
  struct Counts {
    std::int64_t force_closure = 0;  ///< tests of force closure
    std::int64_t criteria = 0;       ///< tests of the criteria beyond it
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Return the number of grasps whose quality the fast test could not decide immediately.
  [[nodiscard]] std::int64_t shot_count() const { return filter_.shot_count(); }

 private:
  using Contacts = std::span<const grasp::Contact>;

  /// Accuracy of required friction angles that are only compared, radians.
  static constexpr double kAngleAccuracy = 1e-5;

  /// Return whether cached results admit a grasp; nullopt if they do not suffice.
  [[nodiscard]] std::optional<bool> Recall(const KnownGrasp& known) const {
    if (friction_angle_ <= known.fails_at || share_ >= known.poor_at) return false;
    if (friction_angle_ < known.holds_at) return std::nullopt;
    if (share_ <= known.good_at || !asks_more_) return true;
    return std::nullopt;
  }
  [[nodiscard]] KnownGrasp& Know(const grasp::Grasp& grasp) const;
  [[nodiscard]] bool WorkOut(Contacts grasp, KnownGrasp& known) const;
  [[nodiscard]] double ComputeRequired(Contacts grasp, double accuracy) const;
  [[nodiscard]] bool MeetsCriteria(Contacts grasp) const;
  [[nodiscard]] bool CanAllMeet(Contacts grasp) const;
  [[nodiscard]] bool AreReachable(Contacts contacts) const;

  const object::Object& object_;
  object::WrenchFrame frame_;
  GraspCriteria asked_;  ///< unrelaxed
  GraspCriteria criteria_;
  double share_ = 1;
  bool asks_more_;
  hand::Hand hand_;
  QualityTest quality_;
  double same_point_;
  double friction_angle_;
  mutable grasp::QualityFilter filter_;
  mutable Counts counts_;
  mutable std::map<std::vector<double>, KnownGrasp>
      known_;  ///< results, by the coordinates of a grasp
};

/// Set of contacts that a hand holds at the same time.
/// They are given by their numbers in a GraspMemory, in ascending order.
class ContactSet {
 public:
  static constexpr int kMostHeld = hand::kFingersInSpace;
  /// Exclusive upper bound of contact numbers.
  static constexpr int kMostNumbers = std::numeric_limits<std::int16_t>::max();

  ContactSet() = default;

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int operator[](int i) const { return numbers_[i]; }
  [[nodiscard]] const std::int16_t* begin() const { return numbers_.data(); }
  [[nodiscard]] const std::int16_t* end() const { return numbers_.data() + size_; }

  [[nodiscard]] bool Has(int contact) const { return std::find(begin(), end(), contact) != end(); }

  void Insert(int contact) {
    assert(size_ < kMostHeld && contact >= 0 && contact < kMostNumbers && !Has(contact));
    int place = size_++;
    for (; place > 0 && numbers_[place - 1] > contact; --place) {
      numbers_[place] = numbers_[place - 1];
    }
    numbers_[place] = static_cast<std::int16_t>(contact);
  }
  [[nodiscard]] ContactSet With(int contact) const {
    ContactSet set = *this;
    set.Insert(contact);
    return set;
  }
  [[nodiscard]] ContactSet Without(int contact) const {
    ContactSet set;
    for (const int held : *this) {
      if (held != contact) set.numbers_[set.size_++] = static_cast<std::int16_t>(held);
    }
    return set;
  }

  /// Return the number of contacts in either set.
  [[nodiscard]] static int CountUnion(const ContactSet& a, const ContactSet& b) {
    int common = 0;
    for (const int contact : a) common += b.Has(contact) ? 1 : 0;
    return a.size() + b.size() - common;
  }

  friend bool operator==(const ContactSet& a, const ContactSet& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::array<std::int16_t, kMostHeld> numbers_{};
  std::int8_t size_ = 0;
};

/// Hash of contact sets.
struct ContactSetHash {
  std::size_t operator()(const ContactSet& set) const {
    return boost::hash_range(set.begin(), set.end());
  }
};

/// Numbered contacts with cached evaluations of their sets.
/// Contacts must be reachable (GraspEvaluator) before they are added.
class GraspMemory : public GraspEvaluator {
 public:
  using GraspEvaluator::GraspEvaluator;

  /// Add a contact unless it is known.
  /// @param contact  contact with its face.
  /// @returns number of the contact.
  int Add(const grasp::Contact& contact);
  [[nodiscard]] ContactSet Add(const grasp::Grasp& grasp);
  /// Add contacts under consecutive numbers, even if they are known.
  /// @throws std::invalid_argument  if there would be more than ContactSet::kMostNumbers.
  void Append(std::span<const grasp::Contact> contacts);
  /// Return whether the contacts of another grasp can be added.
  [[nodiscard]] bool has_capacity() const {
    return count() + ContactSet::kMostHeld <= ContactSet::kMostNumbers;
  }
  [[nodiscard]] int count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] const grasp::Contact& contact(int number) const { return contacts_[number]; }
  [[nodiscard]] grasp::Grasp GraspOf(const ContactSet& set) const;

  using GraspEvaluator::CanMeet;
  [[nodiscard]] bool CanMeet(int a, int b) const { return CanMeet(contacts_[a], contacts_[b]); }
  /// Return whether a finger can be placed at `contact` while others hold `set`.
  [[nodiscard]] bool CanMeet(const ContactSet& set, int contact) const;

  /// Return whether a grasp is admitted, so that a sequence may contain it.
  [[nodiscard]] bool Admits(const ContactSet& set) {
    if (set.size() < fewest_contacts()) return false;
    return GraspEvaluator::Admits(known_[set], [&] { return ContactsOf(set); });
  }
  [[nodiscard]] double RequiredFrictionAngle(const ContactSet& set) {
    return GraspEvaluator::RequiredFrictionAngle(known_[set], [&] { return ContactsOf(set); });
  }
  /// Admit a grasp without a test, as for start and goal.
  void Accept(const ContactSet& set) { known_[set] = KnownGrasp::Accepted(); }

 private:
  /// Contacts of a set, without memory allocation.
  struct HeldContacts : boost::container::static_vector<grasp::Contact, ContactSet::kMostHeld> {
    // Boost's iterators are not contiguous, so std::span does not accept the container itself.
    operator std::span<const grasp::Contact>() const { return {data(), size()}; }  // NOLINT
  };
  [[nodiscard]] HeldContacts ContactsOf(const ContactSet& set) const;

  std::vector<grasp::Contact> contacts_;
  std::unordered_map<ContactSet, KnownGrasp, ContactSetHash> known_;
};

}  // namespace regrasp::criteria
