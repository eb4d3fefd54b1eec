#pragma once

namespace regrasp::sets {

/// How much a switching graph has of what takes memory while it is built; or the bytes that each of
/// these takes, with what vectors keep to grow into.
struct GraphSize {
  double candidates = 0;
  double sets = 0;
  double switches = 0;

  /// All bytes.
  [[nodiscard]] constexpr double Times(const GraphSize& bytes) const {
    return candidates * bytes.candidates + sets * bytes.sets + switches * bytes.switches;
  }
};

}  // namespace regrasp::sets
