// Benchmark of hands. It measures how often and how fast hands rotate objects, or connect two
// grasps at one pose (--pairs).
// Each plan is checked by the hand checker and, with --replay, executed by the hand's own
// actuators. The program also measures inverse kinematics and the generation of a static grasp. All
// times are processor times. It ends with the rows of a Markdown table.
//
//   hand_bench [--seeds N] [--limit SECONDS] [--axis z] [--degrees 90] [--pairs]
//              [--body NAME ...] [--replay] [--plan-mu 0.5] [--min-quality 0.06] [--of-critical
//              0.9] HAND.json ...

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/good_poses.h"
#include "bench/hand_trial.h"
#include "bench/processor_clock.h"
#include "bench/spread.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/base/text_table.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/gait/random_stances.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/check.h"
#include "sim/actuation/simulate_execution.h"

namespace {

using namespace regrasp;
using bench::HandBody;
using bench::kFriction;
using bench::Largest;
using bench::Median;

/// Results of plans replayed by their hand.
struct Replays {
  int count = 0;
  int passed = 0;
  std::vector<double> end_m;    ///< position error at the end of passed plans, m
  std::vector<double> end_deg;  ///< orientation error at the end of passed plans, degrees
  double simulated = 0;         ///< simulated time without the disturbance tests, s
  double seconds = 0;           ///< processor time with them, s
  std::map<std::string, int> reasons;

