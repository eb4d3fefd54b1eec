#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/contact.h"
#include "planner/grasp/quality_filter.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/hand/hand.h"
#include "planner/object/object.h"

namespace regrasp::criteria {

/// How the quality of grasps is decided: exactly (QualityAtLeast), or quickly, which refuses a few
/// grasps just above the threshold too (QualityFilter).
enum class QualityTest { kExact, kQuick };

/// What a GraspEvaluator has worked out of one grasp. Whoever asks for grasps again keeps one for
/// each, under whatever identifies a grasp there, and hands it over with the grasp.
///
/// What is known at one friction and share is used at others: a grasp that is force closure is so
/// with more friction, one that is not neither with less; the same with what is asked for.
struct KnownGrasp {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kUnknown = -1;

  double fails_at = 0;  ///< half-angles at which fingers cannot hold it so, and can
  double holds_at = kInfinity;
  double good_at = kUnknown;  ///< shares of the criteria that it meets, and that it does not meet
  double poor_at = kInfinity;
  double required = kUnknown;  ///< half-angle
  double shortfall = 0;        ///< of one that does not meet the criteria; 0: not known

  /// Taken as it is, whatever it is worth.
  [[nodiscard]] static KnownGrasp Accepted() { return {0, 0, kInfinity, kInfinity}; }
  /// Fingers can hold it at a half-angle.
  [[nodiscard]] static KnownGrasp HeldAt(double half_angle) { return {0, half_angle}; }
};

/// Decides whether grasps are good enough for a hand to rest in, and how good they are. Of all
/// planners' grasps: GraspMemory has those of numbered contacts, a roadmap those of its vertices;
/// Margin and Score remember grasps by their coordinates. Not for several threads.
///
/// A grasp is admitted where fingers can be at its contacts at once (CanMeet), it is force closure,
/// and it meets the criteria; it is good where the hand can also come there.
class GraspEvaluator {
 public:
  /// @param object  must outlive this object.
  /// @throws std::invalid_argument  the half-angle is outside (0, π/2).
  GraspEvaluator(const object::Object& object, const GraspCriteria& criteria,
                 const hand::Hand& hand = {}, QualityTest quality = QualityTest::kExact);

  /// From now on force closure is asked for at this half-angle, radians; the quality stays that at
  /// the criteria's friction.
  void SetHalfAngle(double half_angle);
  /// From now on this share of the criteria is asked for (GraspCriteria::Relaxed).
  void SetShare(double share);

  [[nodiscard]] const object::Object& object() const { return object_; }
  [[nodiscard]] const object::WrenchFrame& frame() const { return frame_; }
  [[nodiscard]] int dimension() const { return frame_.dimension; }
  /// Those that are asked for now.
  [[nodiscard]] const GraspCriteria& criteria() const { return criteria_; }
  [[nodiscard]] double share() const { return share_; }
  /// At which grasps are force closure, radians.
  [[nodiscard]] double half_angle() const { return half_angle_; }
  [[nodiscard]] double finger_radius() const { return hand_.fingertip_radius; }
  /// Contacts that a force-closure grasp has at least.
  [[nodiscard]] int fewest_contacts() const {
    return dimension() == 3 && hand_.torsion == 0 ? 3 : 2;
  }
  /// Of the hand's contacts (grasp::Contact::torsion): whatever torsion the contacts have that come
  /// here, they are taken to have this one.
  [[nodiscard]] double torsion() const { return hand_.torsion; }

  /// Whether two fingers can be at two contacts at once.
  [[nodiscard]] bool CanMeet(const grasp::Contact& a, const grasp::Contact& b) const {
    return criteria::CanMeet(a, b, same_point_, finger_radius());
  }
  /// Whether the hand can be there, good or not: fingers at different points (CanMeet), each with
  /// room for a fingertip (CanRest), and it can come there (CanReach).
  [[nodiscard]] bool IsReachable(const grasp::Grasp& grasp) const;
  /// Force closure alone, at any half-angle, radians.
  [[nodiscard]] bool HoldsAt(std::span<const grasp::Contact> grasp, double half_angle) const;

  [[nodiscard]] bool IsAdmitted(const grasp::Grasp& grasp) const;
  [[nodiscard]] bool IsGood(const grasp::Grasp& grasp) const;
  /// Whether it is admitted, from what is known of it where that is enough.
  /// @param contacts_of  gives the grasp's contacts, as something that std::span takes.
  template <typename ContactsOf>
  [[nodiscard]] bool Admits(KnownGrasp& known, const ContactsOf& contacts_of) const {
    const std::optional<bool> answer = Recall(known);
    return answer ? *answer : WorkOut(contacts_of(), known);
  }
  /// The half-angle at which it is force closure, to `accuracy`, radians; π/2 where there is none.
  template <typename ContactsOf>
  [[nodiscard]] double RequiredHalfAngle(KnownGrasp& known, const ContactsOf& contacts_of,
                                         double accuracy = kAngleAccuracy) const {
    if (known.required == KnownGrasp::kUnknown) {
      known.required = ComputeRequired(contacts_of(), accuracy);
    }
    return known.required;
  }
  /// From the required half-angle of a good grasp to the one at hand, radians; nullopt where it is
  /// not good. Remembered.
  [[nodiscard]] std::optional<double> Margin(const grasp::Grasp& grasp) const;
  /// How good it is to rest in a grasp: its margin where it is good; otherwise a negative number,
  /// the worse the lower: its Shortfall, which takes long, or −1 where no hand can hold it.
  /// Remembered.
  [[nodiscard]] double Score(const grasp::Grasp& grasp) const;

  /// What was worked out so far.
  struct Counts {
    std::int64_t force_closure = 0;  ///< grasps tested for it
    std::int64_t criteria = 0;       ///< grasps tested for what is asked beyond it
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Grasps whose quality the quick test could not decide at once.
  [[nodiscard]] std::int64_t shot_count() const { return filter_.shot_count(); }

 private:
  using Contacts = std::span<const grasp::Contact>;

  /// Of required half-angles that are only compared, radians.
  static constexpr double kAngleAccuracy = 1e-5;

  /// Whether a grasp is admitted; nullopt where that is not known.
  [[nodiscard]] std::optional<bool> Recall(const KnownGrasp& known) const {
    if (half_angle_ <= known.fails_at || share_ >= known.poor_at) return false;
    if (half_angle_ < known.holds_at) return std::nullopt;
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
  GraspCriteria asked_;  ///< in full
  GraspCriteria criteria_;
  double share_ = 1;
  bool asks_more_;
  hand::Hand hand_;
  QualityTest quality_;
  double same_point_;
  double half_angle_;
  mutable grasp::QualityFilter filter_;
  mutable Counts counts_;
  mutable std::map<std::vector<double>, KnownGrasp> known_;  ///< by the numbers of a grasp
};

}  // namespace regrasp::criteria
