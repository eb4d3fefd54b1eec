#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "planner/grasp/force_closure.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/sets/polyhedron/polyhedron_model.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "planner/sets/set_parameters.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace align_force_closure_test {

constexpr int kPlans = 200;
constexpr int kPlansOfControls = 60;

/// Number of tested grasps between two waypoints, including both.
constexpr int kSamples = 65;

/// A solid with the graph on which plans are made.
struct PlanningCase {
  std::string name;
  const object::Polyhedron* body;
  planning::PlanRequest options;
  std::unique_ptr<PolyhedronGraph> graph;
};

std::vector<NamedBody> Bodies() {
  std::vector<NamedBody> bodies;
  for (const std::string name : {"stone", "tetrahedron", "body14", "body24", "body36", "body38"}) {
    bodies.push_back({name, ReadSolidModel(name + ".obj")});
  }
  for (const NamedBody& small : SmallBodies()) bodies.push_back(small);
  return bodies;
}

/// Return objects, friction angles and spanning rules with a non-empty graph.
std::vector<PlanningCase> Cases(const std::vector<NamedBody>& bodies) {
  std::vector<PlanningCase> cases;
  for (const NamedBody& named : bodies) {
    for (const auto& [degrees, spanning] : {std::pair{10.0, planning::Spanning::kUniform},
                                            {14.0, planning::Spanning::kUniform},
                                            {10.0, planning::Spanning::kAdaptive},
                                            {20.0, planning::Spanning::kAdaptive}}) {
      PlanningCase made{named.name + ", " + std::to_string(degrees) + "°, " + Name(spanning),
                        &named.body,
                        {},
                        {}};
      made.options.criteria.friction_angle = Radians(degrees);
      made.options.parameters.Edit<sets::SetParameters>().spanning = spanning;
      made.graph = std::make_unique<PolyhedronGraph>(named.body, Radians(degrees), spanning);
      if (made.graph->vertex_count() > 0) cases.push_back(std::move(made));
    }
  }
  return cases;
}

struct Tally {
  int aligns = 0;
  int segments = 0;
  int grasps = 0;
  int not_closed = 0;
};

/// Test every sampled grasp between waypoints with the common force-closure function.
Tally Walk(const plan::Align& align, const object::WrenchFrame& frame, double friction_angle) {
  Tally tally{1};
  for (std::size_t w = 0; w + 1 < align.waypoints.size(); ++w) {
    motion::GraspMotion motion;
    for (std::size_t k = 0; k < align.waypoints[w].size(); ++k) {
      EXPECT_EQ(align.waypoints[w][k].finger, align.waypoints[w + 1][k].finger);
      motion.emplace_back(align.waypoints[w][k].contact, align.waypoints[w + 1][k].contact);
    }
    ++tally.segments;
    for (int i = 0; i < kSamples; ++i) {
      const double t = static_cast<double>(i) / (kSamples - 1);
      tally.not_closed +=
          grasp::IsForceClosure(motion::GraspAt(motion, t), frame, friction_angle) ? 0 : 1;
      ++tally.grasps;
    }
  }
  return tally;
}

void Add(const Tally& more, Tally& sum) {
  sum.aligns += more.aligns;
  sum.segments += more.segments;
  sum.grasps += more.grasps;
  sum.not_closed += more.not_closed;
}

/// Visit `count` random plans.
/// @returns number of visited plans.
template <typename Visit>
int ForEachPlan(int count, Visit visit) {
  const std::vector<NamedBody> bodies = Bodies();
  const std::vector<PlanningCase> cases = Cases(bodies);
  EXPECT_GE(cases.size(), 25u);
  int plans = 0;
  for (std::uint64_t seed = 1; plans < count && seed <= kPlans; ++seed) {
    for (const PlanningCase& one : cases) {
      if (plans == count) break;
      planning::PlanRequest options = one.options;
      options.seed = seed;
      const planning::GraspChoice random{planning::GraspChoice::Kind::kRandom, {}, "random"};
      const planning::PlanResult result =
          PlanWith(PolyhedronPlanner(one.graph.get()), *one.body, random, random, options);
      if (result.status == planning::PlanResult::Status::kNoGrasp)
        continue;  // no grasp meets the criteria
      SCOPED_TRACE(one.name + ", seed " + std::to_string(seed));
      EXPECT_EQ(result.status, planning::PlanResult::Status::kFound) << result.message;
      if (!result.plan) continue;
      ++plans;
      visit(one, *result.plan);
    }
  }
  return plans;
}

