#include "sim/hand/check_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan_io.h"
#include "planner/plan/projection.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {
namespace check_hand_test {

using Eigen::Vector3d;
using plan::Reason;

const std::string kHand = ProjectPath("models/hands/ring4.json");

const object::Polyhedron& Cube() {
  static const object::ObjectFile file = object::ReadObject(ProjectPath("models/cube.obj"));
  return dynamic_cast<const object::Polyhedron&>(*file.object);
}

gait::GaitRequest RequestForTheCube() {
  static const kinematics::HandModel hand = kinematics::ReadHand(kHand);
  gait::GaitRequest request;
  request.hand = &hand;
  request.solid = &Cube();
  request.scale = 0.8;
  request.criteria.friction_angle = std::atan(0.8);
  return request;
}

/// Return a plan with in-hand motions and finger switches, made once.
const plan::Plan& GoodPlan() {
  static const plan::Plan plan = [] {
    gait::GaitRequest request = RequestForTheCube();
    request.turn = {Vector3d::UnitZ(), Radians(200)};
    request.seed = 1;
    const gait::GaitResult found = gait::FindGait(request);
    EXPECT_TRUE(found.gait) << found.message;
    return plan::ProjectPlan(Cube(), gait::PlanOf(*found.gait, request, found.contacts));
  }();
  return plan;
}

/// Return a plan from one grasp to another at one pose, each the first of a seed.
plan::Plan Regrasp(std::uint64_t seed) {
  gait::GaitRequest request = RequestForTheCube();
  request.robustness = gait::RobustnessLevel::kNone;
  const auto first_grasp = [&](std::uint64_t of_seed) {
    request.seed = of_seed;
    const gait::GaitResult found = gait::FindGait(request);
    EXPECT_TRUE(found.gait) << found.message;
    request.start_pose = found.gait->start.pose;
    grasp::Grasp grasp;
    for (const int contact : found.gait->initial) {
      if (contact != gait::kNone) grasp.push_back(found.contacts[contact]);
    }
    return grasp;
  };
  const grasp::Grasp start = first_grasp(seed);
  const grasp::Grasp goal = first_grasp(seed + 1000);
  request.start_grasp = start;
  request.goal_grasp = goal;
  request.goal.emplace(*request.start_pose);
  const gait::GaitResult found = gait::FindGait(request);
  if (!found.gait) return {};
  return plan::ProjectPlan(Cube(), gait::PlanOf(*found.gait, request, found.contacts));
}

/// Return true if a slide of the plan has a first segment long enough to require intermediate
/// states.
bool HasLongSlide(const plan::Plan& plan) {
  for (const plan::Step& step : plan.steps) {
    const auto* align = std::get_if<plan::Align>(&step);
    if (align != nullptr) return align->motion->front().size() > 3;
  }
  return false;
}

/// Return a regrasp at one pose with slides, made once.
const plan::Plan& SlidingPlan() {
  static const plan::Plan plan = [] {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
      plan::Plan regrasp = Regrasp(seed);
      if (HasLongSlide(regrasp)) return regrasp;
    }
    ADD_FAILURE() << "no regrasp slides";
    return GoodPlan();
  }();
  return plan;
}

int FirstOf(const plan::Plan& plan, const std::string& kind) {
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (plan::StepKind(plan.steps[i]) == kind) return static_cast<int>(i);
  }
  ADD_FAILURE() << "no " << kind;
  return 0;
}

plan::Move& FirstMove(plan::Plan& plan) {
  return std::get<plan::Move>(plan.steps[FirstOf(plan, "move")]);
}
/// Return the step whose in-hand motion has the most states.
int LongestMove(const plan::Plan& plan) {
  const auto states = [](const plan::Step& step) {
    const auto* move = std::get_if<plan::Move>(&step);
    return move == nullptr ? 0 : move->path.size();
  };
  return static_cast<int>(std::ranges::max_element(plan.steps, {}, states) - plan.steps.begin());
}
plan::Switch& FirstSwitch(plan::Plan& plan) {
  return std::get<plan::Switch>(plan.steps[FirstOf(plan, "switch")]);
}

TEST(CheckHandTest, APlanOfTheSearchPasses) {
  const auto faults = CheckHand(kHand, Cube(), GoodPlan());
  for (const plan::HandFault& fault : faults) {
    ADD_FAILURE() << "entry " << fault.entry << ": " << ReasonName(fault.reason) << ": "
                  << fault.detail;
  }
  EXPECT_TRUE(plan::CheckPlan(Cube(), GoodPlan()).passed());
}

