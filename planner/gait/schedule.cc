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

/// Grasps expanded from one place in the hand before others have their turn.
constexpr int kExpandedAtOnce = 6;
/// From all places together, by their number, before there is another one: so many, and so many
/// for each step of the way where that is more. Of whole turns more come to their end so than with
/// many places from which little grows: in an Allegro hand 19 of 20 instead of 16 within 8 s.
constexpr std::int64_t kExpandedForNext = 20;
constexpr double kExpandedForStep = 0.75;
/// Times that places are looked for.
constexpr int kPoseDrawings = 4;

}  // namespace

MultiStartSearch::MultiStartSearch(const GaitRequest& request, std::vector<SearchTerms> terms,
                                   GaitEnds ends)
    : request_(request),
      terms_(std::move(terms)),
      ends_(std::move(ends)),
      random_(request.seed, RandomUse::kHomes),
      task_(request.scale * request.solid->mass_properties().centroid, request.turn,
            request.goal_pose) {}

std::optional<Gait> MultiStartSearch::Search() {
  while (!request_.deadline.IsOver() && expanded_ < request_.most_expanded) {
    Place* place = Next();
    if (place == nullptr) return std::nullopt;
    const std::int64_t before = place->search->counts().expanded;
    const std::optional<Gait> gait =
        place->search->Run(before + kExpandedAtOnce, request_.deadline);
    if (gait) return MergeMoves(place->terms.setup, *gait);
    expanded_ += place->search->counts().expanded - before;
    request_.progress("searching a gait, " + std::to_string(expanded_) + " grasps from " +
                      std::to_string(places_.size()) + " places in the hand");
  }
  return std::nullopt;
}

std::vector<GaitCounts> MultiStartSearch::counts() const {
  std::vector<GaitCounts> counts;
  for (const auto& place : places_) counts.push_back(place->search->counts());
  return counts;
}

std::int64_t MultiStartSearch::BudgetForNextStart() const {
  if (places_.empty()) return 0;
  const int steps = places_.front()->search->counts().steps;
  return static_cast<std::int64_t>(places_.size()) *
         std::max<std::int64_t>(kExpandedForNext, std::llround(kExpandedForStep * steps));
}

MultiStartSearch::Place* MultiStartSearch::Next() {
  if (expanded_ >= BudgetForNextStart() && Open()) return places_.back().get();
  Place* next = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& place : places_) {
    if (place->search->IsExhausted()) continue;
    const GaitCounts counts = place->search->counts();
    const double farther = 1.0 + counts.farthest;
    const double had = static_cast<double>(counts.expanded) / (farther * farther);
    if (had >= least) continue;
    least = had;
    next = place.get();
  }
  return next == nullptr && Open() ? places_.back().get() : next;
}

bool MultiStartSearch::Open() {
  while (true) {
    if (initial_poses_.empty()) {
      if (!DrawInitialPoses()) return false;
      continue;
    }
    const PoseTrack track = task_.From(initial_poses_.back());
    initial_poses_.pop_back();
    auto place = std::make_unique<Place>(
        Place{terms_[opened_++ % terms_.size()],
              RandomStream(request_.seed, RandomUse::kGaits, places_.size())});
    place->search = SearchAlong(track, place->terms, place->random);
    if (!place->search || !place->search->GoalIsHeld()) continue;
    places_.push_back(std::move(place));
    return true;
  }
}

std::unique_ptr<StartSearch> MultiStartSearch::SearchAlong(const PoseTrack& track,
                                                           const SearchTerms& terms,
                                                           RandomStream& random) {
  const HandSetup& setup = terms.setup;
  std::optional<IdlePostures> idle_postures = FindIdlePostures(setup, track, random_);
  if (!idle_postures) return nullptr;
  const bool is_turn = !request_.goal_pose && track.steps() > 0;
  // Contacts roll one way, and what is tried is carried out one way.
  const bool goes_one_way = setup.rolled_on != nullptr || terms.carry_out;
  const bool may_begin_anywhere =
      is_turn && !request_.start_pose && ends_.start.empty() && ends_.goal.empty() && !goes_one_way;
  if (may_begin_anywhere) {
    if (auto backwards = FindIdlePostures(setup, track.Backwards(), random_)) {
      return std::make_unique<TurnSearch>(setup, track, *std::move(idle_postures),
                                          *std::move(backwards), terms.memory, random);
    }
  }
  const PoseGrid grid(track, setup.scene.hand().up,
                      is_turn ? PoseGrid::End::kOrientation : PoseGrid::End::kPose);
  return std::make_unique<BidirectionalSearch>(setup, grid, *std::move(idle_postures), ends_,
                                               terms.memory, random, terms.carry_out);
}

