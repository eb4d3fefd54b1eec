#include "sample_plans.h"

#include "planner/base/number.h"

namespace regrasp::plan {

namespace {

const grasp::Contact kRight{{1, 0.05, -0.1}, {-1, 0, 0}};
const grasp::Contact kLeft{{-1, -0.1, 0.05}, {1, 0, 0}};
const grasp::Contact kAbove{{0.1, -0.05, 1}, {0, 0, -1}};
const grasp::Contact kBelow{{-0.05, 0.1, -1}, {0, 0, 1}};
const grasp::Contact kBack{{0.05, 1, 0.1}, {0, -1, 0}};
const grasp::Contact kFront{{-0.1, -1, 0.05}, {0, 1, 0}};

grasp::Contact Moved(const grasp::Contact& contact, double x, double y, double z) {
  return {contact.p + Eigen::Vector3d(x, y, z), contact.n};
}

}  // namespace

Plan EmptyPlan(int dimension, int fingers, double friction_angle_deg) {
  Plan plan;
  plan.object_file = dimension == 2 ? "square.wkt" : "cube.obj";
  plan.object_sha256 = std::string(64, 'a');
  plan.scale = 0.05;
  plan.dimension = dimension;
  plan.friction_angle = Radians(friction_angle_deg);
  plan.fingers = fingers;
  plan.planner = "general";
  return plan;
}

Plan CubePlan() {
  Plan plan = EmptyPlan(3, 5, 30);
  plan.initial = {{FingerIndex(0), kRight},
                  {FingerIndex(1), kLeft},
                  {FingerIndex(2), kAbove},
                  {FingerIndex(3), kBelow}};
  plan.steps.push_back(Switch{{{FingerIndex(4), kBack}}, {FingerIndex(2)}});
  plan.steps.push_back(Switch{{{FingerIndex(2), kFront}}, {FingerIndex(3)}});
  const FingerGrasp end = {{FingerIndex(0), Moved(kRight, 0, 0.1, 0.2)},
                           {FingerIndex(1), Moved(kLeft, 0, 0.2, 0.1)},
                           {FingerIndex(4), Moved(kBack, 0.3, 0, -0.2)},
                           {FingerIndex(2), Moved(kFront, 0.2, 0, -0.1)}};
  FingerGrasp middle = end;
  middle[2].contact = Moved(kBack, 0.1, 0, 0.1);
  middle[3].contact = Moved(kFront, 0.1, 0, 0.1);
  plan.steps.push_back(Align{{{{FingerIndex(0), kRight},
                               {FingerIndex(1), kLeft},
                               {FingerIndex(2), kFront},
                               {FingerIndex(4), kBack}},
                              middle,
                              end}});
  plan.goal = ContactsOf(end);
  return plan;
}

Plan SquarePlan() {
  Plan plan = EmptyPlan(2, 4, 20);
  plan.initial = {{FingerIndex(0), {{0.1, -1, 0}, {0, 1, 0}}},
                  {FingerIndex(1), {{-0.1, 1, 0}, {0, -1, 0}}}};
  const FingerContact right = {FingerIndex(2), {{1, -0.2, 0}, {-1, 0, 0}}};
  const FingerContact left = {FingerIndex(3), {{-1, 0, 0}, {1, 0, 0}}};
  plan.steps.push_back(Switch{{right, left}, {FingerIndex(0), FingerIndex(1)}});
  FingerGrasp end = {right, left};
  for (FingerContact& held : end) held.contact.p.y() += 0.3;
  plan.steps.push_back(Align{{{right, left}, end}});
  plan.goal = ContactsOf(end);
  return plan;
}

}  // namespace regrasp::plan
