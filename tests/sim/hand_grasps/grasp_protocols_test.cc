#include "sim/hand_grasps/grasp_protocols.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "sim/hand_grasps/grasp_conventions.h"

namespace regrasp::sim {
namespace grasp_protocols_test {

using testing::HasSubstr;

constexpr char kGripper[] = R"(<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <default>
    <joint type="slide" range="0 0.05" damping="20" armature="0.1"/>
    <position kp="500" ctrlrange="0 0.05" forcerange="-10 10"/>
  </default>
  <worldbody>
    <body name="palm">
      <geom type="box" size="0.06 0.02 0.01" pos="0 0 -0.01"/>
      <body name="left" pos="-0.05 0 0.05">
        <joint name="left" axis="1 0 0"/>
        <geom type="box" size="0.005 0.01 0.01"/>
      </body>
      <body name="right" pos="0.05 0 0.05">
        <joint name="right" axis="-1 0 0"/>
        <geom type="box" size="0.005 0.01 0.01"/>
      </body>
    </body>
  </worldbody>
  <equality><joint joint1="right" joint2="left" polycoef="0 1 0 0 0"/></equality>
  <actuator><position joint="left"/></actuator>
</mujoco>)";

constexpr char kHand[] = R"({"format": "regrasp-hand", "version": 1, "name": "gripper",
                             "model": "gripper.xml", "palm": "palm"})";

/// Half of the edge of the box, metres. The coupled fingers touch it at 0.025.
constexpr double kHalf = 0.02;
constexpr double kTouch = 0.025;

object::Polyhedron Box() {
  object::PolygonSoup soup;
  for (const double x : {-kHalf, kHalf}) {
    for (const double y : {-kHalf, kHalf}) {
      for (const double z : {-kHalf, kHalf}) soup.vertices.emplace_back(x, y, z);
    }
  }
  soup.facets = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                 {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  return object::Polyhedron::FromSoup(soup, "box");
}

HandGrasp GraspAt(double position) {
  HandGrasp grasp;
  grasp.id = "grasp";
  grasp.object_file = "box.obj";
  grasp.grasp.palm.translation() = Eigen::Vector3d(0, 0, -0.05);
  grasp.grasp.joints = {{"left", position}};
  return grasp;
}

/// Return a text with a part replaced. The part must be in it.
std::string Replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), by);
}

class GraspProtocolsTest : public testing::Test {
 protected:
  static WholeHand ReadGripper(const std::string& model = kGripper,
                               const std::string& description = kHand) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) /
        testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "gripper.xml") << model;
    std::ofstream(folder / "gripper.json") << description;
    return ReadWholeHand(folder / "gripper.json");
  }
  GraspVerdict Test(const HandGrasp& grasp, const GraspTest& test = {}) {
    return TestHandGrasp(grasp, box_, geometry_, {GraspProtocol::kAnalytic, GraspProtocol::kFall},
                         test, world_);
  }

  WholeHand hand_ = ReadGripper();
  object::Polyhedron box_ = Box();
  GraspWorld world_{hand_, box_, 1};
  GraspGeometry geometry_{world_, box_, 1};
};

TEST_F(GraspProtocolsTest, JointsOfAConstraintFollow) {
  const GraspVerdict verdict = Test(GraspAt(kTouch));
  EXPECT_EQ(verdict.fault(), GraspFault::kNone);
  for (const LinkTouch& touch : verdict.touches) {
    EXPECT_EQ(touch.contacts.size(), touch.name == "palm" ? 0U : 4U) << touch.name;
    for (const collision::SurfaceContact& contact : touch.contacts) {
      EXPECT_NEAR(std::abs(contact.point.x()), kHalf, 1e-9);
      EXPECT_NEAR(contact.outward.x(), contact.point.x() / kHalf, 1e-9);
    }
  }
}

constexpr char kConstraint[] =
    R"(<equality><joint joint1="right" joint2="left" polycoef="0 1 0 0 0"/></equality>)";
constexpr char kActuators[] = R"(<position joint="left"/>)";
constexpr char kBothActuators[] = R"(<position joint="left"/><position joint="right"/>)";

std::string WithCoupling(const std::string& coupling) {
  return Replaced(kHand, "}", R"(, "couplings": [)" + coupling + "]}");
}

