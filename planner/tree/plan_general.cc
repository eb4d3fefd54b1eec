#include "planner/tree/plan_general.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "planner/planning/plan_search.h"
#include "planner/sampling/draw_grasp.h"
#include "planner/tree/bidirectional_tree.h"
#include "planner/tree/face_align.h"
#include "planner/tree/improve_path.h"
#include "planner/tree/path_plan.h"
#include "planner/tree/repair_quality.h"
#include "planner/tree/subset_search.h"

namespace regrasp {

namespace {

using Kind = GraspChoice::Kind;
using Status = PlanResult::Status;

/// Of a random grasp.
constexpr ContactLimits kSpatialContacts = {4, 4};
constexpr ContactLimits kPlanarContacts = {2, 3};

/// Where the first sequence can't be mended to the quality that is asked for, others are looked for
/// whose grasps have these shares of it from the beginning, each with this part of the effort.
constexpr std::array kQualityShares = {0.6, 1.0};
constexpr int kQualityEffortShare = 4;

/// Bisections of the friction at which a sequence is found, and the largest that is tried, radians.
constexpr int kExplainSteps = 8;
const double kLargestExplained = Radians(85);

/// The effort of one search of --explain over that of the search that found nothing.
constexpr int kExplainEffortShare = 4;

int FingersOf(const Object& object) { return object.dimension() == 3 ? 5 : 4; }

class Planner {
 public:
  Planner(const Object& object, const GeneralPlanOptions& options)
      : object_(object),
        options_(options),
        evaluator_(object, {options.half_angle, options.min_quality},
                   {.fingertip_radius = options.finger_radius}),
        source_(object, options.finger_radius),
        random_(options.seed, RandomUse::kCandidates) {}

  PlanResult Plan(const GraspChoice& start, const GraspChoice& goal) {
    const Grasp from = ResolveGrasp(object_, start, RandomUse::kStart, options_).grasp;
    const Grasp to = ResolveGrasp(object_, goal, RandomUse::kGoal, options_).grasp;
    SearchSpace wide = MakeSpace(options_.half_angle, 0, options_.effort);
    const auto found = Search(from, to, wide);
    if (!found) return NoSequence(from, to);
    // The contacts of the path alone: the search may have come across thousands.
    SearchSpace space = MakeSpace(options_.half_angle, options_.min_quality, options_.effort);
    GraspPath path = MakeGood(Renumber(*found, wide, space), from, to, space);
    std::vector<std::string> notes = Improve(path, space);
    PlanResult result =
        ResultOf(MakeCandidate(path, from, space), evaluator_, "general", fingers_, to);
    result.notes = std::move(notes);
    return result;
  }

 private:
  /// What a search that found nothing came to.
  struct Reach {
    std::array<int, 2> grasps{};
    std::array<int, 2> tuples{};
    std::int64_t tests = 0;
    bool out_of_time = false;
  };

  SearchSpace MakeSpace(double half_angle, double min_quality, std::int64_t effort) const {
    SearchSpace space(object_, {half_angle, min_quality},
                      {.fingertip_radius = options_.finger_radius});
    space.SetLimits({effort, options_.deadline});
    return space;
  }

