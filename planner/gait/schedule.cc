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
#include <tuple>
#include <utility>

#include "planner/base/in_blocks.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/plan/reason.h"

namespace regrasp::gait {

namespace {

/// Margins with modelled rolling, larger ones first.
constexpr std::array kRolling = {RobustnessMargins{0.05, 1.5e-3, 0.2},
                                 RobustnessMargins{0.02, 1.5e-3, 0.1}};
/// Bounds per set of margins if there is a gait without margins: expanded stances per quarter turn,
/// and fraction of the remaining time.
constexpr std::int64_t kRollingExpanded = 40;
constexpr double kRollingTime = 0.4;
/// Length limit of a robust gait: factor and offset on the number of segments without margins.
constexpr std::size_t kMaxLengthFactor = 3;
constexpr std::size_t kMaxExtraSegments = 12;

/// Margins for simulated edges of odd and of even rounds, assigned to initial poses in turn.
/// Searches without modelled rolling are faster, but fewer of their gaits execute. With the second
/// sets alone, Allegro loses whole turns that the first ones find.
constexpr RobustnessMargins kNotRolling = {0.05, 0.5e-3};
constexpr RobustnessMargins kLightRolling = {0.05, 0.5e-3, 0.0};
constexpr RobustnessMargins kMediumRolling = {0.05, 1e-3, 0.1};
constexpr std::array<std::array<RobustnessMargins, 3>, 2> kEdgeMargins = {
    {{kNotRolling, kNotRolling, kRolling.front()}, {kNotRolling, kLightRolling, kMediumRolling}}};
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
constexpr std::int64_t kWholePatience = 40;
constexpr double kWholeTime = 0.15;  ///< fraction of the remaining time
/// Maximum number of such attempts with different initial poses.
/// Most of these gaits are a single motion, which is found quickly and either executes or not.
constexpr int kWholeAttempts = 4;
/// Fraction of the time after which a gait without margins is searched.
constexpr double kTimeBeforeWithout = 0.85;

/// Return the request of one set of margins if there is a gait without margins.
GaitRequest Bounded(GaitRequest request) {
  const double quarters = std::max(1.0, std::abs(request.turn.angle) / (std::numbers::pi / 2));
  request.most_expanded = std::min<std::int64_t>(
      request.most_expanded, std::llround(quarters * static_cast<double>(kRollingExpanded)));
  request.deadline = request.deadline.After(kRollingTime);
  return request;
}

constexpr std::string_view kSimulating = "simulating a plan";
constexpr std::string_view kRating = "simulating a plan under several conditions";

/// Part of an attempt that is simulated.
enum class Simulate {
  kEdges,  ///< edges during the search, and the gait
  kGait,   ///< only the gait of the search
};

/// One search of a gait: a row of the schedule.
/// It ends when it stagnates, so that searches that are far from the goal but advance are not
/// abandoned, and those in a dead end are.
struct Attempt {
  std::span<const RobustnessMargins> margin_sets;  ///< assigned to the initial poses in turn
  std::int64_t patience;  ///< expanded stances without progress along the track that end the search
  double time;            ///< fraction of the remaining time
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
        schedule.push_back({{&margins, 1},
                            kWholePatience,
                            kWholeTime,
                            Simulate::kGait,
                            stream + again,
                            again > 0});
      }
    }
    const double growth = std::pow(kPatienceGrowth, std::min(round, kMaxRounds - 1));
    const std::int64_t patience = std::llround(kEdgePatience * growth);
    const std::span<const RobustnessMargins> sets =
        kEdgeMargins[static_cast<std::size_t>(round) % kEdgeMargins.size()];
    schedules.push_back({{sets, patience, 1, Simulate::kEdges, stream}});
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

  /// Return the first gait or, if there is none, the reason of the search that reached farthest.
  /// Reasons of attempts with simulated edges take precedence.
  [[nodiscard]] SimulatedGait BestNotExecuted() {
    const auto rank = [](const Outcome& outcome) {
      return std::tuple(outcome.found.gait.has_value(), !outcome.found.message.empty(),
                        outcome.simulate == Simulate::kEdges, outcome.found.reached);
    };
    Outcome* best = nullptr;
    ForEachOutcome([&](Outcome& outcome) {
      if (best == nullptr || (!best->found.gait && rank(outcome) > rank(*best))) best = &outcome;
    });
    if (best == nullptr) return {};
    return {std::move(best->found), std::move(best->execution)};
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
    if (farthest == nullptr) return {std::move(BestNotExecuted().found)};
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
    asked.patience = attempt.patience;
    asked.deadline = asked.deadline.After(attempt.time);
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
    GaitRequest asked = without.gait ? Bounded(request) : request;
    if (!without.gait) asked.most_expanded /= static_cast<std::int64_t>(kRolling.size());
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
  SimulatedGait best = runner.BestNotExecuted();
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