/// Fixture of the ring hand, in whose model joint 3 of each finger is coupled to joint 2.
class CoupledHandTest : public FolderTest {
 protected:
  CoupledHandTest() {
    std::string model = ReadFile(ProjectPath("models/hands/ring4.xml"));
    std::string equalities = "<equality>";
    Json hand = ParseJson(ReadFile(kHand), kHand);
    for (int finger = 0; finger < 4; ++finger) {
      const std::string joint = "finger" + std::to_string(finger) + "_joint";
      equalities += "<joint joint1=\"" + joint + "3\" joint2=\"" + joint +
                    "2\" polycoef=\"0.2 1.06 0 0 0\"/>";
      hand["couplings"].push_back(
          {{"joint", joint + "3"}, {"follows", joint + "2"}, {"ratio", 1.06}, {"offset", 0.2}});
    }
    model.insert(model.rfind("</mujoco>"), equalities + "</equality>");
    Write("ring4.xml", model);
    file_ = kinematics::ReadHandFile(Write("ring4.json", FormatJson(hand)));
  }
  kinematics::HandFile file_;
};

TEST_F(CoupledHandTest, APlanOfTheSearchKeepsTheCouplings) {
  gait::GaitRequest request = RequestForTheCube();
  request.hand = &file_.hand;
  request.robustness = gait::RobustnessLevel::kNone;
  request.turn = {Vector3d::UnitZ(), Radians(10)};
  const gait::GaitResult found = gait::FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  const plan::Plan plan =
      plan::ProjectPlan(Cube(), gait::PlanOf(*found.gait, request, found.contacts));
  for (const std::vector<double>& joints : plan.hand->initial.joints) {
    EXPECT_NEAR(joints[3], 0.2 + 1.06 * joints[2], 1e-9);
  }
  for (const plan::HandFault& fault : CheckHand(file_, Cube(), plan)) {
    ADD_FAILURE() << ReasonName(fault.reason) << ": " << fault.detail;
  }
}

/// A plan of the hand with free joints.
TEST_F(CoupledHandTest, AJointOffItsCouplingIsNamed) {
  plan::Plan plan = GoodPlan();
  plan.hand->sha256 = file_.hand.sha256;
  const auto expect_fails = [&](const std::string& source) {
    const auto faults = CheckHand(file_, Cube(), plan);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].reason, Reason::kCouplingViolated);
    EXPECT_THAT(faults[0].detail, testing::HasSubstr(source));
    EXPECT_THAT(faults[0].detail, testing::HasSubstr("_joint3 of finger "));
    ASSERT_EQ(faults[0].fault.fingers.size(), 1U);
  };
  expect_fails("equality constraint of joint finger");
  file_.description.couplings.clear();
  expect_fails("equality constraint of joint finger");
  kinematics::HandFile free = kinematics::ReadHandFile(kHand);
  plan.hand->sha256 = free.hand.sha256;
  EXPECT_TRUE(CheckHand(free, Cube(), plan).empty());
  // A coupling that only the file has.
  file_ = free;
  file_.description.couplings = {{"finger2_joint3", "finger2_joint2", 1, 0}};
  expect_fails("coupling of joint finger2_joint3 in the hand's file");
}

/// Fixture of the ring hand, whose fingertip bodies have another geom.
class CheckedTipGeometryTest : public FolderTest {
 protected:
  std::vector<plan::HandFault> FaultsWith(const std::string& geom) {
    std::string model = ReadFile(ProjectPath("models/hands/ring4.xml"));
    for (int finger = 0; finger < 4; ++finger) {
      const std::string tip = "<geom name=\"finger" + std::to_string(finger) + "_tip\"";
      const std::size_t at = model.find(tip);
      EXPECT_NE(at, std::string::npos);
      model.insert(at, geom);
    }
    Write("ring4.xml", model);
    const kinematics::HandFile file =
        kinematics::ReadHandFile(Write("ring4.json", ReadFile(kHand)));
    plan::Plan plan = GoodPlan();
    plan.hand->sha256 = file.hand.sha256;
    return CheckHand(file, Cube(), plan);
  }
};

