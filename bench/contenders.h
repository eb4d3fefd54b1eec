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

/// Setting of a comparison of planners.
struct ContestSetting {
  double friction_angle = 0;  ///< friction angle, radians
  /// minimum quality of the drawn grasps, and of the sequences if there are any
  double min_quality = 0;
  /// Number of contacts of the drawn grasps: 4 in space; in the plane 2, or 2 or 3.
  int fewest_contacts = 0;
  int most_contacts = 0;
};

struct Answer {
  planning::PlanResult result;
  double seconds = 0;  ///< processor time, s
};

/// Planner that takes part in a comparison.
struct Contender {
  std::string planner;
  std::string absent;  ///< reason why the planner cannot be used here; empty if it can
  /// time to build data shared by all queries, s; 0 if each query builds its own
  double build_seconds = 0;
  std::function<Answer(const GraspPair& pair, std::uint64_t seed)> ask;
};

inline constexpr char kGeneral[] = "general";

/// Return all planners that support an object.
/// The planner general comes first, then its search alone: the first sequence, neither shortened
/// nor widened.
///
/// In space these are polyhedron and roadmap. The planner polyhedron uses a graph built once, for
/// solids with at most kMostGraphFaces faces, with uniform spanning up to kMostUniform and adaptive
/// spanning above. The planner roadmap chooses its own size. In the plane these are polygon, and
/// contour if all grasps have two contacts.
/// @param object  object, which must outlive the result.
[[nodiscard]] std::vector<Contender> MakeContenders(const object::Object& object,
                                                    const ContestSetting& setting);

inline constexpr int kMostGraphFaces = 50;
extern const double kMostUniform;  ///< friction angle, radians

}  // namespace regrasp
