#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/contenders.h"

namespace regrasp {

struct ContestLimits {
  int pairs = 0;
  /// Processor time of one planner on one setting, and of drawing the grasps, s. After it no
  /// further pair is started.
  double seconds = 0;
};

/// Result of a planner for one pair.
struct PairAnswer {
  bool joined = false;
  double seconds = 0;
  /// Number of steps of the plan.
  int steps = 0;
  int aligns = 0;
  double margin = 0;  ///< friction margin of the weakest grasp, radians
  double travel = 0;  ///< fingertip travel, in diameters of the object
  bool good = false;  ///< true without warning: all grasps have the required quality
};

struct Standing {
  std::string planner;
  std::string absent;  ///< reason why the planner was not run
  double build_seconds = 0;
  std::vector<PairAnswer> answers;  ///< answers by pair; fewer than the pairs if time ran out

  [[nodiscard]] int joined_count() const { return JoinedOf(answers.size()); }
  /// Return the number of solved queries among the first `pairs`.
  [[nodiscard]] int JoinedOf(std::size_t pairs) const;
};

struct Contest {
  int pairs = 0;  ///< number of drawn pairs
  std::vector<Standing> standings;
};

/// Draw pairs of random force-closure grasps, uniformly over the surface, until the limit of pairs
/// or of time is reached.
[[nodiscard]] std::vector<GraspPair> DrawPairs(const object::Object& object,
                                               const ContestSetting& setting,
                                               const ContestLimits& limits);

/// Run all contenders on the same pairs. Pair i has the seed i.
[[nodiscard]] Contest RunContest(const object::Object& object, const std::vector<GraspPair>& pairs,
                                 const std::vector<Contender>& contenders, double seconds);

/// Return the first planner that solves more pairs than general, among the pairs that both were run
/// on.
[[nodiscard]] std::optional<std::string> FindBetterThanGeneral(const Contest& contest);

}  // namespace regrasp