bool MultiStartSearch::DrawInitialPoses() {
  if (++drawings_ > (request_.start_pose ? 1 : kPoseDrawings)) return false;
  if (request_.start_pose) {
    initial_poses_.assign(terms_.size(), *request_.start_pose);
    return true;
  }
  const SearchTerms& first = terms_.front();
  initial_poses_ = FindInitialPoses(first.setup, task_, ends_, first.memory, random_);
  std::ranges::reverse(initial_poses_);
  return true;
}

namespace {

constexpr std::array kFollowed = {RobustnessMargins{0.05, 1.5e-3, 0.2},
                                  RobustnessMargins{0.02, 1.5e-3, 0.1}};
/// Grasps that are expanded for each of them where there is a gait without, for each quarter turn,
/// and share of the time that is left.
constexpr std::int64_t kExpandedToFollow = 40;
constexpr double kTimeToFollow = 0.4;
/// With reserve a gait may have so many times as many stretches as without, and so many more.
constexpr std::size_t kTimesAsLong = 3;
constexpr std::size_t kLonger = 12;

/// Of what is tried on the way, place by place: two of three times contacts are not followed, which
/// is found sooner; where they are, more is carried out.
constexpr RobustnessMargins kNotFollowed = {0.05, 0.5e-3};
constexpr std::array kTried = {kNotFollowed, kNotFollowed, kFollowed.front()};
/// Grasps that are expanded for each quarter turn the first time, twice as many the next time.
constexpr std::int64_t kExpandedInRound = 300;
/// Times that all is looked for; more where a time limit ends it.
constexpr int kRounds = 2;
constexpr int kMostRounds = 6;
constexpr int kStreamShift = 32;  ///< of seeds
/// Whole gaits are tried first, when they are found: of short turns those whose contacts are not
/// followed, which may begin at any angle; of others those where they are, which ring hands mostly
/// carry out. With no more grasps, for each quarter turn, and time each than this.
constexpr std::array kTriedWhole = {kNotFollowed, RobustnessMargins{0.02, 0}};
constexpr double kShortTurn = 1.75;  ///< radians
constexpr std::int64_t kExpandedWhole = 40;
/// So often from other places in the hand, as long as there are any: mostly a single move, which is
/// found at once and either carried out or not.
constexpr int kTimesWhole = 4;
constexpr double kTimeForWhole = 0.15;
/// Share of all the time before a gait without reserve is looked for.
constexpr double kTimeBeforeWithout = 0.85;

void Bound(GaitRequest& asked, std::int64_t expanded, double share) {
  const double quarters = std::max(1.0, std::abs(asked.turn.angle) / (std::numbers::pi / 2));
  asked.most_expanded = std::min<std::int64_t>(
      asked.most_expanded, std::llround(quarters * static_cast<double>(expanded)));
  asked.deadline = asked.deadline.After(share);
}

constexpr std::string_view kTrying = "trying a plan on the hand's own motors";

/// One look for a gait.
struct Attempt {
  std::span<const RobustnessMargins> margins;
  std::uint64_t stream;  ///< of random numbers
  std::int64_t expanded;
  double time;
  bool is_whole;          ///< tried when it is found, and not on the way
  bool is_again = false;  ///< left out where the look before it found nothing
};
/// Made one after the other; those of other rows may be made at the same time.
using Schedule = std::vector<Attempt>;

/// In their order.
std::vector<Schedule> SchedulesFor(const GaitRequest& request) {
  const bool is_short_turn = !request.goal_pose && std::abs(request.turn.angle) <= kShortTurn;
  const std::span<const RobustnessMargins> whole =
      is_short_turn ? std::span<const RobustnessMargins>(kTriedWhole)
                    : std::span(&kFollowed.front(), 1);
  std::vector<Schedule> rows;
  const int rounds = request.deadline.left() ? std::max(kMostRounds, request.jobs) : kRounds;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t stream = static_cast<std::uint64_t>(round) * kTimesWhole;
    for (const RobustnessMargins& spare : whole) {
      Schedule& row = rows.emplace_back();
      for (int again = 0; again < kTimesWhole; ++again) {
        row.push_back(
            {{&spare, 1}, stream + again, kExpandedWhole, kTimeForWhole, true, again > 0});
      }
    }
    const int doublings = std::min(round, kMostRounds - 1);
    rows.push_back({{kTried, stream, kExpandedInRound << doublings, 1, false}});
  }
  return rows;
}

