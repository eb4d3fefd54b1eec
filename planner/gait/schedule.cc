#include "planner/gait/schedule.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "planner/base/in_blocks.h"
#include "planner/gait/initial_pose.h"
#include "planner/gait/joined_search.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/plan/reason.h"

namespace regrasp::gait {

namespace {

/// Expansions of one search before the next search continues.
constexpr std::int64_t kExpandedPerRun = 6;
/// Total expansions per initial pose before another one is added: constant, and per track step if
/// that is larger. Deep searches solve more full rotations than many shallow ones: 19 instead of 16
/// of 20 within 8 s with an Allegro hand.
constexpr std::int64_t kExpandedForNext = 20;
constexpr double kExpandedForStep = 0.75;
/// Number of times that initial poses are drawn.
constexpr int kPoseDrawings = 4;

/// Bounds of one search.
struct Budget {
  std::int64_t expanded;  ///< expanded stances per quarter turn
  double time;            ///< fraction of the remaining time
};

/// Bounds of one attempt. A search ends when it stagnates, so that searches that are far from the
/// goal but advance are not abandoned, and those in a dead end are.
struct Patience {
  std::int64_t expanded;  ///< expanded stances without progress along the track
  double time;            ///< fraction of the remaining time
};

/// Margins with modelled rolling, larger ones first.
constexpr std::array kRolling = {RobustnessMargins{0.05, 1.5e-3, 0.2},
                                 RobustnessMargins{0.02, 1.5e-3, 0.1}};
/// Budget per set of margins if there is a gait without margins.
constexpr Budget kRollingBudget = {40, 0.4};
/// Length limit of a robust gait: factor and offset on the number of segments without margins.
constexpr std::size_t kMaxLengthFactor = 3;
constexpr std::size_t kMaxExtraSegments = 12;

/// Margins for simulated edges, assigned to initial poses in turn.
/// Searches without modelled rolling are faster, but fewer of their gaits execute. Which of them
/// finds a gait first depends on hand and object, so each round begins with another set.
constexpr RobustnessMargins kNotRolling = {0.05, 0.5e-3};
constexpr RobustnessMargins kLightRolling = {0.05, 0.5e-3, 0.0};
constexpr RobustnessMargins kMediumRolling = {0.05, 1e-3, 0.1};
constexpr std::size_t kEdgeSets = 3;
constexpr std::array kEdgeMargins = {kNotRolling, kLightRolling, kMediumRolling,
                                     kNotRolling, kLightRolling, kMediumRolling};
/// Patience in the first round, and its growth per round.
constexpr std::int64_t kEdgePatience = 300;
constexpr double kPatienceGrowth = 1.25;
/// Number of rounds; the maximum applies if there is a time limit.
constexpr int kRounds = 3;
constexpr int kMaxRounds = 12;
constexpr int kStreamShift = 32;  ///< bits by which the random stream is shifted into the seed
/// Complete gaits are simulated first.
/// For short rotations their rolling is not modelled, so that they may begin at any angle; for
/// other tasks it is, because ring hands execute most of these.
constexpr std::array kShortTurnMargins = {kNotRolling, RobustnessMargins{0.02, 0}};
constexpr double kShortTurn = 1.75;  ///< radians
constexpr Patience kWholePatience = {40, 0.15};
/// Maximum number of such attempts with different initial poses.
/// Most of these gaits are a single motion, which is found quickly and either executes or not.
constexpr int kWholeAttempts = 4;
/// Fraction of the time after which a gait without margins is searched.
constexpr double kTimeBeforeWithout = 0.85;

void Bound(GaitRequest& request, const Budget& budget) {
  const double quarters = std::max(1.0, std::abs(request.turn.angle) / (std::numbers::pi / 2));
  request.most_expanded = std::min<std::int64_t>(
      request.most_expanded, std::llround(quarters * static_cast<double>(budget.expanded)));
  request.deadline = request.deadline.After(budget.time);
}

constexpr std::string_view kSimulating = "simulating a plan";
constexpr std::string_view kRating = "simulating a plan under several conditions";

/// Part of an attempt that is simulated.
enum class Simulate {
  kEdges,  ///< edges during the search, and the gait
  kGait,   ///< only the gait of the search
};

/// One search of a gait: a row of the schedule.
struct Attempt {
  std::span<const RobustnessMargins> margin_sets;  ///< assigned to the initial poses in turn
  Patience patience;
  Simulate simulate;
  std::uint64_t stream;           ///< random stream, added to the seed
  bool repeats_previous = false;  ///< skipped if the previous attempt found no gait
};
/// Attempts made one after the other. Different schedules may run in parallel.
using Schedule = std::vector<Attempt>;

/// Return the schedules in order of priority.
std::vector<Schedule> SchedulesFor(const GaitRequest& request) {
  const bool is_short_turn = !request.goal && std::abs(request.turn.angle) <= kShortTurn;
  const std::span<const RobustnessMargins> whole =
      is_short_turn ? std::span<const RobustnessMargins>(kShortTurnMargins)
                    : std::span(&kRolling.front(), 1);
  std::vector<Schedule> schedules;
  const int rounds = request.deadline.left() ? std::max(kMaxRounds, request.jobs) : kRounds;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t stream = static_cast<std::uint64_t>(round) * kWholeAttempts;
    for (const RobustnessMargins& margins : whole) {
      Schedule& schedule = schedules.emplace_back();
      for (int again = 0; again < kWholeAttempts; ++again) {
        schedule.push_back(
            {{&margins, 1}, kWholePatience, Simulate::kGait, stream + again, again > 0});
      }
    }
    const double growth = std::pow(kPatienceGrowth, std::min(round, kMaxRounds - 1));
    const Patience patience{std::llround(kEdgePatience * growth), 1};
    const std::span sets(&kEdgeMargins[static_cast<std::size_t>(round) % kEdgeSets], kEdgeSets);
    schedules.push_back({{sets, patience, Simulate::kEdges, stream}});
  }
  return schedules;
}

SimulatedGait FindWithoutSimulation(GaitRequest request, const FindOne& find) {
  request.simulate = nullptr;
  if (request.robustness == RobustnessLevel::kRequired) return {FindRobustGait(request, find, {})};
  FoundGait without = find(request, {});
  return {without.gait ? FindRobustGait(request, find, without) : std::move(without)};
}

/// Runs schedules, several in parallel, until a gait executes.
/// Without a deadline the result does not depend on the number of threads: the first schedule with
/// an executing gait determines it.
class AttemptRunner {
 public:
  /// All arguments outlive this object.
  AttemptRunner(const GaitRequest& request, const std::vector<grasp::Contact>& contacts,
                const FindOne& find)
      : request_(request),
        contacts_(contacts),
        find_(find),
        schedules_(SchedulesFor(request)),
        outcomes_(schedules_.size()),
        last_schedule_(schedules_.size()) {}