  void Add(const Replays& more) {
    count += more.count;
    passed += more.passed;
    end_m.insert(end_m.end(), more.end_m.begin(), more.end_m.end());
    end_deg.insert(end_deg.end(), more.end_deg.begin(), more.end_deg.end());
    simulated += more.simulated;
    seconds += more.seconds;
    for (const auto& [reason, times] : more.reasons) reasons[reason] += times;
  }
};

struct Outcome {
  int asked = 0;
  int found = 0;
  int rejected = 0;  ///< number of plans rejected by the checker
  int switches = 0;
  std::vector<double> seconds;  ///< processor times of found plans, s
  double checking = 0;
  Replays replays;
};

/// Task of the benchmark, which is the same for all hands.
struct Contest {
  int seeds = 5;
  double limit_s = 10;
  gait::Turn turn;
  bool pairs = false;
  bool replay = false;
  gait::RobustnessLevel robustness = gait::RobustnessLevel::kPreferred;
  double plan_mu = kFriction;
  double min_quality = criteria::GraspCriteria().min_quality;
  std::optional<double> of_critical;
};

/// Draw a request for a path between two independently drawn grasps that the hand reaches at one
/// pose.
/// @returns nullopt if there are no such grasps.
std::optional<gait::GaitRequest> DrawPair(gait::GaitRequest request) {
  constexpr int kTries = 100'000;
  request.turn.angle = 0;
  bench::GoodPoses good = bench::FindGoodPoses(request);
  request.start_pose = good.poses.front();
  const gait::RandomStances rests(request, {.among = std::move(good.contacts)});
  RandomStream random(request.seed, RandomUse::kGoal);
  const auto start = rests.Draw(random, kTries);
  const auto goal = rests.Draw(random, kTries);
  if (!start || !goal) return std::nullopt;
  gait::GaitRequest pair = request;
  pair.goal.emplace(*request.start_pose);
  pair.start_grasp = plan::ContactsOf(start->grasp);
  pair.goal_grasp = plan::ContactsOf(goal->grasp);
  return pair;
}

void Replay(const Contest& contest, const kinematics::HandFile& file, const HandBody& body,
            const plan::Plan& plan, Replays& replays) {
  const double begin = ProcessorSeconds();
  bench::HandTrial trial = bench::TryInHand(file, body, plan);
  if (contest.of_critical) {
    // If a plan fails anyway, its failure at less friction means nothing.
    if (trial.fault) return;
    const double critical = bench::RequiredFriction(trial, file.hand, body);
    trial = bench::TryInHand(file, body, plan, *contest.of_critical * critical / kFriction);
  }
  replays.seconds += ProcessorSeconds() - begin;
  ++replays.count;
  replays.simulated += trial.simulated_s;
  if (trial.fault) {
    ++replays.reasons[std::string(plan::ReasonName(trial.fault->reason))];
    std::cerr << body.name << ": of " << plan.steps.size() << " steps, " << trial.fault->detail
              << '\n';
    return;
  }
  ++replays.passed;
  replays.end_m.push_back(trial.off_m);
  replays.end_deg.push_back(Degrees(trial.off_rad));
}

Outcome Run(const Contest& contest, const kinematics::HandFile& file, const HandBody& body) {
  const kinematics::HandModel& hand = file.hand;
  Outcome outcome;
  for (int seed = 1; seed <= contest.seeds; ++seed) {
    gait::GaitRequest request;
    request.hand = &hand;
    request.solid = &body.solid();
    request.scale = body.scale;
    request.criteria.friction_angle = std::atan(contest.plan_mu);
    if (contest.replay) request.simulate = sim::ExecutionSimulator(file, body.solid());
    request.criteria.min_quality = contest.min_quality;
    request.turn = contest.turn;
    request.robustness = contest.robustness;
    request.seed = seed;
    if (contest.pairs) {
      const auto pair = DrawPair(request);
      if (!pair) continue;
      request = *pair;
    }
    ++outcome.asked;
    const double begin = ProcessorSeconds();
    request.deadline = ProcessorDeadline(contest.limit_s);
    const gait::GaitResult found = gait::FindGait(request);
    if (!found.gait) {
      std::cerr << body.name << ", seed " << seed << ": " << found.message << '\n';
      continue;
    }
    ++outcome.found;
    outcome.seconds.push_back(ProcessorSeconds() - begin);
    const plan::Plan plan =
        plan::ProjectPlan(body.solid(), gait::PlanOf(*found.gait, request, found.contacts));
    outcome.switches +=
        static_cast<int>(std::ranges::count(plan.steps, std::string("switch"), plan::StepKind));
    const double check = ProcessorSeconds();
    const auto fault = bench::CheckInHand(file, body, plan);
    outcome.checking += ProcessorSeconds() - check;
    if (fault) {
      ++outcome.rejected;
      std::cerr << "rejected: " << fault->detail << '\n';
    } else if (contest.replay) {
      Replay(contest, file, body, plan, outcome.replays);
    }
  }
  return outcome;
}

/// Return the time to solve for a reachable position of the fingertip, µs.
double TimeInverse(const kinematics::Finger& finger) {
  const kinematics::InverseKinematics inverse(finger);
  RandomStream random(1, RandomUse::kGaits);
  std::vector<kinematics::TipTarget> targets;
  for (int i = 0; i < 2000; ++i) {
    kinematics::JointConfiguration configuration(finger.drives);
    for (int k = 0; k < finger.drives; ++k) {
      configuration[k] = finger.lower[k] + random.Uniform() * (finger.upper[k] - finger.lower[k]);
    }
    const kinematics::TipState tip = kinematics::TipAt(finger, configuration);
    targets.push_back({tip.centre, tip.axis});
  }
  int solved = 0;
  const double begin = ProcessorSeconds();
  for (const kinematics::TipTarget& target : targets) {
    solved += static_cast<int>(inverse.Solve(target).has_value());
  }
  const double seconds = ProcessorSeconds() - begin;
  std::printf("inverse kinematics of %s: %.1f µs, %d of %zu places reached\n", finger.name.c_str(),
              1e6 * seconds / static_cast<double>(targets.size()), solved, targets.size());
  return seconds;
}

/// Measure the generation of a static grasp. This includes drawing contacts, inverse kinematics of
/// fingers until three are in contact, and collision tests of these fingers with each other, the
/// palm and the object.
void TimeRest(const kinematics::HandModel& hand, const HandBody& body) {
  gait::GaitRequest request;
  request.hand = &hand;
  request.solid = &body.solid();
  request.scale = body.scale;
  request.criteria.friction_angle = std::atan(kFriction);
  bench::GoodPoses good = bench::FindGoodPoses(request);
  request.start_pose = good.poses.front();
  const gait::RandomStances rests(request, {.among = std::move(good.contacts)});
  RandomStream random(1, RandomUse::kGaits);
  constexpr int kConfigurations = 2000;
  int free = 0;
  double seconds = 0;
  for (int i = 0; i < kConfigurations; ++i) {
    const double begin = ProcessorSeconds();
    if (!rests.TryDraw(random)) continue;
    ++free;
    seconds += ProcessorSeconds() - begin;
  }
  std::printf("a free rest of three fingers on %s: %.0f µs; %d of %d are free\n", body.name.c_str(),
              1e6 * seconds / std::max(1, free), free, kConfigurations);
}

std::string Range(const std::vector<double>& values, int digits) {
  if (values.empty()) return "-";
  return FormatFixed(*std::ranges::min_element(values), digits) + " to " +
         FormatFixed(*std::ranges::max_element(values), digits);
}

/// Print the results of the replays of a hand.
void PrintReplays(const Replays& replays) {
  if (replays.count == 0) return;
  std::printf(
      "replays: %d of %d pass; at the end %.2f mm and %.2f degrees off (median), %.2f mm and "
      "%.2f degrees (worst); %.0f s simulated, %.3f s of processor time a second\n",
      replays.passed, replays.count, 1e3 * Median(replays.end_m), Median(replays.end_deg),
      1e3 * Largest(replays.end_m), Largest(replays.end_deg), replays.simulated,
      replays.seconds / replays.simulated);
  for (const auto& [reason, times] : replays.reasons) {
    std::printf("  %s: %d\n", reason.c_str(), times);
  }
}

/// @returns row of the hand in the table.
std::string RunHand(const Contest& contest, const std::string& file,
                    const std::vector<HandBody>& bodies) {
  const kinematics::HandFile read = kinematics::ReadHandFile(file);
  const kinematics::HandModel& hand = read.hand;
  std::printf("\n%s, %zu fingers\n", hand.name.c_str(), hand.fingers.size());
  TimeInverse(hand.fingers.front());
  TimeRest(hand, bodies[std::min<std::size_t>(1, bodies.size() - 1)]);
  std::vector<TextRow> rows = {{"object", "found", "rejected", "median s", "longest s",
                                "switches a plan", "check s a plan", "replays passed"}};
  Outcome all;
  std::vector<double> medians;
  std::vector<double> switches;
  for (const HandBody& body : bodies) {
    const Outcome outcome = Run(contest, read, body);
    all.asked += outcome.asked;
    all.found += outcome.found;
    all.rejected += outcome.rejected;
    all.replays.Add(outcome.replays);
    const double plans = std::max(1, outcome.found);
    if (outcome.found > 0) {
      medians.push_back(Median(outcome.seconds));
      switches.push_back(outcome.switches / plans);
    }
    const double longest = Largest(outcome.seconds);
    rows.push_back(
        {body.name, std::to_string(outcome.found) + " of " + std::to_string(outcome.asked),
         std::to_string(outcome.rejected), FormatFixed(Median(outcome.seconds), 2),
         FormatFixed(longest, 2), FormatFixed(outcome.switches / plans, 1),
         FormatFixed(outcome.checking / plans, 2),
         std::to_string(outcome.replays.passed) + " of " + std::to_string(outcome.replays.count)});
  }
  std::printf("%s", FormatRows(rows).c_str());
  PrintReplays(all.replays);
  std::fflush(stdout);
  return "| " + hand.name + ", " + std::to_string(hand.fingers.size()) + " fingers | " +
         std::to_string(all.found) + " of " + std::to_string(all.asked) + " | " +
         Range(medians, 1) + " s | " + Range(switches, 1) + " | " + std::to_string(all.rejected) +
         " |\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Turns objects in hands.");
  Contest contest;
  std::string axis = "z";
  double degrees = 90;
  std::vector<std::string> hands;
  std::vector<std::string> only;
  app.add_option("--seeds", contest.seeds, "Number of plans per hand and object");
  app.add_option("--limit", contest.limit_s, "Time limit per plan, seconds");
  app.add_option("--axis", axis, "Rotation axis of the object: x, y or z")
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option("--degrees", degrees, "Rotation angle, degrees");
  app.add_flag("--pairs", contest.pairs, "Two grasps at one pose instead of a rotation");
  app.add_option("--reserve", contest.robustness,
                 "Robustness of plans: 0 none, 1 preferred, 2 required");
  app.add_flag("--replay", contest.replay, "Also simulate plans on the hand's actuators");
  app.add_option("--plan-mu", contest.plan_mu,
                 "Friction coefficient of the planner; the simulation has 0.8");
  app.add_option("--min-quality", contest.min_quality, "Minimum grasp quality of plans");
  app.add_option(
      "--of-critical", contest.of_critical,
      "Friction in replays of passing plans, relative to the friction that their weakest static "
      "grasp requires after rolling [default: 0.8]");
  app.add_option("--body", only, "Names of objects [default: all]");
  app.add_option("hands", hands, "Hand files")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    contest.turn = {Eigen::Vector3d::Unit(axis[0] - 'x'), Radians(degrees)};
    std::printf("%s, friction %g, at most %g s of processor time, %d seeds\n",
                contest.pairs
                    ? "pairs of grasps at one pose"
                    : ("turn of " + FormatShort(degrees, 4) + " degrees about " + axis).c_str(),
                kFriction, contest.limit_s, contest.seeds);
    std::vector<HandBody> bodies = bench::TenBodies(REGRASP_MODELS);
    if (!only.empty()) {
      std::erase_if(bodies, [&](const HandBody& body) {
        return std::ranges::find(only, body.name) == only.end();
      });
      if (bodies.empty()) throw InputError("--body: none of the bodies has such a name");
    }
    std::string table =
        "| hand | found | median of an object | switches a plan | rejected by a checker |\n"
        "| --- | --- | --- | --- | --- |\n";
    for (const std::string& hand : hands) table += RunHand(contest, hand, bodies);
    std::printf("\n%s", table.c_str());
  } catch (const std::exception& error) {
    std::cerr << "hand_bench: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