SimulatedGait FindWithoutSimulation(GaitRequest request, const FindOne& find) {
  request.carry_out = nullptr;
  if (request.reserve == Reserve::kRequired) return {FindRobustGait(request, find, {})};
  FoundGait without = find(request, {});
  return {without.gait ? FindRobustGait(request, find, without) : std::move(without)};
}

/// Makes looks, rows of them at a time, until the hand carries a gait out. Where no deadline makes
/// it depend on the machine, what comes of it does not depend on the threads: the first row counts
/// in which one is carried out.
class AttemptRunner {
 public:
  /// All outlive this object.
  AttemptRunner(const GaitRequest& request, const std::vector<grasp::Contact>& contacts,
                const FindOne& find)
      : request_(request),
        contacts_(contacts),
        find_(find),
        schedules_(SchedulesFor(request)),
        seen_(schedules_.size()),
        last_schedule_(schedules_.size()) {}

  void Run(const Deadline& deadline) {
    InBlocks(schedules_.size(), 1, request_.jobs, [&](std::size_t begin, std::size_t end) {
      try {
        for (std::size_t row = begin; row < end; ++row) RunSchedule(row, deadline);
      } catch (...) {
        is_over_ = true;
        throw;
      }
    });
  }

  /// Whether nothing tells what the hand carries out.
  [[nodiscard]] bool cannot_tell() const { return cannot_tell_; }

  /// Of gaits that are carried out the first of those with most to spare; no gait where none is.
  [[nodiscard]] SimulatedGait Widest() {
    Seen* widest = nullptr;
    ForEachSeen([&](Seen& seen) {
      if (!seen.carried || !seen.carried->is_whole) return;
      const bool is_wider = widest == nullptr || (request_.seeks_most_margin &&
                                                  seen.carried->spare > widest->carried->spare);
      if (is_wider) widest = &seen;
    });
    if (widest == nullptr) return {};
    return {std::move(widest->found), std::move(widest->carried)};
  }

  /// The first gait, or else why there is none: of looks where gaits are tried on the way, if any
  /// was made.
  [[nodiscard]] SimulatedGait FirstNotCarriedOut() {
    SimulatedGait best;
    ForEachSeen([&](Seen& seen) {
      if (best.found.gait) return;
      if (!seen.found.gait && !best.found.message.empty() && seen.is_whole) return;
      best = {std::move(seen.found), std::move(seen.carried)};
    });
    return best;
  }

  /// Why the hand carries no gait out: what stopped the one that came farthest, or else why there
  /// is none.
  [[nodiscard]] SimulatedGait NoneCarriedOut() {
    std::size_t count = 0;
    const Seen* farthest = nullptr;
    ForEachSeen([&](const Seen& seen) {
      if (!seen.carried) return;
      ++count;
      if (farthest == nullptr || seen.ShareCarried() > farthest->ShareCarried()) farthest = &seen;
    });
    if (farthest == nullptr) return {std::move(FirstNotCarriedOut().found)};
    std::string text = count == 1
                           ? "the hand's own motors do not carry out the plan that was found: "
                           : "of " + std::to_string(count) +
                                 " plans that were found the hand's own motors carry none out; of "
                                 "the one that comes farthest ";
    text += FailureText(*farthest->carried, farthest->steps);
    return {{std::nullopt, std::move(text)}, farthest->carried};
  }

 private:
  struct Seen {
    FoundGait found;
    bool is_whole;                                     ///< as Look has it
    std::optional<planning::CarriedOut> carried = {};  ///< of a gait
    std::size_t steps = 0;                             ///< of its plan

    [[nodiscard]] double ShareCarried() const {
      return (carried->is_held ? 1.0 + carried->steps : 0.0) / (1.0 + static_cast<double>(steps));
    }
  };

  void RunSchedule(std::size_t row, const Deadline& until) {
    const auto is_given_up = [this, row] { return is_over_ || row > last_schedule_; };
    const Deadline deadline = until.OrWhen(is_given_up);
    if (row > 0 && deadline.IsOver()) return;
    for (const Attempt& look : schedules_[row]) {
      if (look.is_again && !seen_[row].back().found.gait) return;
      seen_[row].push_back(Make(look, deadline));
      const Seen& seen = seen_[row].back();
      if (seen.carried && seen.carried->is_whole && !request_.seeks_most_margin) {
        EndWith(row);
        return;
      }
      if (deadline.IsOver()) return;
    }
  }