  void Run(const Deadline& deadline) {
    InBlocks(schedules_.size(), 1, request_.jobs, [&](std::size_t begin, std::size_t end) {
      try {
        for (std::size_t i = begin; i < end; ++i) RunSchedule(i, deadline);
      } catch (...) {
        is_over_ = true;
        throw;
      }
    });
  }

  /// Whether the simulator gives no result.
  [[nodiscard]] bool is_unknown() const { return is_unknown_; }

  /// Return the first executing gait; no gait if none executes.
  /// If requested, the first one that fails under the fewest conditions, among these the one with
  /// the largest tolerance margin.
  [[nodiscard]] SimulatedGait BestExecuted() {
    Outcome* best = nullptr;
    ForEachOutcome([&](Outcome& outcome) {
      if (!outcome.execution || !outcome.execution->is_whole) return;
      if (best == nullptr || (request_.seeks_most_margin && outcome.IsMoreRobustThan(*best))) {
        best = &outcome;
      }
    });
    if (best == nullptr) return {};
    return {std::move(best->found), std::move(best->execution)};
  }

  /// Return the first gait or, if there is none, the first reason.
  /// Reasons of attempts with simulated edges take precedence.
  [[nodiscard]] SimulatedGait FirstNotExecuted() {
    SimulatedGait best;
    bool is_final = false;  // whether the reason is that of an attempt with simulated edges
    ForEachOutcome([&](Outcome& outcome) {
      const bool simulates_edges = outcome.simulate == Simulate::kEdges;
      if (best.found.gait) return;
      if (!outcome.found.gait && !best.found.message.empty() && (is_final || !simulates_edges)) {
        return;
      }
      is_final = simulates_edges && !outcome.found.message.empty();
      best = {std::move(outcome.found), std::move(outcome.execution)};
    });
    return best;
  }

