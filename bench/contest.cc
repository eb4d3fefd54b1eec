#include "bench/contest.h"

#include <algorithm>

#include "bench/plan_figures.h"
#include "bench/processor_clock.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp {

namespace {

constexpr std::uint64_t kDrawSeed = 1;

std::optional<grasp::Grasp> Draw(const object::Object& object, const ContestSetting& setting,
                                 const criteria::GraspEvaluator& evaluator, RandomStream& random) {
  const grasp::ContactLimits contacts = {setting.fewest_contacts, setting.most_contacts};
  try {
    return sampling::DrawOnSurface(object, contacts, evaluator, random, "");
  } catch (const sampling::NoGrasp&) {
    return std::nullopt;
  }
}

PairAnswer AnswerOf(const Answer& answer, double diameter) {
  PairAnswer of_pair;
  of_pair.seconds = answer.seconds;
  const std::optional<plan::Plan>& plan = answer.result.plan;
  if (!plan) return of_pair;
  of_pair.joined = true;
  of_pair.steps = static_cast<int>(plan->steps.size());
  of_pair.aligns = CountAligns(*plan);
  of_pair.margin = answer.result.margin;
  of_pair.travel = TravelOf(*plan) / diameter;
  of_pair.good = answer.result.warnings.empty();
  return of_pair;
}

}  // namespace

int Standing::JoinedOf(std::size_t pairs) const {
  const auto end = answers.begin() + static_cast<std::ptrdiff_t>(std::min(pairs, answers.size()));
  return static_cast<int>(
      std::count_if(answers.begin(), end, [](const PairAnswer& answer) { return answer.joined; }));
}

std::vector<GraspPair> DrawPairs(const object::Object& object, const ContestSetting& setting,
                                 const ContestLimits& limits) {
  const criteria::GraspEvaluator evaluator(object, {setting.friction_angle, setting.min_quality});
  RandomStream of_start(kDrawSeed, RandomUse::kStart);
  RandomStream of_goal(kDrawSeed, RandomUse::kGoal);
  std::vector<GraspPair> pairs;
  const double begin = ProcessorSeconds();
  while (static_cast<int>(pairs.size()) < limits.pairs &&
         ProcessorSeconds() - begin < limits.seconds) {
    const auto start = Draw(object, setting, evaluator, of_start);
    const auto goal = start ? Draw(object, setting, evaluator, of_goal) : std::nullopt;
    if (!goal) break;
    pairs.push_back({*start, *goal});
  }
  return pairs;
}

Contest RunContest(const object::Object& object, const std::vector<GraspPair>& pairs,
                   const std::vector<Contender>& contenders, double seconds) {
  Contest contest;
  contest.pairs = static_cast<int>(pairs.size());
  for (const Contender& contender : contenders) {
    Standing standing{contender.planner, contender.absent, contender.build_seconds, {}};
    double spent = 0;
    for (std::size_t i = 0; contender.ask && i < pairs.size() && spent < seconds; ++i) {
      standing.answers.push_back(AnswerOf(contender.ask(pairs[i], i), object.diameter()));
      spent += standing.answers.back().seconds;
    }
    contest.standings.push_back(std::move(standing));
  }
  return contest;
}

std::optional<std::string> FindBetterThanGeneral(const Contest& contest) {
  const auto general = std::ranges::find(contest.standings, kGeneral, &Standing::planner);
  for (const Standing& other : contest.standings) {
    const std::size_t both = std::min(general->answers.size(), other.answers.size());
    if (other.JoinedOf(both) > general->JoinedOf(both)) return other.planner;
  }
  return std::nullopt;
}

}  // namespace regrasp