/// The plate is in the object at every contact, which only the replay limits. Plates of two fingers
/// at one cube touch each other.
TEST_F(CheckedTipGeometryTest, GeometryOfFingertipsMustNotTouchOtherLinks) {
  EXPECT_THAT(FaultsWith(R"(<geom size="0.009" pos="0 0 0.02"/>)"), testing::IsEmpty());
  EXPECT_THAT(FaultsWith(R"(<geom size="0.011" pos="0 0 0.024"/>)"), testing::IsEmpty());
  const auto faults = FaultsWith(R"(<geom type="box" size="0.04 0.04 0.004" pos="0 0 0.02"/>)");
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].reason, Reason::kHandCollides);
  EXPECT_THAT(faults[0].detail, testing::HasSubstr("_distal of finger "));
}

TEST(CheckHandTest, AFileReadAgainPassesToo) {
  for (plan::Plan plan : {GoodPlan(), SlidingPlan()}) {
    plan.object_sha256 = std::string(64, '0');
    const plan::Plan again = plan::ParsePlan(plan::FormatPlan(plan), "plan");
    EXPECT_THAT(CheckHand(kHand, Cube(), plan::ProjectPlan(Cube(), again)), testing::IsEmpty());
    EXPECT_TRUE(again.hand);
    EXPECT_EQ(again.steps.size(), plan.steps.size());
  }
}

plan::Align& FirstAlign(plan::Plan& plan) {
  return std::get<plan::Align>(plan.steps[FirstOf(plan, "align")]);
}

TEST(CheckHandTest, ASlideIsFollowedAllTheWay) {
  EXPECT_THAT(CheckHand(kHand, Cube(), SlidingPlan()), testing::IsEmpty());
  struct Change {
    const char* name;
    Reason reason;
    const char* words;
    std::function<void(plan::Align&)> change;
  };
  const std::vector<Change> changes = {
      {"no paths", Reason::kHandJumps, "path of the hand not found",
       [](auto& align) { align.motion.reset(); }},
      {"a path too few", Reason::kHandJumps, "for its waypoints",
       [](auto& align) { align.motion->pop_back(); }},
      {"one state", Reason::kHandJumps, "path to waypoint 1 must have at least two states",
       [](auto& align) { align.motion->front().resize(1); }},
      {"the finger stays behind", Reason::kTipOffContact, "tip of finger",
       [](auto& align) {
         plan::HandPath& path = align.motion->front();
         path.insert(path.begin(), path.front());
       }},
      {"the finger stops before the end", Reason::kTipOffContact, "tip of finger",
       [](auto& align) { align.motion->back().back() = align.motion->back().front(); }},
      {"states are left out", Reason::kTipOffContact, "tip of finger",
       [](auto& align) {
         plan::HandPath& path = align.motion->front();
         path.erase(path.begin() + 1, path.end() - 1);
       }},
      {"the object moves", Reason::kHandJumps, "moves while fingers slide",
       [](auto& align) { align.motion->front().back().pose.translation().x() += 1e-6; }},
      {"it begins elsewhere", Reason::kHandJumps, "begins the step",
       [](auto& align) { align.motion->front().front().joints[0][0] += 1e-6; }},
  };
  for (const Change& change : changes) {
    plan::Plan plan = SlidingPlan();
    change.change(FirstAlign(plan));
    const auto faults = CheckHand(kHand, Cube(), plan);
    ASSERT_EQ(faults.size(), 1U) << change.name;
    EXPECT_EQ(faults[0].reason, change.reason) << change.name << ": " << faults[0].detail;
    EXPECT_EQ(faults[0].entry, FirstOf(plan, "align") + 1) << change.name;
    EXPECT_THAT(faults[0].detail, testing::HasSubstr(change.words)) << change.name;
  }
}

struct Control {
  const char* name;
  Reason reason;
  const char* words;
  std::function<int(plan::Plan&)> change;  ///< applies the change; returns the failing entry
};

