#include "planner/tree/tree_planner.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "planner/base/in_blocks.h"
#include "planner/base/memory.h"
#include "planner/base/number.h"
#include "planner/plan/check.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/tree/bidirectional_tree.h"
#include "planner/tree/face_align.h"
#include "planner/tree/improve_path.h"
#include "planner/tree/subset_search.h"

namespace regrasp::tree {

namespace {

bool SameContact(const grasp::Contact& a, const grasp::Contact& b) {
  return a.face == b.face && a.p == b.p && a.n == b.n;
}

/// Return the waypoints of a sliding step, with each finger at its own contacts.
std::vector<plan::FingerGrasp> WaypointsFor(const plan::FingerGrasp& holding,
                                            const FaceAlign& align, const SearchSpace& space) {
  const std::vector<grasp::Grasp> grasps = WaypointsOf(align, space);
  std::vector<plan::FingerGrasp> waypoints(grasps.size(), holding);
  for (std::size_t f = 0; f < holding.size(); ++f) {
    const auto same = std::find_if(
        grasps.front().begin(), grasps.front().end(),
        [&](const grasp::Contact& contact) { return SameContact(holding[f].contact, contact); });
    assert(same != grasps.front().end());
    const auto place = same - grasps.front().begin();
    for (std::size_t w = 0; w < grasps.size(); ++w) waypoints[w][f].contact = grasps[w][place];
  }
  return waypoints;
}

void AddAlign(const std::vector<plan::FingerGrasp>& waypoints,
              planning::CandidateSequence& candidate) {
  auto* last =
      candidate.steps.empty() ? nullptr : std::get_if<plan::Align>(&candidate.steps.back());
  const grasp::Grasp after = plan::ContactsOf(waypoints.back());
  if (last != nullptr) {
    last->waypoints.insert(last->waypoints.end(), waypoints.begin() + 1, waypoints.end());
    candidate.grasps.back().grasp = after;
    return;
  }
  candidate.steps.emplace_back(plan::Align{waypoints});
  candidate.grasps.push_back({after, std::nullopt});
}

/// Return the travel of a finger switch.
/// It is the sum, over the contacts of `from` that are not in `to`, of the distance to the nearest
/// new contact.
double TravelOfSwitch(const criteria::ContactSet& from, const criteria::ContactSet& to,
                      const SearchSpace& space) {
  double travel = 0;
  for (const int placed : to) {
    if (from.Has(placed)) continue;
    double nearest = -1;
    for (const int left : from) {
      if (to.Has(left)) continue;
      const double distance = (space.contact(left).p - space.contact(placed).p).norm();
      if (nearest < 0 || distance < nearest) nearest = distance;
    }
    travel += std::max(nearest, 0.0);
  }
  return travel;
}

}  // namespace

planning::CandidateSequence MakeCandidate(const GraspPath& path, const grasp::Grasp& start,
                                          const SearchSpace& space) {
  planning::CandidateSequence candidate = planning::StartOf(start);
  plan::FingerGrasp holding = candidate.initial;
  for (const PathStep& step : path.steps) {
    if (step.align) {
      const std::vector<plan::FingerGrasp> waypoints = WaypointsFor(holding, *step.align, space);
      AddAlign(waypoints, candidate);
      holding = waypoints.back();
      continue;
    }
    const plan::Switch change =
        planning::MakeSwitch(holding, space.GraspOf(step.to), space.fingers());
    holding = plan::GraspAfter(holding, change);
    candidate.steps.emplace_back(change);
    candidate.grasps.push_back({plan::ContactsOf(holding), std::nullopt});
  }
  return candidate;
}

double TravelOf(const GraspPath& path, const SearchSpace& space) {
  double travel = 0;
  const criteria::ContactSet* before = &path.start;
  for (const PathStep& step : path.steps) {
    travel += step.align ? TravelOf(*step.align, space) : TravelOfSwitch(*before, step.to, space);
    before = &step.to;
  }
  return travel;
}

namespace {

using Status = planning::PlanResult::Status;

/// Shares of the criteria for further searches if the repair of the first sequence fails. Their
/// grasps meet the share from the beginning. Each search has this part of the search budget.
constexpr std::array kShares = {0.6, 1.0};
constexpr int kShareBudgetShare = 4;

/// Number of bisection steps for the friction angle at which a sequence is found, and the largest
/// such angle, radians.
constexpr int kExplainSteps = 8;
const double kLargestExplained = Radians(85);

/// Divisor of the search budget for each search of --explain, relative to the search that found
/// nothing.
constexpr int kExplainBudgetShare = 4;

/// State of the planning of one sequence, shared by its stages.
class TreeSearch {
 public:
  explicit TreeSearch(const planning::PlanRequest& request)
      : request_(request),
        object_(*request.object),
        friction_angle_(request.criteria.friction_angle),
        parameters_(request.parameters.Get<planning::SearchParameters>()),
        most_tests_(parameters_.budget.value_or(TreePlanner::kDefaultTests)),
        evaluator_(object_, request.criteria, request.hand),
        source_(object_, request.hand.fingertip_radius),
        random_(request.seed, RandomUse::kCandidates) {}

