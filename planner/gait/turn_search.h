#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/gait/gait_search.h"
#include "planner/gait/place_search.h"

namespace regrasp::gait {

/// Searches a turn that may begin at any angle: from rests at one pose onwards, and from those of
/// them that come farthest backwards, until the two ways with one of them make up the turn. What
/// lies between the end and the start of a whole turn is never passed, so that a posture or a side
/// of the object that the hand does not master need not be where it happens to begin.
class TurnSearch : public PlaceSearch {
 public:
  /// @param track    from a pose onwards.
  /// @param parking  for the way onwards, and the one backwards.
  /// @param memory   as in GaitSearch. setup, memory and random outlive this object.
  TurnSearch(const HandSetup& setup, const PoseTrack& track, Parking onwards, Parking backwards,
             criteria::GraspMemory& memory, RandomStream& random);
  TurnSearch(const TurnSearch&) = delete;
  TurnSearch& operator=(const TurnSearch&) = delete;

  [[nodiscard]] std::optional<Gait> Run(std::int64_t most_expanded,
                                        const Deadline& deadline) override;
  [[nodiscard]] bool IsExhausted() const override { return onwards_.IsExhausted(); }
  [[nodiscard]] GaitCounts counts() const override;

 private:
  /// Where the object was brought from a first rest in one direction.
  struct Reached {
    int farthest = 0;  ///< step
    /// By step and tilt: rests, and the node.
    std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> places;
  };
  /// A first rest, and what it leads to.
  struct Root {
    Reached onwards;
    Reached backwards;
    std::optional<GaitSearch> search;  ///< backwards
    [[nodiscard]] int farthest() const { return onwards.farthest + backwards.farthest; }
  };
  /// The first rest from which the object comes farthest and that can go on backwards; −1: none.
  [[nodiscard]] int BestRoot() const;
  GaitSearch& BackwardsFrom(int root);
  /// Takes down where a search's last rest brings the object, and looks for turns through it.
  std::optional<Gait> TakeDown(int root, bool is_onwards);
  /// @param onwards, backwards  rest and node.
  std::optional<Gait> Join(int root, std::pair<int, int> onwards, std::pair<int, int> backwards);

  const HandSetup& setup_;
  PoseGrid grid_;
  PoseGrid back_grid_;
  Parking parking_;
  Parking back_parking_;
  criteria::GraspMemory& memory_;
  RandomStream& random_;
  Carrier carrier_;
  Carrier back_carrier_;
  GaitSearch onwards_;
  std::map<int, Root> roots_;            ///< by rest
  std::set<std::pair<int, int>> tried_;  ///< of one root's rests onwards and backwards
};

}  // namespace regrasp::gait