/// Each single change fails for its own reason.
TEST(CheckHandTest, EachFaultIsFoundWhereItIs) {
  const std::vector<Control> controls = {
      {"a posture that is not where the contact is", Reason::kTipOffContact, "tip of finger",
       [](plan::Plan& plan) {
         plan.hand->initial.joints[plan.initial.front().finger][2] += 0.001;
         return 0;
       }},
      {"a contact elsewhere", Reason::kTipOffContact, "tip of finger",
       [](plan::Plan& plan) {
         plan.initial.front().contact.p += 1e-4 * plan.initial.front().contact.n.unitOrthogonal();
         return 0;
       }},
      {"a joint beyond its limit", Reason::kJointLimit, "limits ",
       [](plan::Plan& plan) {
         for (FingerIndex finger{0}; finger < plan.fingers; ++finger) {
           if (plan::FindFinger(plan.initial, finger) != nullptr) continue;
           plan.hand->initial.joints[finger][0] = 1.7;
           return 0;
         }
         return -1;
       }},
      {"the object jumps", Reason::kHandJumps, "object begins the step",
       [](plan::Plan& plan) {
         FirstMove(plan).path.front().pose.translation().x() += 1e-6;
         return FirstOf(plan, "move") + 1;
       }},
      {"a joint jumps", Reason::kHandJumps, "begins the step",
       [](plan::Plan& plan) {
         FirstSwitch(plan).motion->place.front().joints[0][0] += 1e-6;
         return FirstOf(plan, "switch") + 1;
       }},
      {"a finger is missing", Reason::kHandJumps, "has 3 fingers, expected 4",
       [](plan::Plan& plan) {
         FirstMove(plan).path.back().joints.pop_back();
         return FirstOf(plan, "move") + 1;
       }},
      {"a joint is missing", Reason::kHandJumps, "3 joints of finger 2 (finger2), expected 4",
       [](plan::Plan& plan) {
         FirstMove(plan).path.back().joints[2].pop_back();
         return FirstOf(plan, "move") + 1;
       }},
      {"no path", Reason::kHandJumps, "path of the hand not found",
       [](plan::Plan& plan) {
         FirstSwitch(plan).motion.reset();
         return FirstOf(plan, "switch") + 1;
       }},
      {"a move of few states", Reason::kTipOffContact, "tip of finger",
       [](plan::Plan& plan) {
         const int step = LongestMove(plan);
         plan::HandPath& path = std::get<plan::Move>(plan.steps[step]).path;
         path.erase(path.begin() + 1, path.end() - 1);
         return step + 1;
       }},
      {"the object ends at another pose", Reason::kGoalNotReached, "from its goal",
       [](plan::Plan& plan) {
         plan.hand->goal.translation().z() += 1e-5;
         return static_cast<int>(plan.steps.size());
       }},
      {"the object of a plan without steps has another goal", Reason::kGoalNotReached,
       "from its goal",
       [](plan::Plan& plan) {
         plan.steps.clear();
         plan.goal = plan::ContactsOf(plan.initial);
         plan.hand->goal = plan.hand->initial.pose;
         plan.hand->goal.translation().z() += 1e-5;
         return 0;
       }},
      {"the object is outside its goal set", Reason::kGoalNotReached, "outside its goal set",
       [](plan::Plan& plan) {
         const Vector3d down = plan.hand->goal.linear() * -Vector3d::UnitX();
         const plan::FacingGoal other{Vector3d::UnitX(), down, 0.5};
         plan.hand->goals = {{"", static_cast<int>(plan.steps.size()), plan::GoalSet(other)}};
         return static_cast<int>(plan.steps.size());
       }},
      {"an earlier goal is missed", Reason::kGoalNotReached, "outside the set of goal \"b\"",
       [](plan::Plan& plan) {
         Eigen::Isometry3d high = plan.hand->initial.pose;
         plan.hand->goals = {{"a", 0, plan::GoalSet(high)}};
         high.translation().z() += 0.02;
         plan.hand->goals.push_back({"b", 0, plan::GoalSet(high)});
         return 0;
       }},
  };
  for (const Control& control : controls) {
    plan::Plan plan = GoodPlan();
    const int entry = control.change(plan);
    const auto faults = CheckHand(kHand, Cube(), plan);
    ASSERT_EQ(faults.size(), 1U) << control.name;
    EXPECT_EQ(faults.front().reason, control.reason) << control.name << ": " << faults[0].detail;
    EXPECT_EQ(faults.front().entry, entry) << control.name;
    EXPECT_THAT(faults.front().detail, testing::HasSubstr(control.words)) << control.name;
    const auto& place = faults.front().fault.hand;
    ASSERT_TRUE(place) << control.name;
    EXPECT_EQ(place->state.joints.size(), 4U) << control.name << ": it can be drawn";
    const bool of_tip_or_joint =
        control.reason == Reason::kTipOffContact || control.reason == Reason::kJointLimit;
    EXPECT_TRUE(place->pose || !place->links.empty() || place->number.empty()) << control.name;
    if (!of_tip_or_joint) continue;
    ASSERT_EQ(faults.front().fault.fingers.size(), 1U) << control.name;
    const std::string finger = std::to_string(faults.front().fault.fingers.front());
    EXPECT_THAT(faults.front().detail, testing::HasSubstr("finger " + finger + " (finger" + finger))
        << control.name;
    EXPECT_FALSE(place->links.empty()) << control.name;
  }
}