TEST_F(GraspProtocolsTest, CouplingsOfTheHandFileAreImposed) {
  // The model neither couples the fingers nor, in the first case, moves the right one.
  const std::string uncoupled = Replaced(kGripper, kConstraint, "");
  const std::string coupling =
      WithCoupling(R"({"joint": "right", "follows": "left", "ratio": 1, "offset": 0.001})");
  for (const std::string& model : {uncoupled, Replaced(uncoupled, kActuators, kBothActuators)}) {
    GraspWorld world(ReadGripper(model, coupling), box_, 1);
    EXPECT_EQ(world.model().nu, 1);
    world.CheckJoints({.joints = {{"left", 0.01}}}, "grasp");
    world.Place({.joints = {{"left", 0.01}}});
    const mjModel& compiled = world.model();
    const int right = mj_name2id(&compiled, mjOBJ_JOINT, "right");
    EXPECT_NEAR(world.data().qpos[compiled.jnt_qposadr[right]], 0.011, 1e-12);
    const HandConfiguration from{.joints = {{"left", 0.01}}}, to{.joints = {{"left", 0.015}}};
    world.Command(from, to, 1);
    for (int step = 0; step < 200; ++step) world.Step();
    EXPECT_NEAR(world.data().qpos[compiled.jnt_qposadr[right]], 0.016, 5e-4);
  }
  // Without the coupling the right finger stays.
  GraspWorld world(ReadGripper(uncoupled), box_, 1);
  EXPECT_THROW(world.CheckJoints({.joints = {{"left", 0.01}}}, "grasp"), InputError);
}

TEST_F(GraspProtocolsTest, CouplingsOfTheModelHavePriority) {
  const std::string opposite =
      WithCoupling(R"({"joint": "right", "follows": "left", "ratio": -1})");
  GraspWorld world(ReadGripper(kGripper, opposite), box_, 1);
  world.Place({.joints = {{"left", 0.01}}});
  const mjModel& compiled = world.model();
  const int right = mj_name2id(&compiled, mjOBJ_JOINT, "right");
  EXPECT_NEAR(world.data().qpos[compiled.jnt_qposadr[right]], 0.01, 1e-12);
}

TEST_F(GraspProtocolsTest, JointsOfATendonRemainUncoupled) {
  const std::string tendon = Replaced(
      kGripper, kConstraint,
      R"(<tendon><fixed name="sum"><joint joint="left" coef="1"/><joint joint="right" coef="1"/></fixed></tendon>)");
  const std::string model = Replaced(tendon, kActuators, R"(<position tendon="sum"/>)");
  const WholeHand hand =
      ReadGripper(model, WithCoupling(R"({"joint": "right", "follows": "left", "ratio": 1})"));
  GraspWorld world(hand, box_, 1);
  EXPECT_EQ(world.model().nu, 1);
  EXPECT_THROW(world.CheckJoints({.joints = {{"left", 0.01}}}, "grasp"), InputError);
}

TEST_F(GraspProtocolsTest, CouplingsOfUnknownJointsAreBadInput) {
  try {
    static_cast<void>(ReadGripper(
        kGripper, WithCoupling(R"({"joint": "right", "follows": "thumb", "ratio": 1})")));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("/couplings/0/follows: joint \"thumb\" not found in the model"));
  }
}

TEST_F(GraspProtocolsTest, TargetsOutsideTheRangesAreCommanded) {
  const std::string soft =
      Replaced(kGripper, R"(kp="500" ctrlrange="0 0.05" forcerange="-10 10")", R"(kp="100")");
  GraspWorld world(ReadGripper(soft), box_, 1);
  const auto resisted = [&](double target) {
    HandGrasp grasp = GraspAt(kTouch);
    grasp.target = grasp.grasp;
    grasp.target->joints["left"] = target;
    const GraspVerdict verdict =
        TestHandGrasp(grasp, box_, GraspGeometry(world, box_, 1), {GraspProtocol::kDisturbance},
                      {.mass_kg = 0.001}, world);
    return *std::ranges::min_element(verdict.results[0].resisted_N);
  };
  // The upper limit of the joint is 0.05.
  EXPECT_GT(resisted(0.15), 2 * resisted(0.05));
}

TEST_F(GraspProtocolsTest, AClosingMotionClosesAnOpenHand) {
  HandGrasp open = GraspAt(0);
  const auto fault = [&] {
    return TestHandGrasp(open, box_, geometry_, {GraspProtocol::kFall}, {}, world_).fault();
  };
  EXPECT_EQ(fault(), GraspFault::kNoContact);
  open.closing = {{"left", 1}};
  EXPECT_EQ(fault(), GraspFault::kNone);
  // The box is between 0.025 and the upper limit, 0.05: half of it does not press.
  EXPECT_NEAR(world_.Closed(open.grasp, {{"left", 0.25}}, "").joints.at("left"), 0.0125, 1e-12);
  open.closing = {{"left", 0.25}};
  EXPECT_EQ(fault(), GraspFault::kNoContact);
  // Negative factors are those of the lower limit.
  GraspWorld world(
      ReadGripper(Replaced(kGripper, R"(range="0 0.05" damp)", R"(range="-0.02 0.05" damp)")), box_,
      1);
  EXPECT_NEAR(world.Closed(open.grasp, {{"left", -0.5}}, "").joints.at("left"), -0.01, 1e-12);
}

