#pragma once

#include <span>

#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {

/// Which way the forces inside a contact's cone turn the object about a line.
enum class Turn : unsigned char {
  kPositive,  ///< certain: all of them the positive way
  kNegative,  ///< certain: all of them the negative way
  kBoth,      ///< certain: some this way, some the other
  kNone,      ///< the contact is on the line
  kUnclear,   ///< rounding hides it
};

/// The way contact c turns the object about the line from a to b.
///
/// A force g at q has the torque u · g about it, u = (b − a) × (q − a); over the cone that is
/// between axial n·u − tangential |u⊥| and axial n·u + tangential |u⊥|.
[[nodiscard]] Turn TurnAboutLine(const UnitContact& a, const UnitContact& b, const UnitContact& c);

/// True iff the segment from a to b lies strictly inside both cones, the inward ones (squeezing) or
/// their mirrors (stretching): the two contacts alone balance, and resist every wrench but a turn
/// about their line.
[[nodiscard]] bool IsAntipodal(const UnitContact& a, const UnitContact& b);

/// What the lines through two contacts say of force closure in space.
enum class PairLineVerdict {
  kNo,    ///< about some line all other contacts turn the object the same way
  kYes,   ///< an antipodal pair, and about its line the others turn the object both ways
  kOpen,  ///< neither
};

/// Contacts this close to a line, in a frame where the contacts have radius 1, count as on it.
inline constexpr double kOnLine = 1e-12;

/// Looks at all pairs. Forces at the two contacts have no torque about their line, whatever the
/// friction, so kNo holds even for grasps that a separating twist can only touch: two contacts that
/// balance while the others push the same way about their line. Both answers are certain.
///
/// @param contacts  in space, rims set, of the order of 1 in size.
[[nodiscard]] PairLineVerdict TestPairLines(std::span<const UnitContact> contacts);

}  // namespace regrasp::grasp