TEST(CheckHandTest, ATipOffItsContactIsToldWithItsPlace) {
  plan::Plan plan = GoodPlan();
  const plan::FingerContact& held = plan.initial.front();
  plan.hand->initial.joints[held.finger][2] += 0.01;
  const auto faults = CheckHand(kHand, Cube(), plan);
  ASSERT_EQ(faults.size(), 1U);
  const plan::HandFaultPlace& place = faults.front().fault.hand.value();
  ASSERT_TRUE(place.tip);
  const double off = (place.tip->found - place.tip->expected).norm();
  // The last two links are at most 60 mm long.
  EXPECT_GT(off, 1e-4);
  EXPECT_LT(off, 0.6e-3);
  EXPECT_THAT(faults.front().detail, testing::HasSubstr(FormatLength(off)));
  EXPECT_EQ(place.number, FormatLength(off));
  // The distance between the contact and the expected sphere centre is one radius.
  const Vector3d contact = place.state.pose * (plan.scale * held.contact.p);
  EXPECT_NEAR((contact - place.tip->expected).norm(), place.tip->radius, 1e-12);
}

/// Only a free finger moves: it swings through the object and back.
TEST(CheckHandTest, AFingerThroughTheObjectCollides) {
  plan::Plan plan = GoodPlan();
  plan::HandPath& path = FirstSwitch(plan).motion->place;
  ASSERT_GE(path.size(), 3U);
  const FingerIndex moving = FirstSwitch(plan).place.front().finger;
  // The joints bend inwards, so that the finger reaches far into the object.
  plan::HandState through = path[path.size() / 2];
  for (double& angle : through.joints[moving]) angle = 1.2;
  through.joints[moving][0] = 0;
  path.insert(path.begin() + static_cast<std::ptrdiff_t>(path.size() / 2) + 1, through);
  const auto faults = CheckHand(kHand, Cube(), plan);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults.front().reason, Reason::kHandCollides) << faults.front().detail;
  EXPECT_EQ(faults.front().entry, FirstOf(plan, "switch") + 1);
  const plan::Fault& fault = faults.front().fault;
  ASSERT_TRUE(fault.hand && fault.hand->gap_m);
  EXPECT_THAT(fault.fingers, testing::Contains(moving));
  EXPECT_THAT(fault.hand->links,
              testing::Contains(testing::Field(&plan::HandLink::finger, moving)));
  // The fault is at the deepest penetration, not at the first state below the clearance.
  EXPECT_LT(*fault.hand->gap_m, 0);
  EXPECT_THAT(faults.front().detail, testing::HasSubstr("m inside"));
}

/// If links are too near without penetration, the message states their distance.
TEST(CheckHandTest, AClearanceThatIsMissedIsToldWithWhatThereIs) {
  const auto faults = CheckHand(kHand, Cube(), GoodPlan(), {.clearance_m = 0.02});
  ASSERT_EQ(faults.size(), 1U);
  const double gap = faults.front().fault.hand->gap_m.value();
  EXPECT_GT(gap, 1e-3 - 1e-5) << "the plan keeps 1 mm";
  EXPECT_LT(gap, 0.02);
  EXPECT_THAT(faults.front().detail, testing::HasSubstr("is " + FormatLength(gap) + " from"));
  EXPECT_THAT(faults.front().detail, testing::HasSubstr("required clearance 2 cm"));
}

TEST(CheckHandTest, AnotherHandAndNoHandAreRefused) {
  plan::Plan plan = GoodPlan();
  const std::string other = ProjectPath("models/hands/ring5.json");
  EXPECT_THROW((void)CheckHand(other, Cube(), plan), InputError);
  plan.hand.reset();
  EXPECT_THROW((void)CheckHand(kHand, Cube(), plan), InputError);
}

}  // namespace check_hand_test
}  // namespace regrasp::sim
