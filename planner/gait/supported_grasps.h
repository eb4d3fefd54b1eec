#pragma once

#include <boost/container_hash/hash.hpp>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/pose_grid.h"

namespace regrasp::gait {

/// Grasps of the setup's contacts that hold the object at grid nodes.
/// A grasp holds it if the memory admits it, at any pose, or if it is gravity-supported at the node
/// (plan::WeightCarrier). Results are cached.
class SupportedGrasps {
 public:
  /// All arguments outlive this object. Without HandSetup::carrier, only force closure counts.
  SupportedGrasps(const HandSetup& setup, const PoseGrid& grid, criteria::GraspMemory& memory)
      : setup_(setup), grid_(grid), memory_(memory) {}

  [[nodiscard]] bool Holds(const criteria::ContactSet& set, int node);
  /// Return whether the contacts of an assignment hold the object; true for fewer than three, which
  /// are part of an unfinished stance.
  [[nodiscard]] bool Holds(const ContactAssignment& assignment, int node);

 private:
  struct KeyHash {
    std::size_t operator()(const std::pair<criteria::ContactSet, int>& key) const {
      std::size_t hash = criteria::ContactSetHash()(key.first);
      boost::hash_combine(hash, key.second);
      return hash;
    }
  };

  const HandSetup& setup_;
  const PoseGrid& grid_;
  criteria::GraspMemory& memory_;
  std::unordered_map<std::pair<criteria::ContactSet, int>, bool, KeyHash> supported_;
};

}  // namespace regrasp::gait