  planning::PlanResult Plan(const std::string& name) {
    const grasp::Grasp& from = request_.start.grasp;
    const grasp::Grasp& to = request_.goal.grasp;
    SearchSpace wide =
        MakeSpace(friction_angle_, 0, most_tests_, "growing trees of grasps from start and goal");
    const auto found = Search(from, to, wide);
    if (!found) return NoSequence(from, to);
    // Only the contacts of the path, because the search may have added thousands.
    SearchSpace space = MakeSpace(friction_angle_, 1, most_tests_, "improving the sequence");
    GraspPath path = MakeGood(Renumber(*found, wide, space), from, to, space);
    std::vector<std::string> notes = Improve(path, from, space);
    planning::PlanResult result =
        planning::ResultOf(MakeCandidate(path, from, space), evaluator_, name, request_, to);
    result.notes = std::move(notes);
    return result;
  }

 private:
  /// Extent of a search that found nothing.
  struct Reach {
    std::array<int, 2> grasps{};
    std::array<int, 2> tuples{};
    std::int64_t tests = 0;
    bool out_of_time = false;
  };

  /// Make a search space.
  /// @param share  required share of the criteria.
  /// @param what   name of the activity for progress messages.
  SearchSpace MakeSpace(double friction_angle, double share, std::int64_t most_tests,
                        const std::string& what) const {
    criteria::GraspCriteria criteria = request_.criteria;
    criteria.friction_angle = friction_angle;
    SearchSpace space(object_, criteria, request_.hand);
    space.SetShare(share);
    CountedProgress progress(request_.progress, what + ", tests", most_tests);
    space.SetLimits({most_tests, request_.deadline,
                     [progress](std::int64_t tests) mutable { progress.Reach(tests); }});
    return space;
  }

  /// Return the path of the first stage that finds one.
  std::optional<GraspPath> Search(const grasp::Grasp& from, const grasp::Grasp& to,
                                  SearchSpace& space) {
    const criteria::ContactSet start = space.Add(from);
    const criteria::ContactSet goal = space.Add(to);
    if (start == goal) return GraspPath{start, {}};
    space.Accept(start);
    space.Accept(goal);
    if (auto path = SearchOwnSubsets(start, goal, space)) return path;
    BidirectionalTree trees(start, goal, source_, random_, space);
    auto path = trees.Join();
    for (int side = 0; side < 2; ++side) {
      reach_.grasps[side] = trees.tree(side).size();
      reach_.tuples[side] = trees.tree(side).tuple_count();
    }
    reach_.tests = space.tests();
    reach_.out_of_time = space.out_of_time();
    return path;
  }

  /// Return the path, or another whose grasps all meet the criteria.
  /// If none is found, the result is the path with the best weakest grasp, and the requirements are
  /// reduced to what it meets.
  GraspPath MakeGood(GraspPath path, const grasp::Grasp& from, const grasp::Grasp& to,
                     SearchSpace& space) {
    if (AreAdmitted(path, space)) return path;
    if (auto own = SearchOwnSubsets(path.start, path.end(), space)) return *std::move(own);
    const std::string asked = criteria::WithWhatIsAsked(request_.criteria);
    request_.progress("searching for grasps" + asked);
    double best = Repair(path, space);
    for (const double share : kShares) {
      if (best == 1) return path;
      SearchSpace wide = MakeSpace(friction_angle_, share, most_tests_ / kShareBudgetShare,
                                   "searching for grasps" + asked);
      const auto found = Search(from, to, wide);
      // A search that fails with lower requirements also fails with higher ones.
      if (!found) break;
      GraspPath other = Renumber(*found, wide, space);
      if (AreAdmitted(other, space)) return other;
      const double reached = Repair(other, space);
      if (reached <= best) continue;
      best = reached;
      path = std::move(other);
    }
    space.SetShare(best);
    return path;
  }

  /// Repair the weakest grasps of a path.
  /// @returns the share of the criteria that all grasps of the result meet.
  double Repair(GraspPath& path, SearchSpace& space) {
    space.SetShare(0);
    path = ShortcutPath(std::move(path), source_, random_, space);
    path = MaximiseMargin(std::move(path), kMoreSteps, source_, random_, space);
    space.SetShare(1);
    return RepairQuality(source_, random_, space, path);
  }

  /// Return whether the space admits all grasps and sliding steps between the ends.
  [[nodiscard]] static bool AreAdmitted(const GraspPath& path, SearchSpace& space) {
    return std::all_of(path.steps.begin(), path.steps.end(), [&](const PathStep& step) {
      return (step.to == path.end() || space.Admits(step.to)) &&
             (!step.align || AdmitsPath(*step.align, space));
    });
  }

