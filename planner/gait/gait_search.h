#pragma once

#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/finger_path.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_setup.h"
#include "planner/gait/pose_track.h"
#include "planner/gait/reach_map.h"

namespace regrasp::gait {

/// What a search did, and what stopped it.
struct GaitCounts {
  std::int64_t grasps = 0;     ///< rests that were looked at
  std::int64_t expanded = 0;   ///< from which fingers were switched
  std::int64_t no_path = 0;    ///< switches for which a finger found no free path
  std::int64_t no_move = 0;    ///< moves that a finger could not follow, or that hit something
  std::int64_t colliding = 0;  ///< grasps in which fingers hit each other
  int farthest = 0;            ///< step of the track that was reached
};

/// Searches a gait that takes an object along a track of poses: rests are grasps of three or more
/// fingers; from each the object goes as far as these can follow, somewhere on that stretch a free
/// finger is placed and another one lifted.
///
/// Best first: rests from which the object gets farthest, and from which each single finger could
/// go on farther, come first; the more of them were expanded that end at one step, the later others
/// come that end there, so that a dead end does not hold the search up. What is costly, paths of
/// fingers and the certificate of moves, is worked out when a rest's turn comes.
class GaitSearch {
 public:
  /// @param memory   knows the setup's points as contacts under their numbers.
  /// @param parking  where free fingers are. All outlive this object.
  GaitSearch(const HandSetup& setup, const PoseTrack& track, const Parking& parking,
             criteria::GraspMemory& memory, RandomStream& random);

  /// Goes on until so many rests were expanded in all calls together.
  /// @returns nullopt where none was found until then, or until the deadline.
  [[nodiscard]] std::optional<Gait> Run(int most_expanded, const Deadline& deadline);
  /// Whether nothing is left to expand.
  [[nodiscard]] bool IsExhausted() const { return begun_ && queue_.empty(); }

  [[nodiscard]] const GaitCounts& counts() const { return counts_; }

 private:
  /// A grasp, and the stretch of the track along which it holds.
  struct Rest {
    Holding holding;
    int step = 0;   ///< at which it was taken
    int first = 0;  ///< of the stretch
    int last = 0;
    double score = 0;
    int parent = -1;
    FingerIndex placed = {}, released = {};
    /// Worked out when its turn comes: from the parent's rest to this one.
    std::vector<Stretch> way = {};
    /// Moves from `step` on that were worked out, by where they lead; empty ones can't be done.
    std::map<int, std::vector<Keyframe>> moves = {};
    Keyframe at = {};  ///< at `step`
  };
  struct Waiting {
    double score;
    int rest;
    bool operator<(const Waiting& other) const {
      return score != other.score ? score < other.score : rest > other.rest;
    }
  };
  /// A contact that a finger reaches at a step, and how far it can keep it.
  struct Candidate {
    int point;
    int last;
  };

  void AddFirstRests();
  void Expand(int index);
  void SwitchAt(int index, int step);
  /// Takes a rest up if it is admitted and new. @returns whether.
  bool Add(Rest rest);
  [[nodiscard]] bool IsGrasp(const Holding& holding);
  [[nodiscard]] bool FindStretch(Rest& rest);
  [[nodiscard]] bool FingersKeepApart(const Holding& holding, int step);
  [[nodiscard]] Keyframe FrameAt(const Holding& holding, int step);
  [[nodiscard]] bool WorkOutWay(Rest& rest);
  /// The next rest in turn.
  [[nodiscard]] int PopNext();
  /// The move with a rest's grasp to a step; empty where it can't be done.
  [[nodiscard]] const std::vector<Keyframe>& MoveFrom(Rest& rest, int step);
  [[nodiscard]] bool Place(Rest& rest, const Keyframe& before, Keyframe& after);
  [[nodiscard]] bool Release(const Rest& rest, const Keyframe& before, std::vector<Stretch>& way);
  [[nodiscard]] Surroundings Around(const Keyframe& frame, FingerIndex moving) const;
  [[nodiscard]] const std::vector<Candidate>& CandidatesAt(FingerIndex finger, int step);
  [[nodiscard]] double ScoreOf(const Rest& rest);
  [[nodiscard]] Gait GaitTo(int index, std::vector<Keyframe> last_move) const;

  const HandSetup& setup_;
  const PoseTrack& track_;
  const Parking& parking_;
  criteria::GraspMemory& memory_;
  RandomStream& random_;
  ReachMap reach_;
  std::vector<Rest> rests_;
  std::priority_queue<Waiting> queue_;
  std::set<std::pair<Holding, int>> known_;
  std::map<std::pair<int, int>, std::vector<Candidate>> candidates_;
  std::vector<int> expanded_at_;  ///< rests, by the step that they end at
  GaitCounts counts_;
  bool begun_ = false;
};

}  // namespace regrasp::gait
