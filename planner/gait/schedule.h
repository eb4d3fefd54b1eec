#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/gait.h"
#include "planner/gait/gait_search.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/joined_search.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/request.h"

namespace regrasp::gait {

/// What gaits from a place are searched with.
struct SearchTerms {
  const HandSetup& setup;
  criteria::GraspMemory& memory;     ///< knows the setup's points as contacts under their numbers
  SimulateExecution carry_out = {};  ///< none: what is planned counts
};

/// All places in the hand to begin in that are tried, the best first, and more the longer it takes;
/// those where the object comes farther have more turns.
class MultiStartSearch {
 public:
  /// @param request  outlives this object.
  /// @param terms    which places have by turns; one or more.
  MultiStartSearch(const GaitRequest& request, std::vector<SearchTerms> terms, GaitEnds ends);

  /// @returns the first gait that is found, with fewer moves; nullopt where the request's bounds
  ///          are reached, or nothing is left to search.
  [[nodiscard]] std::optional<Gait> Search();

  /// By place.
  [[nodiscard]] std::vector<GaitCounts> counts() const;

 private:
  struct Place {
    const SearchTerms& terms;
    RandomStream random;
    std::unique_ptr<StartSearch> search = nullptr;
  };
  /// Grasps from all places together, before there is another one.
  [[nodiscard]] std::int64_t BudgetForNextStart() const;
  /// Null where all places are exhausted.
  Place* Next();
  /// @returns whether there is another place.
  bool Open();
  /// Null where a finger has no place to wait.
  std::unique_ptr<StartSearch> SearchAlong(const PoseTrack& track, const SearchTerms& terms,
                                           RandomStream& random);
  /// @returns false where there are no more.
  bool DrawInitialPoses();

  const GaitRequest& request_;
  std::vector<SearchTerms> terms_;
  GaitEnds ends_;
  RandomStream random_;
  ObjectTask task_;
  std::vector<Eigen::Isometry3d> initial_poses_;  ///< that were not tried yet, the best last
  int drawings_ = 0;
  std::size_t opened_ = 0;  ///< homes that were tried
  std::vector<std::unique_ptr<Place>> places_;
  std::int64_t expanded_ = 0;  ///< from all places
};

/// What gaits with reserve have to spare. None of their fingers slides.
struct RobustnessMargins {
  double quality = 0;    ///< of their grasps
  double clearance = 0;  ///< of links, beside the margin, metres
  /// As HandSetup has it, where contacts have rolled to. None: contacts are not followed, which is
  /// reserve only where the hand carries a gait out.
  std::optional<double> force_margin = {};
};

struct FoundGait {
  std::optional<Gait> gait;
  std::string message;  ///< where there is none
};
/// Looks for a gait with one of some spares, from each place in the hand with the next of them;
/// without reserve where there are none. What is to have a spare is tried on the way where the
/// hand can try plans.
using FindOne =
    std::function<FoundGait(const GaitRequest& asked, std::span<const RobustnessMargins> margins)>;

/// Looks for gaits with reserve where nothing tells whether the hand carries them out: first with
/// more and then with less to spare. One much longer than the one without does not count.
/// @param without  the one without reserve, where the request allows it and there is one.
/// @returns the first that there is, or the one without; where there is none, why.
[[nodiscard]] FoundGait FindRobustGait(const GaitRequest& request, const FindOne& find,
                                       const FoundGait& without);

/// A gait, and how far the hand carries it out, or the one that came farthest of those that are not
/// given because it does not; nullopt: nothing tells, or none was tried.
struct SimulatedGait {
  FoundGait found;
  std::optional<planning::CarriedOut> trial = {};
};

/// Where and why a plan of so many steps is not carried out.
[[nodiscard]] std::string FailureText(const planning::CarriedOut& carried, std::size_t steps);

/// Looks for gaits with reserve until the hand carries one out (planning::InHandTask::carry_out),
/// with more or less to spare by turns, and again, as each time draws others; where there is none,
/// for one without. Where the hand can't tell, as if it were not asked. Where the request seeks the
/// most to spare, it goes on all the same, and the gait with most is taken, the first of equal
/// ones.
/// @param contacts  of gaits, by their numbers.
/// @returns no gait that is not carried out where the request's reserve is required.
[[nodiscard]] SimulatedGait FindExecutableGait(const GaitRequest& request,
                                               const std::vector<grasp::Contact>& contacts,
                                               const FindOne& find);

}  // namespace regrasp::gait
