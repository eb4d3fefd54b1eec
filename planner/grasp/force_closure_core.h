#pragma once

#include <optional>
#include <span>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// Proof of a decision. For kNo the twist that separates, which is zero if a pair line or the rank
/// decides; for kYes balanced forces inside the cones.
template <int kDim>
struct ForceClosureProof {
  typename WrenchSimplex<kDim>::Vector twist{};
  boost::container::small_vector<Eigen::Vector3d, kInlineContacts> forces;
};

/// Decide force closure without the argument checks of TestForceClosure.
/// @param contacts  contacts in their own frame (ContactFrame), with rims of unit force.
/// @param proof  output if not null.
/// @param twist  output if not null: after kNo the twist that separates, or zero if none was
///     necessary.
/// @param used   output if not null: the simplex that decided, if any; it refers to `contacts`.
template <int kDim>
[[nodiscard]] ForceClosure DecideForceClosure(const UnitContacts& contacts,
                                              ForceClosureProof<kDim>* proof = nullptr,
                                              typename WrenchSimplex<kDim>::Vector* twist = nullptr,
                                              std::optional<WrenchSimplex<kDim>>* used = nullptr);

/// Decide force closure of a grasp that the lines through pairs of contacts do not decide.
template <int kDim>
[[nodiscard]] ForceClosure DecideOpenForceClosure(
    const UnitContacts& contacts, ForceClosureProof<kDim>* proof = nullptr,
    typename WrenchSimplex<kDim>::Vector* twist = nullptr,
    std::optional<WrenchSimplex<kDim>>* used = nullptr);

/// Return the decision of DecideOpenForceClosure without bounds or forces.
/// @param twist  output: after kNo the twist that separates, or zero if the rank decides.
template <int kDim>
[[nodiscard]] Decision DecideOnly(const UnitContacts& contacts,
                                  typename WrenchSimplex<kDim>::Vector& twist);

/// Decide force closure of one grasp at a sequence of friction angles.
/// The angle applies to all contacts, or to one contact while the others keep theirs. Decisions are
/// proved as in TestForceClosure, but near the threshold one of the two may return kTooClose and
/// the other a decision. Later decisions cost less: a twist that separated often does so at larger
/// angles, and columns of the simplex that balance at one angle nearly balance at another
/// (WrenchSimplex::Resume).
template <int kDim>
class FrictionSearch {
 public:
  /// Search the friction angle of all contacts.
  explicit FrictionSearch(UnitContacts contacts);
  /// Search the friction angle of one contact; all other rims must be set.
  FrictionSearch(UnitContacts contacts, std::size_t finger);
  // Not copyable, because the simplex refers to the contacts.
  FrictionSearch(const FrictionSearch&) = delete;
  FrictionSearch& operator=(const FrictionSearch&) = delete;

  [[nodiscard]] Decision Decide(double friction_angle);

  /// Decide without reuse of earlier decisions, as TestForceClosure does.
  [[nodiscard]] Decision DecideAlone(double friction_angle);

 private:
  using Twist = typename WrenchSimplex<kDim>::Vector;

  [[nodiscard]] std::span<UnitContact> searched() { return {contacts_.data() + first_, count_}; }
  void SetRims(double friction_angle);
  Decision DecideAtRims(Twist& twist);
  void RefuteUpTo(const Twist& twist);

  UnitContacts contacts_;
  std::size_t first_;
  std::size_t count_;
  std::optional<WrenchSimplex<kDim>> simplex_;
  double refuted_ = 0;  ///< largest friction angle at which a known twist separates
};

extern template class FrictionSearch<3>;
extern template class FrictionSearch<6>;

/// Direction in which the forces inside a contact's cone turn the object about a line.
enum class Turn : unsigned char {
  kPositive,  ///< certain: all turn in the positive direction
  kNegative,  ///< certain: all turn in the negative direction
  kBoth,      ///< certain: some turn in the positive and some in the negative direction
  kNone,      ///< the contact is on the line
  kUnclear,   ///< undecidable because of rounding
};

/// Return the direction in which contact c turns the object about the line from a to b.
///
/// A force g at q has the torque u · g about the line, u = (b − a) × (q − a). Over the cone this
/// torque is between axial n·u − tangential |u⊥| and axial n·u + tangential |u⊥|.
[[nodiscard]] Turn TurnAboutLine(const UnitContact& a, const UnitContact& b, const UnitContact& c);

/// Return whether the segment from a to b is strictly inside both cones or both mirrored cones.
/// With the inward cones the contacts press the object together, with the mirrored ones they
/// stretch it. The two contacts alone balance, and resist every wrench except a torque about their
/// line.
[[nodiscard]] bool IsAntipodal(const UnitContact& a, const UnitContact& b);

/// Decision on force closure in space from the lines through two contacts.
enum class PairLineVerdict {
  kNo,  ///< there is a line about which all other contacts turn the object in the same direction
  /// There is an antipodal pair, and the others turn the object in both directions about its line.
  kYes,
  kOpen,  ///< neither
};

/// Distance from a line within which contacts count as on it, in a frame in which the contacts have
/// radius 1.
inline constexpr double kOnLine = 1e-12;

/// Test the lines through all pairs of contacts.
/// Forces at the two contacts have no torque about their line, whatever the friction. kNo therefore
/// also covers grasps for which a separating twist only touches: two contacts balance while the
/// others turn the object in the same direction about their line. kNo and kYes are certain.
///
/// @param contacts  contacts in space with rims set, of the order of 1 in size.
[[nodiscard]] PairLineVerdict TestPairLines(std::span<const UnitContact> contacts);

}  // namespace regrasp::grasp
