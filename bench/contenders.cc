#include "bench/contenders.h"

#include <ctime>
#include <memory>
#include <utility>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/plan_search.h"
#include "planner/roadmap/plan_roadmap.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/sets/contour/plan_contour.h"
#include "planner/sets/polygon/plan_polygon.h"
#include "planner/sets/polyhedron/plan_polyhedron.h"
#include "planner/tree/bidirectional_tree.h"
#include "planner/tree/path_plan.h"
#include "planner/tree/plan_general.h"
#include "planner/tree/subset_search.h"

namespace regrasp {

const double kMostUniform = Radians(10);

namespace {

/// Of every grasp that the planner contour takes.
constexpr int kContourContacts = 2;

GraspChoice Given(const Grasp& grasp, const char* name) {
  return {GraspChoice::Kind::kGiven, grasp, name};
}

using Query =
    std::function<PlanResult(const GraspChoice& start, const GraspChoice& goal, std::uint64_t)>;

/// A grasp that a planner does not take is a query without an answer.
Contender Whole(std::string planner, const Query& query) {
  return {std::move(planner), "", 0, [query](const GraspPair& pair, std::uint64_t seed) {
            const double begin = ProcessorSeconds();
            Answer answer;
            try {
              answer.result = query(Given(pair.start, "start"), Given(pair.goal, "goal"), seed);
            } catch (const InputError& error) {
              answer.result.status = PlanResult::Status::kNoGrasp;
              answer.result.message = error.what();
            }
            answer.seconds = ProcessorSeconds() - begin;
            return answer;
          }};
}

Contender Absent(std::string planner, std::string why) {
  return {std::move(planner), std::move(why), 0, nullptr};
}

Contender General(const Object& object, const ContestSetting& setting) {
  return Whole(kGeneral, [&object, setting](const auto& start, const auto& goal, auto seed) {
    GeneralPlanOptions options;
    options.half_angle = setting.half_angle;
    options.min_quality = setting.min_quality;
    options.seed = seed;
    return PlanGeneral(object, start, goal, options);
  });
}

/// The stages of PlanGeneral up to the first sequence. What the plan is worth is found out after
/// the clock has stopped.
Contender GeneralSearch(const Object& object, const ContestSetting& setting) {
  const auto source = std::make_shared<const SurfaceSampler>(object);
  const auto ask = [&object, setting, source](const GraspPair& pair, std::uint64_t seed) {
    const double begin = ProcessorSeconds();
    RandomStream random(seed, RandomUse::kCandidates);
    SearchSpace space(object, {setting.half_angle, setting.min_quality});
    space.SetLimits({.most_tests = GeneralPlanOptions::kDefaultEffort});
    const ContactSet from = space.Add(pair.start);
    const ContactSet to = space.Add(pair.goal);
    space.Accept(from);
    space.Accept(to);
    auto path = SearchOwnSubsets(from, to, space);
    if (!path) path = BidirectionalTree(from, to, *source, random, space).Join();
    Answer answer;
    answer.seconds = ProcessorSeconds() - begin;
    answer.result.status = PlanResult::Status::kNoSequence;
    if (path) {
      const GraspEvaluator evaluator(object, {setting.half_angle, setting.min_quality});
      answer.result = ResultOf(MakeCandidate(*path, pair.start, space), evaluator, kGeneral,
                               space.fingers(), pair.goal);
    }
    return answer;
  };
  return {"general (search only)", "", 0, ask};
}

Contender OnPolyhedron(const Polyhedron& solid, const ContestSetting& setting) {
  if (solid.face_count() > kMostGraphFaces) {
    return Absent("polyhedron", std::to_string(solid.face_count()) + " faces");
  }
  PolyhedronPlanOptions options;
  options.half_angle = setting.half_angle;
  options.min_quality = setting.min_quality;
  const bool uniform = setting.half_angle <= kMostUniform;
  options.spanning = uniform ? Spanning::kUniform : Spanning::kAdaptive;
  const double begin = ProcessorSeconds();
  const auto graph = std::make_shared<PolyhedronGraph>(solid, setting.half_angle, options.spanning);
  const double seconds = ProcessorSeconds() - begin;
  if (graph->vertex_count() == 0) {
    return Absent("polyhedron", uniform ? "no focus cell (uniform)" : "no focus cell (adaptive)");
  }
  Contender contender =
      Whole("polyhedron", [&solid, options, graph](const auto& start, const auto& goal, auto seed) {
        PolyhedronPlanOptions own = options;
        own.seed = seed;
        return PlanOnPolyhedron(solid, *graph, start, goal, own);
      });
  contender.build_seconds = seconds;
  return contender;
}

Contender OnRoadmap(const Polyhedron& solid, const ContestSetting& setting) {
  return Whole("roadmap", [&solid, setting](const auto& start, const auto& goal, auto seed) {
    const RoadmapSize size = ChooseRoadmapSize(solid, std::nullopt, std::nullopt);
    RoadmapOptions options;
    options.half_angle = setting.half_angle;
    options.contacts = size.contacts;
    options.clusters = size.clusters;
    options.seed = seed;
    options.min_quality = setting.min_quality;
    return PlanResult(PlanOnRoadmap(solid, start, goal, options));
  });
}

Contender OnPolygon(const Polygon& polygon, const ContestSetting& setting) {
  return Whole("polygon", [&polygon, setting](const auto& start, const auto& goal, auto seed) {
    PolygonPlanOptions options;
    options.half_angle = setting.half_angle;
    options.min_quality = setting.min_quality;
    options.seed = seed;
    return PlanOnPolygon(polygon, start, goal, options);
  });
}

Contender OnContour(const Polygon& polygon, const ContestSetting& setting) {
  return Whole("contour", [&polygon, setting](const auto& start, const auto& goal, auto seed) {
    ContourPlanOptions options;
    options.half_angle = setting.half_angle;
    options.min_quality = setting.min_quality;
    options.seed = seed;
    return PlanOnContour(polygon, start, goal, options);
  });
}

}  // namespace

double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  constexpr double kNanosecond = 1e-9;
  return static_cast<double>(now.tv_sec) + kNanosecond * static_cast<double>(now.tv_nsec);
}

std::vector<Contender> MakeContenders(const Object& object, const ContestSetting& setting) {
  std::vector<Contender> contenders = {General(object, setting), GeneralSearch(object, setting)};
  if (const auto* solid = dynamic_cast<const Polyhedron*>(&object)) {
    contenders.push_back(OnPolyhedron(*solid, setting));
    contenders.push_back(OnRoadmap(*solid, setting));
  } else {
    const auto& polygon = dynamic_cast<const Polygon&>(object);
    contenders.push_back(OnPolygon(polygon, setting));
    if (setting.most_contacts == kContourContacts) {
      contenders.push_back(OnContour(polygon, setting));
    }
  }
  return contenders;
}

}  // namespace regrasp
