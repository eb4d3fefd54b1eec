#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/contenders.h"

namespace regrasp {

struct ContestLimits {
  int pairs = 0;
  /// Processor time of one planner on one setting, and of drawing the grasps, after which no
  /// further pair is asked for.
  double seconds = 0;
};

/// What a planner made of one pair.
struct PairAnswer {
  bool joined = false;
  double seconds = 0;
  /// Of a plan.
  int steps = 0;
  int aligns = 0;
  double margin = 0;  ///< of the weakest grasp, radians
  double travel = 0;  ///< over the object's diameter
  bool good = false;  ///< no warning: all grasps have the quality that was asked for
};

struct Standing {
  std::string planner;
  std::string absent;  ///< why it was not asked
  double build_seconds = 0;
  std::vector<PairAnswer> answers;  ///< by pair; fewer than there are where time was short

  [[nodiscard]] int joined_count() const { return JoinedOf(answers.size()); }
  /// Of the first `pairs`.
  [[nodiscard]] int JoinedOf(std::size_t pairs) const;
};

struct Contest {
  int pairs = 0;  ///< drawn
  std::vector<Standing> standings;
};

/// Random force-closure grasps, evenly over the surface: as many pairs as there are and time
/// allows.
[[nodiscard]] std::vector<GraspPair> DrawPairs(const object::Object& object,
                                               const ContestSetting& setting,
                                               const ContestLimits& limits);

/// Puts the same pairs to contenders. Pair i has the seed i.
[[nodiscard]] Contest RunContest(const object::Object& object, const std::vector<GraspPair>& pairs,
                                 const std::vector<Contender>& contenders, double seconds);

/// The first planner that joins more pairs than general, of those that both were asked.
[[nodiscard]] std::optional<std::string> FindBetterThanGeneral(const Contest& contest);

}  // namespace regrasp
