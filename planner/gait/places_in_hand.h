#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/gait.h"
#include "planner/gait/gait_search.h"
#include "planner/gait/hand_setup.h"
#include "planner/gait/journey.h"
#include "planner/gait/place_search.h"

namespace regrasp::gait {

/// What gaits from a place are searched with.
struct SearchTerms {
  const HandSetup& setup;
  criteria::GraspMemory& memory;  ///< knows the setup's points as contacts under their numbers
  CarryOut carry_out = {};        ///< none: what is planned counts
};

/// All places in the hand to begin in that are tried, the best first, and more the longer it takes;
/// those where the object comes farther have more turns.
class PlacesInHand {
 public:
  /// @param request  outlives this object.
  /// @param terms    which places have by turns; one or more.
  PlacesInHand(const GaitRequest& request, std::vector<SearchTerms> terms, GaitEnds ends);

  /// @returns the first gait that is found, with fewer moves; nullopt where the request's bounds
  ///          are reached, or nothing is left to search.
  [[nodiscard]] std::optional<Gait> Search();

  /// By place.
  [[nodiscard]] std::vector<GaitCounts> counts() const;

 private:
  struct Place {
    const SearchTerms& terms;
    RandomStream random;
    std::unique_ptr<PlaceSearch> search = nullptr;
  };
  /// Grasps from all places together, before there is another one.
  [[nodiscard]] std::int64_t EnoughForNext() const;
  /// Null where all places are exhausted.
  Place* Next();
  /// @returns whether there is another place.
  bool Open();
  /// Null where a finger has no place to wait.
  std::unique_ptr<PlaceSearch> SearchAlong(const PoseTrack& track, const SearchTerms& terms,
                                           RandomStream& random);
  /// @returns false where there are no more.
  bool DrawHomes();

  const GaitRequest& request_;
  std::vector<SearchTerms> terms_;
  GaitEnds ends_;
  RandomStream random_;
  Journey journey_;
  std::vector<Eigen::Isometry3d> homes_;  ///< that were not tried yet, the best last
  int drawings_ = 0;
  std::size_t opened_ = 0;  ///< homes that were tried
  std::vector<std::unique_ptr<Place>> places_;
  std::int64_t expanded_ = 0;  ///< from all places
};

}  // namespace regrasp::gait
