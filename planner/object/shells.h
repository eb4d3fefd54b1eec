#pragma once

namespace regrasp::object {

/// What is made of several closed shells; without a choice they are refused, but for a solid and
/// its cavities.
enum class Shells {
  /// All solids that they bound are one rigid body, wherever they are: shells beside each other,
  /// and those inside others. What lies in the material of another is left out. None meets another.
  kUnion,
  /// The one of the largest volume, with its cavities; the others are left out, whatever they meet.
  kLargest,
};

}  // namespace regrasp::object
