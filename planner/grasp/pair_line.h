#pragma once

#include <span>

#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {

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