  /// Return why no gait executes.
  /// The reason is the failure of the candidate that executes farthest, or why there is none.
  [[nodiscard]] SimulatedGait WhyNoneExecutes() {
    std::size_t count = 0;
    const Outcome* farthest = nullptr;
    ForEachOutcome([&](const Outcome& outcome) {
      if (!outcome.execution) return;
      ++count;
      const bool is_farther =
          farthest == nullptr || outcome.ExecutedFraction() > farthest->ExecutedFraction();
      if (is_farther) farthest = &outcome;
    });
    if (farthest == nullptr) return {std::move(FirstNotExecuted().found)};
    std::string text =
        std::to_string(count) +
        (count == 1 ? " candidate planned, it does not execute in simulation; it "
                    : " candidates planned, none executes in simulation; the best ") +
        FailureText(*farthest->execution, farthest->steps);
    SimulatedGait best{{std::nullopt, std::move(text)}, farthest->execution};
    if (request_.measure_force) {
      const int entry = best.execution->is_held ? best.execution->steps + 1 : 0;
      best.execution->force =
          request_.measure_force(PlanOf(*farthest->found.gait, request_, contacts_), entry);
    }
    return best;
  }

 private:
  struct Outcome {
    FoundGait found;
    Simulate simulate;                                        ///< simulated part of the attempt
    std::optional<planning::ExecutionResult> execution = {};  ///< execution of the gait, if any
    std::size_t steps = 0;                                    ///< number of plan steps

    [[nodiscard]] double ExecutedFraction() const {
      return (execution->is_held ? 1.0 + execution->steps : 0.0) /
             (1.0 + static_cast<double>(steps));
    }
    /// Return the number of conditions under which the gait fails; the largest number if unrated.
    [[nodiscard]] int Failures() const {
      return execution->rating ? static_cast<int>(execution->rating->failed.size())
                               : std::numeric_limits<int>::max();
    }
    /// Compare two gaits that execute.
    [[nodiscard]] bool IsMoreRobustThan(const Outcome& other) const {
      if (Failures() != other.Failures()) return Failures() < other.Failures();
      return execution->tolerance_margin > other.execution->tolerance_margin;
    }
  };

  void RunSchedule(std::size_t schedule, const Deadline& until) {
    const auto is_abandoned = [this, schedule] { return is_over_ || schedule > last_schedule_; };
    const Deadline deadline = until.OrWhen(is_abandoned);
    if (schedule > 0 && deadline.IsOver()) return;
    for (const Attempt& attempt : schedules_[schedule]) {
      if (attempt.repeats_previous && !outcomes_[schedule].back().found.gait) return;
      outcomes_[schedule].push_back(Make(attempt, deadline));
      const Outcome& outcome = outcomes_[schedule].back();
      if (outcome.execution && outcome.execution->is_whole && !request_.seeks_most_margin) {
        EndWith(schedule);
        return;
      }
      if (deadline.IsOver()) return;
    }
  }

  Outcome Make(const Attempt& attempt, const Deadline& deadline) {
    GaitRequest asked = request_;
    asked.seed += attempt.stream << kStreamShift;
    asked.deadline = deadline;
    asked.progress = [this](std::string_view text) { Report(text); };
    if (attempt.simulate == Simulate::kGait) asked.simulate = nullptr;
    asked.patience = attempt.patience.expanded;
    asked.deadline = asked.deadline.After(attempt.patience.time);
    Outcome outcome{find_(asked, attempt.margin_sets), attempt.simulate};
    if (!outcome.found.gait) return outcome;
    Report(kSimulating);
    const plan::Plan plan = PlanOf(*outcome.found.gait, request_, contacts_);
    outcome.steps = plan.steps.size();
    outcome.execution = request_.simulate(plan, deadline);
    if (!outcome.execution) is_unknown_ = is_over_ = true;
    if (request_.seeks_most_margin && request_.rate) Rate(plan, deadline, outcome);
    return outcome;
  }

  /// Rate a gait that executes, unless it fails under more conditions than another gait.
  /// The gait with the fewest failures is always rated, so the choice does not depend on the number
  /// of threads.
  void Rate(const plan::Plan& plan, const Deadline& deadline, Outcome& outcome) {
    if (!outcome.execution || !outcome.execution->is_whole) return;
    Report(kRating);
    outcome.execution->rating = request_.rate(plan, fewest_failures_, deadline);
    const int failures = outcome.Failures();
    int fewest = fewest_failures_;
    while (failures < fewest && !fewest_failures_.compare_exchange_weak(fewest, failures)) {
    }
  }

  void Report(std::string_view text) {
    const std::scoped_lock lock(reporting_);
    request_.progress(text);
  }

