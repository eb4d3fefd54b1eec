#include "bench/contenders.h"

#include <memory>
#include <utility>

#include "bench/processor_clock.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/sets/set_parameters.h"
#include "planner/tree/bidirectional_tree.h"
#include "planner/tree/subset_search.h"
#include "planner/tree/tree_planner.h"

namespace regrasp {

const double kMostUniform = Radians(10);

namespace {

/// Number of contacts of a grasp of the planner contour.
constexpr int kContourContacts = 2;

planning::PlanRequest RequestFor(const object::Object& object, const ContestSetting& setting,
                                 const GraspPair& pair, std::uint64_t seed) {
  return {.object = &object,
          .start = {planning::GraspChoice::Kind::kGiven, pair.start, "start"},
          .goal = {planning::GraspChoice::Kind::kGiven, pair.goal, "goal"},
          .criteria = {setting.friction_angle, setting.min_quality},
          .seed = seed};
}

/// A grasp that a planner does not accept is a query without an answer.
template <typename Ask>
Answer Timed(const Ask& ask) {
  const double begin = ProcessorSeconds();
  Answer answer;
  try {
    answer.result = ask();
  } catch (const InputError& error) {
    answer.result.status = planning::PlanResult::Status::kNoGrasp;
    answer.result.message = error.what();
  }
  answer.seconds = ProcessorSeconds() - begin;
  return answer;
}

/// Run a planner of the registry, which builds its data for each query.
Contender Whole(const planning::Planner& planner, const object::Object& object,
                const ContestSetting& setting) {
  const auto ask = [&planner, &object, setting](const GraspPair& pair, std::uint64_t seed) {
    return Timed([&] { return planning::Solve(planner, RequestFor(object, setting, pair, seed)); });
  };
  return {planner.name(), "", 0, ask};
}

Contender Absent(std::string planner, std::string why) {
  return {std::move(planner), std::move(why), 0, nullptr};
}

/// Run the stages of TreePlanner up to the first sequence. The plan is evaluated after the clock
/// has stopped.
Contender GeneralSearch(const object::Object& object, const ContestSetting& setting) {
  const auto source = std::make_shared<const sampling::SurfaceSampler>(object);
  const auto ask = [&object, setting, source](const GraspPair& pair, std::uint64_t seed) {
    const double begin = ProcessorSeconds();
    RandomStream random(seed, RandomUse::kCandidates);
    tree::SearchSpace space(object, {setting.friction_angle, setting.min_quality});
    space.SetLimits({.most_tests = tree::TreePlanner::kDefaultTests});
    const criteria::ContactSet from = space.Add(pair.start);
    const criteria::ContactSet to = space.Add(pair.goal);
    space.Accept(from);
    space.Accept(to);
    auto path = tree::SearchOwnSubsets(from, to, space);
    if (!path) path = tree::BidirectionalTree(from, to, *source, random, space).Join();
    Answer answer;
    answer.seconds = ProcessorSeconds() - begin;
    answer.result.status = planning::PlanResult::Status::kNoSequence;
    if (path) {
      planning::PlanRequest request = RequestFor(object, setting, pair, seed);
      request.hand.fingers = space.fingers();
      const criteria::GraspEvaluator evaluator(object, request.criteria);
      answer.result = planning::ResultOf(tree::MakeCandidate(*path, pair.start, space), evaluator,
                                         kGeneral, request, pair.goal);
    }
    return answer;
  };
  return {"general (search only)", "", 0, ask};
}

Contender OnPolyhedron(const object::Polyhedron& solid, const ContestSetting& setting) {
  if (solid.face_count() > kMostGraphFaces) {
    return Absent("polyhedron", std::to_string(solid.face_count()) + " faces");
  }
  const bool uniform = setting.friction_angle <= kMostUniform;
  const double begin = ProcessorSeconds();
  const auto graph = std::make_shared<polyhedron::PolyhedronGraph>(
      solid, setting.friction_angle,
      uniform ? planning::Spanning::kUniform : planning::Spanning::kAdaptive);
  const double seconds = ProcessorSeconds() - begin;
  if (graph->vertex_count() == 0) {
    return Absent("polyhedron", uniform ? "no focus cell (uniform)" : "no focus cell (adaptive)");
  }
  const auto ask = [&solid, setting, graph](const GraspPair& pair, std::uint64_t seed) {
    planning::PlanRequest request = RequestFor(solid, setting, pair, seed);
    request.parameters.Edit<sets::SetParameters>().spanning = setting.friction_angle <= kMostUniform
                                                                  ? planning::Spanning::kUniform
                                                                  : planning::Spanning::kAdaptive;
    return Timed(
        [&] { return planning::Solve(polyhedron::PolyhedronPlanner(graph.get()), request); });
  };
  return {"polyhedron", "", seconds, ask};
}

}  // namespace

std::vector<Contender> MakeContenders(const object::Object& object, const ContestSetting& setting) {
  const auto whole = [&](const char* name) {
    return Whole(*registry::FindPlanner(name), object, setting);
  };
  std::vector<Contender> contenders = {whole(kGeneral), GeneralSearch(object, setting)};
  if (const auto* solid = dynamic_cast<const object::Polyhedron*>(&object)) {
    contenders.push_back(OnPolyhedron(*solid, setting));
    contenders.push_back(whole("roadmap"));
  } else {
    contenders.push_back(whole("polygon"));
    if (setting.most_contacts == kContourContacts) {
      contenders.push_back(whole("contour"));
    }
  }
  return contenders;
}

}  // namespace regrasp