  Seen Make(const Attempt& look, const Deadline& deadline) {
    GaitRequest asked = request_;
    asked.seed += look.stream << kStreamShift;
    asked.deadline = deadline;
    asked.progress = [this](std::string_view text) { Tell(text); };
    if (look.is_whole) asked.carry_out = nullptr;
    Bound(asked, look.expanded, look.time);
    Seen seen{find_(asked, look.margins), look.is_whole};
    if (!seen.found.gait) return seen;
    Tell(kTrying);
    const plan::Plan plan = PlanOf(*seen.found.gait, request_, contacts_);
    seen.steps = plan.steps.size();
    seen.carried = request_.carry_out(plan, deadline);
    if (!seen.carried) cannot_tell_ = is_over_ = true;
    return seen;
  }

  void Tell(std::string_view text) {
    const std::scoped_lock lock(telling_);
    request_.progress(text);
  }

  /// Later rows are given up; where a deadline makes what is found depend on the machine, all are.
  void EndWith(std::size_t row) {
    if (request_.deadline.left()) is_over_ = true;
    std::size_t last = last_schedule_;
    while (row < last && !last_schedule_.compare_exchange_weak(last, row)) {
    }
  }

  template <typename F>
  void ForEachSeen(const F& call) {
    for (std::vector<Seen>& row : seen_) {
      for (Seen& seen : row) call(seen);
    }
  }

  const GaitRequest& request_;
  const std::vector<grasp::Contact>& contacts_;
  const FindOne& find_;
  std::vector<Schedule> schedules_;
  std::vector<std::vector<Seen>> seen_;  ///< by row
  std::atomic<std::size_t> last_schedule_;
  std::atomic<bool> is_over_ = false;
  std::atomic<bool> cannot_tell_ = false;
  std::mutex telling_;
};

}  // namespace

std::string FailureText(const planning::CarriedOut& carried, std::size_t steps) {
  const std::string where =
      carried.is_held ? "step " + std::to_string(carried.steps + 1) + " of " + std::to_string(steps)
                      : "the first hold";
  if (carried.is_cut_short) return "the time was up in " + where;
  return where + " fails (" + std::string(plan::ReasonName(carried.reason)) +
         "): " + carried.detail;
}

FoundGait FindRobustGait(const GaitRequest& request, const FindOne& find,
                         const FoundGait& without) {
  FoundGait none = without;
  for (const RobustnessMargins& spare : kFollowed) {
    GaitRequest asked = request;
    if (without.gait) {
      Bound(asked, kExpandedToFollow, kTimeToFollow);
    } else {
      asked.most_expanded /= static_cast<std::int64_t>(kFollowed.size());
    }
    FoundGait found = find(asked, {&spare, 1});
    const bool is_much_longer =
        found.gait && without.gait &&
        found.gait->segments.size() > kTimesAsLong * without.gait->segments.size() + kLonger;
    if (found.gait && !is_much_longer) return found;
    if (!none.gait && none.message.empty()) none.message = std::move(found.message);
  }
  return none;
}

SimulatedGait FindExecutableGait(const GaitRequest& request,
                                 const std::vector<grasp::Contact>& contacts, const FindOne& find) {
  const bool is_required = request.reserve == Reserve::kRequired;
  AttemptRunner runner(request, contacts, find);
  runner.Run(is_required ? request.deadline : request.deadline.After(kTimeBeforeWithout));
  if (runner.cannot_tell()) return FindWithoutSimulation(request, find);
  if (SimulatedGait widest = runner.Widest(); widest.found.gait) return widest;
  if (is_required) return runner.NoneCarriedOut();
  SimulatedGait best = runner.FirstNotCarriedOut();
  SimulatedGait without{find(request, {})};
  if (without.found.gait) {
    request.progress(kTrying);
    const plan::Plan plan = PlanOf(*without.found.gait, request, contacts);
    without.trial = request.carry_out(plan, request.deadline);
    if (!without.trial) return FindWithoutSimulation(request, find);
    if (without.trial->is_whole) return without;
  }
  return std::move(best.found.gait ? best : without);
}

}  // namespace regrasp::gait