  /// Shorten the path and improve the objective.
  /// @returns notes on the improvement.
  std::vector<std::string> Improve(GraspPath& path, const grasp::Grasp& from, SearchSpace& space) {
    const std::string before = Achieved(path, from, space);
    path = ShortcutPath(std::move(path), source_, random_, space);
    if (request_.objective == planning::Objective::kTravel) {
      path = MinimiseTravel(std::move(path), source_, random_, space);
    } else {
      const int more = request_.objective == planning::Objective::kMargin ? kMoreSteps : 0;
      path = MaximiseMargin(std::move(path), more, source_, random_, space);
    }
    if (before.empty()) return {};
    return {"the first sequence has " + before + ", the improved one " +
            Achieved(path, from, space)};
  }

  /// Describe the value of the objective, including sliding steps.
  /// Empty for the number of steps, which is obvious from the plan.
  [[nodiscard]] std::string Achieved(const GraspPath& path, const grasp::Grasp& from,
                                     const SearchSpace& space) const {
    switch (request_.objective) {
      case planning::Objective::kTravel:
        return "a total finger travel of " +
               FormatShort(TravelOf(path, space) / object_.diameter()) + " diameters";
      case planning::Objective::kMargin:
        return "a friction margin of " +
               FormatFixed(Degrees(friction_angle_ - Needed(path, from, space)), 2) + "°";
      default:
        return "";
    }
  }

  /// Return the required friction angle of a sequence by the analytic check, radians.
  [[nodiscard]] double Needed(const GraspPath& path, const grasp::Grasp& from,
                              const SearchSpace& space) const {
    planning::CandidateSequence candidate = MakeCandidate(path, from, space);
    plan::Plan plan;
    plan.dimension = object_.dimension();
    plan.friction_angle = friction_angle_;
    plan.fingers = request_.hand.fingers;
    plan.torsion = request_.hand.torsion;
    plan.goal = candidate.grasps.back().grasp;
    plan.initial = std::move(candidate.initial);
    plan.steps = std::move(candidate.steps);
    const plan::PlanCheck check = plan::CheckPlan(object_, plan);
    const plan::EntryIndex weakest = plan::WeakestStep(check.steps);
    return weakest.valid() ? check.steps[weakest].required->upper : friction_angle_;
  }

  planning::PlanResult NoSequence(const grasp::Grasp& from, const grasp::Grasp& to) {
    planning::PlanResult result;
    result.status = Status::kNoSequence;
    const auto reached = [&](int side) {
      return std::to_string(reach_.grasps[side]) + " grasps on " +
             std::to_string(reach_.tuples[side]) + " tuples of faces";
    };
    result.message = "planner general explored " + reached(0) + " from the start and " +
                     reached(1) + " from the goal in " + std::to_string(reach_.tests) + " tests" +
                     (reach_.out_of_time ? "; time limit reached" : "") +
                     "; this does not prove infeasibility" +
                     (parameters_.explain ? ""
                                          : "; help: --explain searches for the smallest friction "
                                            "that is sufficient");
    if (parameters_.explain) result.message += Explain(from, to);
    return result;
  }

  /// Report the smallest friction angle at which a sequence is found.
  std::string Explain(const grasp::Grasp& from, const grasp::Grasp& to) {
    double none = friction_angle_;
    double some = kLargestExplained;
    const auto finds = [&](double friction_angle) {
      SearchSpace space =
          MakeSpace(friction_angle, 0, most_tests_ / kExplainBudgetShare,
                    "searching for a sequence at " + FormatShort(Degrees(friction_angle)) + "°");
      return Search(from, to, space).has_value();
    };
    if (!finds(some))
      return "; none found at a friction angle of " + FormatShort(Degrees(some)) + "° either";
    for (int i = 0; i < kExplainSteps; ++i) {
      const double middle = (none + some) / 2;
      (finds(middle) ? some : none) = middle;
    }
    return "; a sequence is found at a friction angle of " + FormatShort(Degrees(some)) +
           "°, an upper bound on the required one";
  }

  const planning::PlanRequest& request_;
  const object::Object& object_;
  double friction_angle_;  ///< friction angle of the request's criteria
  planning::SearchParameters parameters_;
  std::int64_t most_tests_;
  criteria::GraspEvaluator evaluator_;
  sampling::SurfaceSampler source_;
  RandomStream random_;
  Reach reach_;
};

}  // namespace

TreePlanner::TreePlanner()
    : planning::Planner(
          {.name = "general",
           .what = "any force-closure grasps, on any object",
           .in_plane =
               planning::PlannerScope{hand::kFingersInPlane, {2, hand::kFingersInPlane}, {2, 3}},
           .in_space =
               planning::PlannerScope{hand::kFingersInSpace, {3, hand::kFingersInSpace}, {4, 4}},
           .options = {planning::kMarginOption, planning::kTravelOption, planning::kBudgetOption,
                       planning::kExplainOption, planning::kSoftFingersOption},
           .has_graph = false}) {}

planning::PlanResult TreePlanner::Plan(const planning::PlanRequest& request) const {
  return TreeSearch(request).Plan(name());
}

}  // namespace regrasp::tree
