#include "planner/plan/plan_io.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "sample_plans.h"

namespace regrasp::plan {
namespace plan_io_test {

void ExpectSameContact(const grasp::Contact& a, const grasp::Contact& b) {
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.n, b.n);
}

void ExpectSameGrasp(const FingerGrasp& a, const FingerGrasp& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].finger, b[i].finger);
    EXPECT_EQ(a[i].region, b[i].region);
    ExpectSameContact(a[i].contact, b[i].contact);
  }
}

void ExpectSameCertificate(const std::optional<AlignCertificate>& a,
                           const std::optional<AlignCertificate>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  ASSERT_EQ(a->size(), b->size());
  for (std::size_t w = 0; w < a->size(); ++w) {
    ASSERT_EQ((*a)[w].size(), (*b)[w].size());
    for (std::size_t k = 0; k < (*a)[w].size(); ++k) {
      const motion::MotionSegment& one = (*a)[w][k];
      const motion::MotionSegment& other = (*b)[w][k];
      EXPECT_EQ(one.from, other.from);
      EXPECT_EQ(one.to, other.to);
      EXPECT_EQ(one.start, other.start);
      EXPECT_EQ(one.end, other.end);
    }
  }
}

void ExpectSamePlan(const Plan& a, const Plan& b) {
  EXPECT_EQ(a.object_file, b.object_file);
  EXPECT_EQ(a.object_sha256, b.object_sha256);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.dimension, b.dimension);
  EXPECT_EQ(a.friction_angle, b.friction_angle);
  EXPECT_EQ(a.fingers, b.fingers);
  EXPECT_EQ(a.planner, b.planner);
  EXPECT_EQ(a.finger_radius, b.finger_radius);
  EXPECT_EQ(a.patch_radius, b.patch_radius);
  EXPECT_EQ(a.at_given_points, b.at_given_points);
  ExpectSameGrasp(a.initial, b.initial);
  ASSERT_EQ(a.goal.size(), b.goal.size());
  for (std::size_t i = 0; i < a.goal.size(); ++i) ExpectSameContact(a.goal[i], b.goal[i]);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    ASSERT_EQ(a.steps[k].index(), b.steps[k].index());
    if (const auto* a_switch = std::get_if<Switch>(&a.steps[k])) {
      const auto& b_switch = std::get<Switch>(b.steps[k]);
      ExpectSameGrasp(a_switch->place, b_switch.place);
      EXPECT_EQ(a_switch->release, b_switch.release);
      continue;
    }
    ExpectSameCertificate(std::get<Align>(a.steps[k]).certificate,
                          std::get<Align>(b.steps[k]).certificate);
    const auto& a_waypoints = std::get<Align>(a.steps[k]).waypoints;
    const auto& b_waypoints = std::get<Align>(b.steps[k]).waypoints;
    ASSERT_EQ(a_waypoints.size(), b_waypoints.size());
    for (std::size_t w = 0; w < a_waypoints.size(); ++w) {
      ExpectSameGrasp(a_waypoints[w], b_waypoints[w]);
    }
  }
}

