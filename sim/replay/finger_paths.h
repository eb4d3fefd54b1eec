#pragma once

#include <cstddef>
#include <vector>

#include "planner/object/surface_walk.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

/// Paths of fingers along the surface that begin and end together, as waypoints of a sliding step.
/// Between two waypoints every finger moves on one face, or turns its normal at a point of a
/// border.
class FingerPaths {
 public:
  /// @param held  finger and its contact; the point of the contact is ignored.
  /// @param legs  consecutive legs of the path, at least one. The time of each leg is proportional
  ///     to its length.
  void Add(const plan::FingerContact& held, const std::vector<object::SurfaceLeg>& legs);

  /// Add the waypoints of all paths.
  /// There is one when a finger reaches a border, one after it turned there, and the end. A
  /// waypoint that equals its predecessor is omitted.
  void AppendTo(const object::Object& object, std::vector<plan::FingerGrasp>& waypoints) const;

 private:
  struct Way {
    plan::FingerContact held;
    std::vector<object::SurfaceLeg> legs;
    std::vector<double> ends;  ///< end times of the legs, in [0, 1]
  };

  std::vector<Way> paths_;
};

}  // namespace regrasp::sim
