#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/planning/planner.h"

namespace regrasp {

struct GraspPair {
  grasp::Grasp start;
  grasp::Grasp goal;
};

/// What planners are compared at.
struct ContestSetting {
  double half_angle = 0;   ///< friction, radians
  double min_quality = 0;  ///< of the grasps drawn, and of the sequences where there are any
  /// Contacts of the grasps drawn: in space 4; in the plane 2, or 2 or 3.
  int fewest_contacts = 0;
  int most_contacts = 0;
};

struct Answer {
  planning::PlanResult result;
  double seconds = 0;  ///< processor time
};

/// A planner that pairs of grasps are put to.
struct Contender {
  std::string planner;
  std::string absent;        ///< why it cannot be asked; empty where it can
  double build_seconds = 0;  ///< of what all queries share; 0 where each query builds its own
  std::function<Answer(const GraspPair& pair, std::uint64_t seed)> ask;
};

inline constexpr char kGeneral[] = "general";

/// Every planner that serves on an object, the planner general first, then its search alone: the
/// first sequence, neither shortened nor widened.
///
/// In space polyhedron, on a graph built once, of bodies of at most kMostGraphFaces faces, uniform
/// up to kMostUniform and adaptive above, and roadmap in the size that it chooses itself; in the
/// plane polygon, and contour where all grasps have two contacts.
/// @param object  outlives what is returned.
[[nodiscard]] std::vector<Contender> MakeContenders(const object::Object& object,
                                                    const ContestSetting& setting);

inline constexpr int kMostGraphFaces = 50;
extern const double kMostUniform;  ///< radians

}  // namespace regrasp