/// Return the message of the InputError of reading; empty if reading succeeds.
std::string Complaint(const std::string& text) {
  try {
    static_cast<void>(ParsePlan(text, "plan.json"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PlanIo, ReadsWhatItWrites) {
  for (const Plan& plan : {CubePlan(), SquarePlan(), EmptyPlan(3, 5, 20)}) {
    const std::string text = FormatPlan(plan);
    const Plan read = ParsePlan(text, "plan.json");
    ExpectSamePlan(read, plan);
    EXPECT_EQ(FormatPlan(read), text);
  }
}

/// Return a plan whose sliding step has invalid proof forces, one per finger.
Plan WithCertificate(Plan plan) {
  auto& align = std::get<Align>(plan.steps.back());
  align.certificate.emplace();
  for (std::size_t w = 0; w + 1 < align.waypoints.size(); ++w) {
    std::vector<Eigen::Vector3d> forces(align.waypoints[w].size(), {1.0 / 3, -0.1, 0});
    align.certificate->push_back({{0, 1.0 / 7, forces, forces}, {1.0 / 7, 1, forces, forces}});
  }
  return plan;
}

TEST(PlanIo, KeepsCertificates) {
  for (const Plan& plan : {WithCertificate(CubePlan()), WithCertificate(SquarePlan())}) {
    const std::string text = FormatPlan(plan);
    const Plan read = ParsePlan(text, "plan.json");
    ExpectSamePlan(read, plan);
    EXPECT_EQ(FormatPlan(read), text);
  }
}

TEST(PlanIo, RefusesCertificatesThatDoNotFitTheAlign) {
  const auto complaint = [](const std::function<void(Json&)>& change) {
    Json json = ParseJson(FormatPlan(WithCertificate(CubePlan())), "plan.json");
    change(json["steps"][2]["certificate"]);
    return Complaint(FormatJson(json));
  };
  EXPECT_EQ(complaint([](Json&) {}), "");
  EXPECT_EQ(
      complaint([](Json& ways) { ways.erase(0); }),
      "plan.json: /steps/2/certificate: expected 2 lists of pieces, one for each waypoint except "
      "the last, found 1");
  EXPECT_EQ(complaint([](Json& ways) { ways[1][0]["end"].erase(0); }),
            "plan.json: /steps/2/certificate/1/0/end: expected 4 forces, one per finger, found 3");
  for (const auto& change : std::vector<std::function<void(Json&)>>{
           [](Json& ways) { ways = nullptr; }, [](Json& ways) { ways[0] = "all"; },
           [](Json& ways) { ways[0][1].erase("from"); }, [](Json& ways) { ways[0][1]["to"] = "1"; },
           [](Json& ways) {
             ways[0][0]["start"][2] = {1, 2};
           },
           [](Json& ways) { ways[0][0]["start"][2][1] = 1e300; }}) {
    EXPECT_EQ(complaint(change).find("plan.json: /steps/2/certificate"), 0U) << complaint(change);
  }
}

TEST(PlanIo, KeepsEveryBitOfNumbers) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  int checked = 0;
  for (int i = 0; i < 500; ++i, ++checked) {
    Plan plan = CubePlan();
    for (FingerContact& held : plan.initial) {
      held.contact.p = {value(random), 1e-9 * value(random), 1e9 * value(random)};
    }
    const Plan read = ParsePlan(FormatPlan(plan), "plan.json");
    ExpectSamePlan(read, plan);
  }
  EXPECT_EQ(checked, 500);
}

TEST(PlanIo, KeepsRegionsOfContactsAndWritesNoneWhereThereIsNone) {
  EXPECT_EQ(FormatPlan(SquarePlan()).find("region"), std::string::npos);
  Plan plan = SquarePlan();
  FingerGrasp& placed = std::get<Switch>(plan.steps.front()).place;
  placed[0].region = 0.1 / 3;
  placed[1].region = 0;
  const Plan read = ParsePlan(FormatPlan(plan), "plan.json");
  ExpectSamePlan(read, plan);
  EXPECT_EQ(std::get<Switch>(read.steps.front()).place[0].region, 0.1 / 3);
}

TEST(PlanIo, KeepsTheRadiusOfFingersAndWritesNoneWhereThereIsNone) {
  EXPECT_EQ(FormatPlan(CubePlan()).find("finger_radius"), std::string::npos);
  Plan plan = CubePlan();
  plan.finger_radius = 0.01 / 3;
  const Plan read = ParsePlan(FormatPlan(plan), "plan.json");
  ExpectSamePlan(read, plan);
  EXPECT_EQ(read.finger_radius, 0.01 / 3);
}

TEST(PlanIo, KeepsTheRadiusOfPatchesOfSolids) {
  EXPECT_EQ(FormatPlan(CubePlan()).find("patch_radius"), std::string::npos);
  Plan plan = CubePlan();
  plan.patch_radius = 0.02 / 3;
  ExpectSamePlan(ParsePlan(FormatPlan(plan), "plan.json"), plan);
  plan = SquarePlan();
  plan.patch_radius = 0.02;
  EXPECT_EQ(Complaint(FormatPlan(plan)),
            "plan.json: /patch_radius: cannot be used with a planar object");
}

TEST(PlanIo, KeepsWhereClusteredContactsAre) {
  Plan plan = CubePlan();
  plan.roadmap = RoadmapNote{300, 20, 7, "vertex", "algorithm-1"};
  const Json plain = Json::parse(FormatPlan(plan))["roadmap"];
  EXPECT_FALSE(plain.contains("roughness_deg") || plain.contains("invented"));
  plan.roadmap->roughness = Radians(5);
  plan.roadmap->allow_filled = true;
  const std::string text = FormatPlan(plan);
  const Plan read = ParsePlan(text, "plan.json");
  EXPECT_EQ(read.roadmap->roughness, plan.roadmap->roughness);
  EXPECT_TRUE(read.roadmap->allow_filled);
  EXPECT_EQ(FormatPlan(read), text);
  EXPECT_EQ(Json::parse(text)["roadmap"]["roughness_deg"], 5);
}

TEST(PlanIo, KeepsThatContactsAreAtGivenPointsOfASurface) {
  EXPECT_FALSE(Json::parse(FormatPlan(CubePlan())).contains("contacts"));
  Plan plan = CubePlan();
  plan.at_given_points = true;
  ExpectSamePlan(ParsePlan(FormatPlan(plan), "plan.json"), plan);
  plan = SquarePlan();
  plan.at_given_points = true;
  EXPECT_EQ(Complaint(FormatPlan(plan)),
            "plan.json: /contacts: cannot be used with a planar object");
}

TEST(PlanIo, WritesRoundFrictionAnglesRound) {
  EXPECT_NE(FormatPlan(EmptyPlan(3, 5, 20)).find("\"half_angle_deg\": 20.0"), std::string::npos);
  EXPECT_NE(FormatPlan(EmptyPlan(3, 5, 33.3)).find("\"half_angle_deg\": 33.3"), std::string::npos);
}

TEST(PlanIo, IgnoresFieldsThatItDoesNotKnowAndAByteOrderMark) {
  Json json = Json::parse(FormatPlan(CubePlan()));
  json["note"] = "by hand";
  json["initial"]["contacts"][0]["face"] = 3;
  json["steps"][0]["focus"] = Json::array({1, 2, 3});
  ExpectSamePlan(ParsePlan("\xEF\xBB\xBF" + json.dump(), "plan.json"), CubePlan());
}

TEST(PlanIo, NamesFileElementAndValueOfWhatIsWrong) {
  const Json good = Json::parse(FormatPlan(CubePlan()));
  struct Case {
    const char* pointer;
    Json value;
    const char* message;
  };
  const std::vector<Case> cases = {
      {"/format", "regrasp-grasp",
       "plan.json: /format: expected \"regrasp-plan\", found \"regrasp-grasp\""},
      {"/version", 2, "plan.json: /version: expected 1, found 2"},
      {"/version", "1", "plan.json: /version: expected a number, found \"1\""},
      {"/object/file", std::string("cube.obj\0.wkt", 13),
       "plan.json: /object/file: must not contain a NUL character"},
      {"/object/scale", 0, "plan.json: /object/scale: must be positive"},
      {"/finger_radius", 0, "plan.json: /finger_radius: must be positive, found 0"},
      {"/patch_radius", 0, "plan.json: /patch_radius: must be positive, found 0"},
      {"/finger_radius", -1, "plan.json: /finger_radius: must be positive, found -1"},
      {"/finger_radius", Json(), "plan.json: /finger_radius: expected a number, found null"},
      {"/object/dimension", 4,
       "plan.json: /object/dimension: expected a whole number from 2 to 3, found 4"},
      {"/object/sha256", "abc",
       "plan.json: /object/sha256: expected 64 lower-case hexadecimal digits, found \"abc\""},
      {"/friction/half_angle_deg", 5e-324,
       "plan.json: /friction/half_angle_deg: too close to an end of (0, 90), found 5e-324"},
      {"/friction/half_angle_deg", 90,
       "plan.json: /friction/half_angle_deg: must be between 0 and 90, found 90"},
      {"/fingers", 0, "plan.json: /fingers: expected a whole number from 1 to 64, found 0"},
      {"/fingers", 4.5, "plan.json: /fingers: expected a whole number from 1 to 64, found 4.5"},
      {"/steps/0/place/0/normal",
       {1, 0},
       "plan.json: /steps/0/place/0/normal: expected 3 numbers, found 2"},
      {"/steps/0/place/0/point/1", "x",
       "plan.json: /steps/0/place/0/point/1: expected a number, found \"x\""},
      {"/steps/0/place/0/point/1", 1e300,
       "plan.json: /steps/0/place/0/point/1: too large, found 1e+300"},
      {"/steps/0/kind", "jump",
       "plan.json: /steps/0/kind: expected \"switch\" or \"align\" or \"move\", found \"jump\""},
      {"/steps/1/release",
       {2.5},
       "plan.json: /steps/1/release/0: expected a whole number from 0 to 2147483647, found 2.5"},
      {"/steps/2/waypoints", Json::array(),
       "plan.json: /steps/2/waypoints: expected at least 2 waypoints, found 0"},
      {"/initial/contacts/2/finger", -1,
       "plan.json: /initial/contacts/2/finger: expected a whole number from 0 to 2147483647, "
       "found -1"},
      {"/steps/0/place/0/region", -1e-9,
       "plan.json: /steps/0/place/0/region: expected a number from 0, found -1e-09"},
      {"/steps/0/place/0/region", "wide",
       "plan.json: /steps/0/place/0/region: expected a number, found \"wide\""},
      {"/steps/0/place/0/region", nullptr,
       "plan.json: /steps/0/place/0/region: expected a number, found null"},
      {"/initial", Json::array(),
       "plan.json: /initial: expected a JSON object, found a JSON array"},
      {"/goal/contacts", nullptr, "plan.json: /goal/contacts: expected a JSON array, found null"},
  };
  int checked = 0;
  for (const Case& one : cases) {
    Json bad = good;
    bad[Json::json_pointer(one.pointer)] = one.value;
    EXPECT_EQ(Complaint(bad.dump()), one.message);
    ++checked;
  }
  EXPECT_EQ(checked, std::ssize(cases));
  Json idle = good;
  idle["steps"][0]["place"] = Json::array();
  idle["steps"][0]["release"] = Json::array();
  EXPECT_EQ(Complaint(idle.dump()), "plan.json: /steps/0: a switch must place or release a finger");
  Json without = good;
  without["initial"]["contacts"][1].erase("normal");
  EXPECT_EQ(Complaint(without.dump()),
            "plan.json: /initial/contacts/1: member \"normal\" not found");
}

TEST(PlanIo, TheHandHasJointsOfEachFinger) {
  const HandState state{Eigen::Isometry3d::Identity(), {{0.1}, {0.2}, {0.3}, {0.4}, {0.5}}};
  Plan plan = CubePlan();
  plan.hand = HandUse{"hand", "hand.json", std::string(64, '0'), state, state.pose};
  const Json good = Json::parse(FormatPlan(plan));
  ASSERT_EQ(Complaint(good.dump()), "");
  Json more = good;
  more["fingers"] = 6;
  EXPECT_EQ(Complaint(more.dump()),
            "plan.json: /hand/initial/joints: expected 6 lists of joint angles, one per finger, "
            "found 5");
  Json fewer = good;
  fewer["hand"]["initial"]["joints"].erase(4);
  EXPECT_EQ(Complaint(fewer.dump()),
            "plan.json: /hand/initial/joints: expected 5 lists of joint angles, one per finger, "
            "found 4");
}

TEST(PlanIo, LeavesFingersToTheChecker) {
  Json json = Json::parse(FormatPlan(CubePlan()));
  json["initial"]["contacts"][0]["finger"] = 77;
  json["initial"]["contacts"][1]["finger"] = 2;
  EXPECT_EQ(Complaint(json.dump()), "");
}

TEST(PlanIo, AFileThatIsNotThereIsBadInput) {
  EXPECT_THROW(static_cast<void>(ReadPlan("no/such/plan.json")), InputError);
}

}  // namespace plan_io_test
}  // namespace regrasp::plan