  /// The path of the first stage that finds one.
  std::optional<GraspPath> Search(const Grasp& from, const Grasp& to, SearchSpace& space) {
    const ContactSet start = space.Add(from);
    const ContactSet goal = space.Add(to);
    if (start == goal) return GraspPath{start, {}};
    space.Accept(start);
    space.Accept(goal);
    if (auto path = SearchOwnSubsets(start, goal, space)) return path;
    options_.progress("growing trees of grasps from start and goal");
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

  /// The path, or one whose grasps all have the quality that is asked for; where none is found, one
  /// whose weakest grasp is as good as could be reached, and no more is then asked for.
  GraspPath MakeGood(GraspPath path, const Grasp& from, const Grasp& to, SearchSpace& space) {
    if (AreAdmitted(path, space)) return path;
    if (auto own = SearchOwnSubsets(path.start, path.end(), space)) return *std::move(own);
    options_.progress("looking for grasps of a quality of " + FormatShort(options_.min_quality));
    double best = Repair(path, space);
    for (const double share : kQualityShares) {
      if (best == options_.min_quality) return path;
      SearchSpace wide = MakeSpace(options_.half_angle, share * options_.min_quality,
                                   options_.effort / kQualityEffortShare);
      const auto found = Search(from, to, wide);
      // What is not found with less asked for is not going to be found with more.
      if (!found) break;
      GraspPath other = Renumber(*found, wide, space);
      if (AreAdmitted(other, space)) return other;
      const double reached = Repair(other, space);
      if (reached <= best) continue;
      best = reached;
      path = std::move(other);
    }
    space.SetMinQuality(best);
    return path;
  }

  /// @returns the quality that all grasps of the path have then.
  double Repair(GraspPath& path, SearchSpace& space) {
    space.SetMinQuality(0);
    path = ShortcutPath(std::move(path), source_, random_, space);
    path = MaximiseMargin(std::move(path), kMoreSteps, source_, random_, space);
    space.SetMinQuality(options_.min_quality);
    return RepairQuality(source_, random_, space, path);
  }

  /// Whether the space admits what lies between the ends.
  [[nodiscard]] static bool AreAdmitted(const GraspPath& path, SearchSpace& space) {
    return std::all_of(path.steps.begin(), path.steps.end(), [&](const PathStep& step) {
      return (step.to == path.end() || space.Admits(step.to)) &&
             (!step.align || AdmitsPath(*step.align, space));
    });
  }

  /// @returns what was gained.
  std::vector<std::string> Improve(GraspPath& path, SearchSpace& space) {
    options_.progress("shortening and widening the sequence");
    std::vector<std::string> notes;
    const auto note = [&](const std::string& what, double before, double after,
                          const std::string& unit) {
      notes.push_back(what + ": " + FormatShort(before) + unit + " at first, " +
                      FormatShort(after) + unit + " now");
    };
    const auto steps = static_cast<double>(path.steps.size());
    const double margin = options_.half_angle - RequiredHalfAngleOf(path, space);
    const double travel = TravelOf(path, space);
    path = ShortcutPath(std::move(path), source_, random_, space);
    if (options_.aim == Objective::kTravel) {
      path = MinimiseTravel(std::move(path), source_, random_, space);
    } else {
      const int more = options_.aim == Objective::kMargin ? kMoreSteps : 0;
      path = MaximiseMargin(std::move(path), more, source_, random_, space);
    }
    note("steps", steps, static_cast<double>(path.steps.size()), "");
    note("margin of the weakest grasp", Degrees(margin),
         Degrees(options_.half_angle - RequiredHalfAngleOf(path, space)), "°");
    note("way of all fingers together", travel, TravelOf(path, space), "");
    return notes;
  }

  PlanResult NoSequence(const Grasp& from, const Grasp& to) {
    PlanResult result;
    result.status = Status::kNoSequence;
    const auto reached = [&](int side) {
      return std::to_string(reach_.grasps[side]) + " grasps on " +
             std::to_string(reach_.tuples[side]) + " tuples of faces";
    };
    result.message = std::string("no sequence was found by the planner general (which proves ") +
                     "nothing): " + reached(0) + " were reached from the start, " + reached(1) +
                     " from the goal, in " + std::to_string(reach_.tests) + " tests" +
                     (reach_.out_of_time ? ", when the time was up" : "");
    if (options_.explain) result.message += Explain(from, to);
    return result;
  }

  /// The smallest half-angle at which a sequence is found.
  std::string Explain(const Grasp& from, const Grasp& to) {
    double none = options_.half_angle;
    double some = kLargestExplained;
    const auto finds = [&](double half_angle) {
      options_.progress("looking for a sequence at " + FormatShort(Degrees(half_angle)) + "°");
      SearchSpace space = MakeSpace(half_angle, 0, options_.effort / kExplainEffortShare);
      return Search(from, to, space).has_value();
    };
    if (!finds(some)) return "; nor was one at " + FormatShort(Degrees(some)) + "°";
    for (int i = 0; i < kExplainSteps; ++i) {
      const double middle = (none + some) / 2;
      (finds(middle) ? some : none) = middle;
    }
    return "; one was found at " + FormatShort(Degrees(some)) +
           "°, an upper bound by search of the friction that is needed";
  }

  const Object& object_;
  const GeneralPlanOptions& options_;
  GraspEvaluator evaluator_;
  SurfaceSampler source_;
  RandomStream random_;
  int fingers_ = FingersOf(object_);
  Reach reach_;
};

}  // namespace

GraspChoice ResolveGrasp(const Object& object, const GraspChoice& choice, RandomUse use,
                         const GeneralPlanOptions& options) {
  const GraspEvaluator evaluator(object, {options.half_angle, options.min_quality},
                                 {.fingertip_radius = options.finger_radius});
  if (choice.kind == Kind::kGiven) {
    const int fewest = object.dimension() == 3 ? 3 : 2;
    CheckGivenGrasp(choice, {"general", fewest, FingersOf(object)}, evaluator.frame(),
                    options.half_angle, kSamePoint * object.diameter());
    CheckFingersFit(choice, object, options.finger_radius);
    return choice;
  }
  GraspChoice fixed{Kind::kGiven, {}, choice.name};
  RandomStream random(options.seed, use);
  const auto check_time = [&] {
    if (!options.deadline.IsOver()) return;
    throw NoGrasp{choice.name + ": the time was up before a grasp was drawn"};
  };
  const ContactLimits contacts = object.dimension() == 3 ? kSpatialContacts : kPlanarContacts;
  fixed.grasp = DrawOnSurface(object, contacts, evaluator, random, choice.name, check_time);
  return fixed;
}

PlanResult PlanGeneral(const Object& object, const GraspChoice& start, const GraspChoice& goal,
                       const GeneralPlanOptions& options) {
  try {
    return Planner(object, options).Plan(start, goal);
  } catch (const NoGrasp& none) {
    return ResultOf(none);
  }
}

}  // namespace regrasp
