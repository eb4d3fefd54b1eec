#pragma once

#include <cstddef>
#include <vector>

#include "planner/object/surface_walk.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

/// Ways of fingers along the surface that begin and end together, as waypoints of an align: between
/// two waypoints every finger moves on one face, or turns its normal at a point of a border.
class FingerWays {
 public:
  /// @param held  the finger, with all that is said of its contact but where it is.
  /// @param legs  at least one, each beginning where the one before it ends. Each takes its share
  ///              of the time by its length.
  void Add(const plan::FingerContact& held, const std::vector<object::SurfaceLeg>& legs);

  /// Adds waypoints: one where a finger comes to a border, one where it has turned there, and the
  /// end; none that is like the one before it.
  void AppendTo(const object::Object& object, std::vector<plan::FingerGrasp>& waypoints) const;

 private:
  struct Way {
    plan::FingerContact held;
    std::vector<object::SurfaceLeg> legs;
    std::vector<double> ends;  ///< of the legs, in [0, 1]
  };

  std::vector<Way> ways_;
};

}  // namespace regrasp::sim
