#include "planner/general/plan_general.h"

#include <chrono>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "planner/general/improve_path.h"
#include "planner/general/path_plan.h"
#include "planner/general/subset_search.h"
#include "planner/general/two_trees.h"
#include "planner/graph/plan_search.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/polygon/boundary_draw.h"
#include "planner/roadmap/surface_draw.h"

namespace regrasp {

namespace {

using Kind = GraspChoice::Kind;
using Status = PlanResult::Status;

/// Contacts of a random grasp in space; in the plane as many as the seed says of these.
constexpr int kRandomContacts = 4;
constexpr int kFewestPlanar = 2;
constexpr int kMostPlanar = 3;

/// Sequences that are compared for the least travel.
constexpr int kTravelTries = 16;

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
        judge_(object, options.half_angle, options.min_quality, options.finger_radius),
        source_(object, options.finger_radius),
        random_(options.seed, RandomUse::kCandidates) {
    if (options.time_limit_s) {
      deadline_ = std::chrono::steady_clock::now() +
                  std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                      std::chrono::duration<double>(*options.time_limit_s));
    }
  }

  PlanResult Plan(const GraspChoice& start, const GraspChoice& goal) {
    const Grasp from = FixGrasp(object_, start, RandomUse::kStart, options_).grasp;
    const Grasp to = FixGrasp(object_, goal, RandomUse::kGoal, options_).grasp;
    std::optional<Found> best = Find(from, to, 0);
    if (!best) return NoSequence(from, to);
    if (!IsGood(*best)) {
      options_.progress("looking for grasps of a quality of " + FormatShort(options_.min_quality));
      if (auto good = Find(from, to, options_.min_quality)) best = std::move(good);
    }
    PlanResult result = ResultOf(best->draft, judge_, "general", fingers_, to);
    result.notes = std::move(best->notes);
    return result;
  }

 private:
  struct Found {
    Draft draft;
    std::vector<std::string> notes;
  };
  /// What a search that found nothing came to.
  struct Reach {
    std::array<int, 2> grasps{};
    std::array<int, 2> tuples{};
    std::int64_t tests = 0;
    bool out_of_time = false;
  };

  [[nodiscard]] bool IsGood(const Found& found) const {
    return std::all_of(found.draft.rests.begin(), found.draft.rests.end(),
                       [&](const Rest& rest) { return judge_.Score(rest.grasp) >= 0; });
  }

  SearchSpace MakeSpace(double half_angle, double min_quality, std::int64_t effort) const {
    SearchSpace space(object_, {half_angle, 0, min_quality, options_.finger_radius});
    space.SetLimits({effort, deadline_});
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
    TwoTrees trees(start, goal, source_, random_, space);
    auto path = trees.Join();
    for (int side = 0; side < 2; ++side) {
      reach_.grasps[side] = trees.tree(side).size();
      reach_.tuples[side] = trees.tree(side).tuple_count();
    }
    reach_.tests = space.tests();
    reach_.out_of_time = space.out_of_time();
    return path;
  }

  std::optional<Found> Find(const Grasp& from, const Grasp& to, double min_quality) {
    SearchSpace space = MakeSpace(options_.half_angle, min_quality, options_.effort);
    const auto found = Search(from, to, space);
    if (!found) return std::nullopt;
    // The contacts of the path alone: the search may have come across thousands.
    SearchSpace small = MakeSpace(options_.half_angle, min_quality, options_.effort);
    return Improve(Renumber(*found, space, small), from, small);
  }

  Found Improve(const GraspPath& found, const Grasp& from, SearchSpace& space) {
    options_.progress("shortening and widening the sequence");
    GraspPath path = ShortenPath(found, source_, random_, space);
    Found best;
    if (options_.aim == GeneralAim::kTravel) {
      const double before = TravelOf(path, space);
      for (int i = 1; i < kTravelTries; ++i) {
        const GraspPath other = ShortenPath(found, source_, random_, space);
        if (TravelOf(other, space) < TravelOf(path, space)) path = other;
      }
      best.notes.push_back("the way of all fingers was " + FormatShort(before) + " and is " +
                           FormatShort(TravelOf(path, space)));
    } else {
      const double before = RequiredHalfAngleOf(path, space);
      path = WidenPath(path, options_.aim == GeneralAim::kMargin ? kMoreSteps : 0, source_, random_,
                       space);
      best.notes.push_back("the weakest grasp needed " + FormatShort(Degrees(before)) +
                           "° at first and needs " +
                           FormatShort(Degrees(RequiredHalfAngleOf(path, space))) + "° now");
    }
    best.draft = MakeDraft(path, from, space);
    return best;
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
  GraspJudge judge_;
  SurfaceSource source_;
  RandomStream random_;
  int fingers_ = FingersOf(object_);
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  Reach reach_;
};

}  // namespace

GraspChoice FixGrasp(const Object& object, const GraspChoice& choice, RandomUse use,
                     const GeneralPlanOptions& options) {
  const GraspJudge judge(object, options.half_angle, options.min_quality, options.finger_radius);
  if (choice.kind == Kind::kGiven) {
    const int fewest = object.dimension() == 3 ? 3 : 2;
    CheckGivenGrasp(choice, {"general", fewest, FingersOf(object)}, judge.frame(),
                    options.half_angle, kSamePoint * object.diameter());
    CheckFingersFit(choice, object, options.finger_radius);
    return choice;
  }
  GraspChoice fixed{Kind::kGiven, {}, choice.name};
  RandomStream random(options.seed, use);
  if (const auto* solid = dynamic_cast<const Polyhedron*>(&object)) {
    fixed.grasp = DrawOnSurface(*solid, kRandomContacts, judge, random, choice.name);
    return fixed;
  }
  const auto& polygon = dynamic_cast<const Polygon&>(object);
  const auto grasp = DrawAnyGrasp(polygon, kFewestPlanar, kMostPlanar, judge, random);
  if (!grasp) {
    throw NoGrasp{choice.name + ": none of " + std::to_string(kMaxSurfaceDraws) +
                  " grasps drawn on the boundary is force closure with a quality of at least " +
                  FormatShort(options.min_quality)};
  }
  fixed.grasp = *grasp;
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