TEST(AlignsOfPolyhedra, EveryGraspAlongEveryAlignOfTwoHundredPlansIsForceClosure) {
  Tally all;
  std::map<std::string, int> aligns_of_body;
  const int plans = ForEachPlan(kPlans, [&](const PlanningCase& one, const plan::Plan& plan) {
    for (const plan::Step& step : plan.steps) {
      const auto* align = std::get_if<plan::Align>(&step);
      if (!align) continue;
      EXPECT_GE(align->waypoints.size(), 2u);
      const Tally walked =
          Walk(*align, one.body->wrench_frame(), one.options.criteria.friction_angle);
      EXPECT_EQ(walked.not_closed, 0);
      Add(walked, all);
      ++aligns_of_body[one.name.substr(0, one.name.find(','))];
    }
  });
  EXPECT_EQ(plans, kPlans);
  EXPECT_GE(all.aligns, 200);
  EXPECT_GT(all.segments, all.aligns) << "no align goes from piece to piece";
  EXPECT_EQ(all.grasps, all.segments * kSamples);
  EXPECT_GE(aligns_of_body.size(), 9u);
  RecordProperty("aligns", all.aligns);
  RecordProperty("segments", all.segments);
}

/// Visit the sliding steps of plans with Spanning::kUniform.
///
/// With uniform spanning, the forces of any three contacts of a grasp do not balance, wherever in
/// their cones they are. The forces of all four contacts have one linear relation only, with four
/// positive factors (Phoka 2010, 5.2).
template <typename Visit>
int ForEachUniformAlign(Visit visit) {
  int aligns = 0;
  ForEachPlan(kPlansOfControls, [&](const PlanningCase& one, const plan::Plan& plan) {
    if (sets::SpanningOf(one.options) != planning::Spanning::kUniform) return;
    for (const plan::Step& step : plan.steps) {
      if (const auto* align = std::get_if<plan::Align>(&step)) {
        visit(one, *align);
        ++aligns;
      }
    }
  });
  return aligns;
}

TEST(AlignsOfPolyhedra, AWayWithAContactPushedOffIsFoundNotForceClosure) {
  const int pushed = ForEachUniformAlign([](const PlanningCase& one, const plan::Align& align) {
    // Moved so far along its own plane that no other torque balances the torque of its force.
    plan::Align off = align;
    for (plan::FingerGrasp& grasp : off.waypoints) {
      grasp::Contact& contact = grasp.front().contact;
      contact.p += 1000 * one.body->diameter() * contact.n.unitOrthogonal();
    }
    const Tally walked = Walk(off, one.body->wrench_frame(), one.options.criteria.friction_angle);
    EXPECT_EQ(walked.not_closed, walked.grasps);
    // A single invalid waypoint between valid ones makes the path invalid.
    plan::Align bent = align;
    bent.waypoints.insert(bent.waypoints.begin() + 1, off.waypoints.front());
    EXPECT_GT(Walk(bent, one.body->wrench_frame(), one.options.criteria.friction_angle).not_closed,
              0);
  });
  EXPECT_GE(pushed, 20);
}

TEST(AlignsOfPolyhedra, AWayWithAContactOnTheWrongSideIsFoundNotForceClosure) {
  const int turned = ForEachUniformAlign([](const PlanningCase& one, const plan::Align& align) {
    // A contact normal that points out of the object instead of into it.
    plan::Align wrong = align;
    for (plan::FingerGrasp& grasp : wrong.waypoints) grasp.front().contact.n *= -1;
    const Tally walked = Walk(wrong, one.body->wrench_frame(), one.options.criteria.friction_angle);
    EXPECT_EQ(walked.not_closed, walked.grasps);
  });
  EXPECT_GE(turned, 20);
}

}  // namespace align_force_closure_test
}  // namespace regrasp::polyhedron