TEST_F(GraspProtocolsTest, ClosingMotionsOfUnknownOrUnlimitedJointsAreBadInput) {
  HandGrasp grasp = GraspAt(0);
  const auto message = [&](const WholeHand& hand, const GraspWorld& world) {
    try {
      CheckGraspConventions(grasp, hand, box_, world, "line 3");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  grasp.closing = {{"left", 1}};
  EXPECT_EQ(message(hand_, world_), "");
  grasp.closing = {{"thumb", 1}};
  EXPECT_THAT(message(hand_, world_), HasSubstr("line 3: /closing: unknown joint \"thumb\""));
  grasp.closing = {{"left", 1}};
  const WholeHand free = ReadGripper(Replaced(kGripper, R"(range="0 0.05" damp)", "damp"));
  EXPECT_THAT(message(free, GraspWorld(free, box_, 1)),
              HasSubstr("/closing: joint \"left\" has no range"));
}

TEST_F(GraspProtocolsTest, LinksThatPenetrateEachOtherFailTheBench) {
  // The fingers meet in front of the object: at 0.04 they overlap by 4 mm, at 0.046 by 16 mm.
  const std::string box = R"(type="box" size="0.005 0.01 0.01")";
  const std::string ball = R"(type="sphere" size="0.012")";
  const std::string thick = Replaced(Replaced(kGripper, box, ball), box, ball);
  GraspWorld world(ReadGripper(thick), box_, 1);
  const auto fault = [&](double position) {
    HandGrasp grasp = GraspAt(position);
    grasp.grasp.palm.translation().z() = -0.2;
    return TestHandGrasp(grasp, box_, GraspGeometry(world, box_, 1),
                         {GraspProtocol::kDexGraspBench}, {}, world)
        .fault();
  };
  EXPECT_EQ(fault(0.04), GraspFault::kNoContact);
  EXPECT_EQ(fault(0.046), GraspFault::kPenetrates);
}

TEST_F(GraspProtocolsTest, DistancesAreSigned) {
  for (const double gap : {0.02, 0.003, -0.001, -0.005}) {
    EXPECT_NEAR(Test(GraspAt(kTouch - gap)).distance_m, gap, 6e-5);
  }
  EXPECT_EQ(Test(GraspAt(kTouch + 0.005)).fault(), GraspFault::kPenetrates);
  EXPECT_EQ(Test(GraspAt(0)).fault(), GraspFault::kNoContact);
  EXPECT_EQ(Test(GraspAt(-0.01)).fault(), GraspFault::kJointsOutOfRange);
}

TEST_F(GraspProtocolsTest, AVerdictDependsOnNoEarlierGrasp) {
  const GraspVerdict first = Test(GraspAt(kTouch), {.mu = 0.1});
  Test(GraspAt(kTouch + 0.004), {.mu = 0.9, .mass_kg = 3});
  const GraspVerdict again = Test(GraspAt(kTouch), {.mu = 0.1});
  EXPECT_EQ(again.results.back().seconds, first.results.back().seconds);
  EXPECT_EQ(again.distance_m, first.distance_m);
}

TEST_F(GraspProtocolsTest, FrictionHoldsTheObject) {
  EXPECT_EQ(Test(GraspAt(kTouch), {.mu = 0.6}).results.back().fault, GraspFault::kNone);
  EXPECT_EQ(Test(GraspAt(kTouch), {.mu = 0.01}).results.back().fault, GraspFault::kDropped);
}

TEST_F(GraspProtocolsTest, PiecesHoldLikeTheirObject) {
  // The same box in two halves: MuJoCo has two hulls.
  GraspWorld::Pieces halves(2);
  for (const Eigen::Vector3d& vertex : box_.vertices()) {
    for (const int half : {0, 1}) {
      Eigen::Vector3d point = vertex;
      if ((point.y() > 0) == (half == 0)) point.y() = 0;
      halves[half].push_back(point);
    }
  }
  GraspWorld world(hand_, box_, 1, halves);
  const GraspVerdict verdict = TestHandGrasp(GraspAt(kTouch), box_, GraspGeometry(world, box_, 1),
                                             {GraspProtocol::kFall}, {}, world);
  EXPECT_EQ(verdict.fault(), GraspFault::kNone);
}

TEST_F(GraspProtocolsTest, UnknownAndMissingJointsAreNamed) {
  HandGrasp grasp = GraspAt(kTouch);
  grasp.grasp.joints["thumb"] = 0;
  const auto message = [&] {
    try {
      CheckGraspConventions(grasp, hand_, box_, world_, "line 3");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(), HasSubstr("line 3: joints: unknown joint \"thumb\""));
  grasp.grasp.joints.clear();
  EXPECT_THAT(message(), HasSubstr("joint \"left\" not found"));
  // The right finger follows.
  grasp.grasp.joints = {{"left", kTouch}};
  EXPECT_EQ(message(), "");
}

}  // namespace grasp_protocols_test
}  // namespace regrasp::sim