  /// Abandon later schedules.
  /// With a deadline, whose result depends on the machine anyway, abandon all.
  void EndWith(std::size_t schedule) {
    if (request_.deadline.left()) is_over_ = true;
    std::size_t last = last_schedule_;
    while (schedule < last && !last_schedule_.compare_exchange_weak(last, schedule)) {
    }
  }

  template <typename F>
  void ForEachOutcome(const F& call) {
    for (std::vector<Outcome>& schedule : outcomes_) {
      for (Outcome& outcome : schedule) call(outcome);
    }
  }

  const GaitRequest& request_;
  const std::vector<grasp::Contact>& contacts_;
  const FindOne& find_;
  std::vector<Schedule> schedules_;
  std::vector<std::vector<Outcome>> outcomes_;  ///< outcomes, by schedule
  std::atomic<std::size_t> last_schedule_;
  std::atomic<int> fewest_failures_ = std::numeric_limits<int>::max();  ///< of a rated gait
  std::atomic<bool> is_over_ = false;
  std::atomic<bool> is_unknown_ = false;
  std::mutex reporting_;
};

}  // namespace

MultiStartSearch::MultiStartSearch(const GaitRequest& request, std::vector<SearchTerms> terms,
                                   GaitEnds ends)
    : request_(request),
      terms_(std::move(terms)),
      ends_(std::move(ends)),
      random_(request.seed, RandomUse::kHomes),
      task_(request.scale * request.solid->mass_properties().centroid, request.turn, request.goal,
            request.turn_tolerance) {}

std::optional<Gait> MultiStartSearch::Search() {
  while (!request_.deadline.IsOver() && expanded_ < request_.most_expanded) {
    Start* start = Next();
    if (start == nullptr) return std::nullopt;
    const std::int64_t before = start->search->counts().expanded;
    const std::optional<Gait> gait = start->search->Run(
        before + std::min(kExpandedPerRun, request_.most_expanded - expanded_), request_.deadline);
    if (gait) return MergeMoves(start->terms.setup, *gait);
    expanded_ += start->search->counts().expanded - before;
    if (const int farthest = start->search->counts().farthest; farthest > farthest_) {
      farthest_ = farthest;
      expanded_at_farthest_ = expanded_;
    }
    if (expanded_ - expanded_at_farthest_ >= request_.patience) return std::nullopt;
    request_.progress("searching a gait: " + std::to_string(expanded_) + " stances expanded from " +
                      std::to_string(starts_.size()) + " initial poses");
  }
  return std::nullopt;
}

std::vector<GaitCounts> MultiStartSearch::counts() const {
  std::vector<GaitCounts> counts;
  for (const auto& start : starts_) counts.push_back(start->search->counts());
  return counts;
}

std::int64_t MultiStartSearch::BudgetForNextStart() const {
  if (starts_.empty()) return 0;
  const int steps = starts_.front()->search->counts().steps;
  return static_cast<std::int64_t>(starts_.size()) *
         std::max<std::int64_t>(kExpandedForNext, std::llround(kExpandedForStep * steps));
}

MultiStartSearch::Start* MultiStartSearch::Next() {
  if (expanded_ >= BudgetForNextStart() && OpenNextStart()) return starts_.back().get();
  Start* next = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& start : starts_) {
    if (start->search->IsExhausted()) continue;
    const GaitCounts counts = start->search->counts();
    const double farther = 1.0 + counts.farthest;
    const double weight = static_cast<double>(counts.expanded) / (farther * farther);
    if (weight >= least) continue;
    least = weight;
    next = start.get();
  }
  return next == nullptr && OpenNextStart() ? starts_.back().get() : next;
}

bool MultiStartSearch::OpenNextStart() {
  while (true) {
    if (tracks_.empty()) {
      if (!DrawTracks()) return false;
      continue;
    }
    const PoseTrack track = tracks_.back();
    tracks_.pop_back();
    auto start = std::make_unique<Start>(
        Start{terms_[opened_++ % terms_.size()],
              RandomStream(request_.seed, RandomUse::kGaits, starts_.size())});
    start->search = SearchAlong(track, start->terms, start->random);
    if (!start->search || !start->search->GoalIsHeld()) continue;
    starts_.push_back(std::move(start));
    return true;
  }
}

std::unique_ptr<StartSearch> MultiStartSearch::SearchAlong(const PoseTrack& track,
                                                           const SearchTerms& terms,
                                                           RandomStream& random) {
  const HandSetup& setup = terms.setup;
  std::optional<IdleConfigurations> idle_configurations =
      FindIdleConfigurations(setup, track, random_);
  // Idle fingers of a given start state may have to move before the object reaches them.
  if (!idle_configurations && !request_.start_joints.empty()) {
    idle_configurations = FindIdleConfigurations(setup, track.InSteps(0), random_);
  }
  if (!idle_configurations) return nullptr;
  const bool is_turn = !request_.goal && track.steps() > 0;
  // Contacts roll, and edges are simulated, in the direction of time only.
  const bool is_one_directional = setup.rolled_on != nullptr || terms.simulate;
  const bool may_begin_anywhere = is_turn && !request_.turn_tolerance && !request_.start_pose &&
                                  ends_.start.empty() && ends_.goal.empty() && !is_one_directional;
  if (may_begin_anywhere) {
    if (auto backward = FindIdleConfigurations(setup, track.Backwards(), random_)) {
      return std::make_unique<TurnSearch>(setup, track, *std::move(idle_configurations),
                                          *std::move(backward), terms.memory, random);
    }
  }
  const Eigen::Vector3d& up = setup.scene.hand().up;
  const auto goal = task_.GoalFrom(track.PoseAt(0));
  const PoseGrid grid =
      goal && !goal->HasDefaultTolerance()
          ? PoseGrid(track, up, *goal)
          : PoseGrid(track, up, is_turn ? PoseGrid::End::kOrientation : PoseGrid::End::kPose);
  return std::make_unique<BidirectionalSearch>(setup, grid, *std::move(idle_configurations), ends_,
                                               terms.memory, random, terms.simulate);
}

bool MultiStartSearch::DrawTracks() {
  if (++drawings_ > (request_.start_pose ? 1 : kPoseDrawings)) return false;
  if (request_.start_pose) {
    for (const PoseTrack& track : task_.Tracks(*request_.start_pose)) {
      tracks_.insert(tracks_.end(), terms_.size(), track);
      drawn_tracks_.push_back(track);
    }
  } else {
    const SearchTerms& first = terms_.front();
    for (const auto& pose : FindInitialPoses(first.setup, task_, ends_, first.memory, random_)) {
      tracks_.push_back(task_.From(pose));
      drawn_tracks_.push_back(tracks_.back());
    }
  }
  std::ranges::reverse(tracks_);
  return true;
}

std::string FailureText(const planning::ExecutionResult& execution, std::size_t steps) {
  const std::string where = execution.is_held ? "step " + std::to_string(execution.steps + 1) +
                                                    " of " + std::to_string(steps)
                                              : "the initial grasp";
  if (execution.is_cut_short) return "reaches the time limit at " + where;
  return "fails at " + where + " (" + std::string(plan::ReasonName(execution.reason)) +
         "): " + execution.detail;
}

FoundGait FindRobustGait(const GaitRequest& request, const FindOne& find,
                         const FoundGait& without) {
  FoundGait none = without;
  for (const RobustnessMargins& margins : kRolling) {
    GaitRequest asked = request;
    if (without.gait) {
      Bound(asked, kRollingBudget);
    } else {
      asked.most_expanded /= static_cast<std::int64_t>(kRolling.size());
    }
    FoundGait found = find(asked, {&margins, 1});
    const bool is_much_longer =
        found.gait && without.gait &&
        found.gait->segments.size() >
            kMaxLengthFactor * without.gait->segments.size() + kMaxExtraSegments;
    if (found.gait && !is_much_longer) return found;
    if (!none.gait && none.message.empty()) none.message = std::move(found.message);
  }
  return none;
}

SimulatedGait FindExecutableGait(const GaitRequest& request,
                                 const std::vector<grasp::Contact>& contacts, const FindOne& find) {
  const bool is_required = request.robustness == RobustnessLevel::kRequired;
  AttemptRunner runner(request, contacts, find);
  runner.Run(is_required ? request.deadline : request.deadline.After(kTimeBeforeWithout));
  if (runner.is_unknown()) return FindWithoutSimulation(request, find);
  if (SimulatedGait best = runner.BestExecuted(); best.found.gait) return best;
  if (is_required) return runner.WhyNoneExecutes();
  SimulatedGait best = runner.FirstNotExecuted();
  SimulatedGait without{find(request, {})};
  if (without.found.gait) {
    request.progress(kSimulating);
    const plan::Plan plan = PlanOf(*without.found.gait, request, contacts);
    without.execution = request.simulate(plan, request.deadline);
    if (!without.execution) return FindWithoutSimulation(request, find);
    if (without.execution->is_whole) return without;
  }
  return std::move(best.found.gait ? best : without);
}

}  // namespace regrasp::gait
