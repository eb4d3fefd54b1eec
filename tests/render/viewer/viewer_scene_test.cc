#include "render/viewer/viewer_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/json.h"
#include "planner/base/number.h"
#include "render/viewer/viewer_scripts.h"

namespace regrasp::render {
namespace viewer_scene_test {

using Eigen::Vector3d;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;

/// Two samples with one finger, 1 s apart, in which the object moves by 0.1 m along x and turns by
/// 90° about z.
ViewerScene MakeScene() {
  ViewerScene scene;
  scene.object_name = "cube.obj";
  scene.object.AddFlat({0, 0, 0}, {0.06, 0, 0}, {0, 0.06, 0});
  scene.diameter_m = 0.1;
  scene.friction_angle = Radians(20);
  scene.fingers = {{FingerIndex(2), "thumb"}};
  ViewerSample first;
  first.contacts = {{ViewerContactState::kFree, {0, 0, 0.5}, {0, 0, -1}, {0, 0, 0}}};
  ViewerSample second = first;
  second.time_s = 1;
  second.X_WO.translation() = Vector3d(0.1, 0, 0);
  second.X_WO.linear() = Eigen::AngleAxisd(Radians(90), Vector3d::UnitZ()).toRotationMatrix();
  second.contacts[0] = {ViewerContactState::kHolding, {0, 0, 0.25}, {0, 0, -1}, {0, 1, -8}};
  scene.samples = {first, second};
  scene.steps = {{0, 0, 0.5, "Initial grasp: thumb", "pass"},
                 {1, 0.5, 1, "Switch: place thumb", "pass"}};
  return scene;
}

std::string Decode(const std::string& base64) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : base64) {
    const auto digit = kDigits.find(c);
    if (digit == std::string_view::npos) break;
    buffer = buffer << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(buffer >> bits & 0xff);
  }
  return bytes;
}

/// Return a number of a table by the method of the script in the page.
double ValueOf(const Json& table, int rows, int column, int row) {
  const std::string bytes = Decode(table["codes"].get<std::string>());
  int start = 0;
  for (int i = 0; i < column; ++i) start += table["low"][i] == table["high"][i] ? 0 : rows;
  const double low = table["low"][column].get<double>();
  const double high = table["high"][column].get<double>();
  if (low == high) return low;
  const auto at = 2 * static_cast<std::size_t>(start + row);
  const int code =
      static_cast<unsigned char>(bytes.at(at)) + 256 * static_cast<unsigned char>(bytes.at(at + 1));
  return low + (high - low) * code / 65535;
}

Json Parsed(const ViewerScene& scene) { return ParseJson(FormatViewerScene(scene), "scene"); }

TEST(ViewerSceneTest, SamplesAreThoseOfTheScene) {
  const Json json = Parsed(MakeScene());
  const Json& samples = json["samples"];
  ASSERT_EQ(samples["count"], 2);
  ASSERT_EQ(samples["low"].size(), 8 + 10);  // time and pose, and one finger
  const auto value = [&](int column, int row) { return ValueOf(samples, 2, column, row); };
  EXPECT_EQ(value(0, 0), 0);
  EXPECT_EQ(value(0, 1), 1);
  EXPECT_EQ(value(1, 0), 0);
  EXPECT_NEAR(value(1, 1), 0.1, 1e-6);
  EXPECT_NEAR(value(6, 1), std::sqrt(0.5), 1e-5);  // quaternion x, y, z, w
  EXPECT_NEAR(value(7, 0), 1, 1e-5);
  EXPECT_NEAR(value(7, 1), std::sqrt(0.5), 1e-5);
  EXPECT_EQ(value(8, 0), 1);  // free
  EXPECT_EQ(value(8, 1), 2);  // holding
  EXPECT_NEAR(value(11, 0), 0.5, 1e-5);
  EXPECT_NEAR(value(11, 1), 0.25, 1e-5);
  EXPECT_EQ(value(14, 1), -1);  // normal
  EXPECT_NEAR(value(17, 1), -8, 1e-4);
  EXPECT_EQ(json["fingers"][0]["name"], "thumb");
  EXPECT_EQ(json["fingers"][0]["number"], 2);
  EXPECT_EQ(json["steps"][1]["start"], 0.5);
}

TEST(ViewerSceneTest, ColumnsThatDoNotChangeHaveNoData) {
  ViewerScene scene = MakeScene();
  scene.samples[1] = scene.samples[0];
  scene.samples[1].time_s = 1;
  const Json samples = Parsed(scene)["samples"];
  EXPECT_EQ(Decode(samples["codes"].get<std::string>()).size(), 2 * 2);  // two times
}

TEST(ViewerSceneTest, AQuaternionKeepsItsSign) {
  ViewerScene scene = MakeScene();
  scene.samples.clear();
  for (int i = 0; i <= 8; ++i) {
    ViewerSample& sample = scene.samples.emplace_back();
    sample.time_s = i;
    sample.X_WO.linear() = Eigen::AngleAxisd(Radians(45 * i), Vector3d::UnitX()).matrix();
    sample.contacts.resize(1);
  }
  const Json samples = Parsed(scene)["samples"];
  for (int i = 1; i <= 8; ++i) {
    double product = 0;
    for (int column = 4; column < 8; ++column) {
      product += ValueOf(samples, 9, column, i) * ValueOf(samples, 9, column, i - 1);
    }
    EXPECT_NEAR(product, std::cos(Radians(22.5)), 1e-3) << i;
  }
}

TEST(ViewerSceneTest, EveryMeshIsWrittenOnceWithItsVertices) {
  ViewerScene scene = MakeScene();
  scene.object.AddFlat({0.06, 0, 0}, {0.06, 0.06, 0}, {0, 0.06, 0});
  const Json object = Parsed(scene)["object"];
  EXPECT_EQ(Decode(object["positions"].get<std::string>()).size(), 4 * 3 * 2);
  EXPECT_EQ(Decode(object["normals"].get<std::string>()).size(), 4 * 3);
  EXPECT_EQ(Decode(object["indices"].get<std::string>()).size(), 2 * 3 * 2);
  EXPECT_NEAR(object["unit"].get<double>() * 65535, 0.06, 1e-12);
}

TEST(ViewerSceneTest, TheSameSceneGivesTheSameBytes) {
  EXPECT_EQ(FormatViewerScene(MakeScene()), FormatViewerScene(MakeScene()));
  ViewerScene moved = MakeScene();
  moved.samples[1].X_WO.translation().x() = 0.2;
  EXPECT_NE(FormatViewerScene(MakeScene()), FormatViewerScene(moved));
}

TEST(ViewerSceneTest, NamesCannotEndTheScript) {
  const std::string evil = "</script><script>alert('\"&\\')</script><!--]]>\u2028\u202e\xff";
  ViewerScene scene = MakeScene();
  scene.object_name = scene.fingers[0].name = scene.steps[0].title = scene.steps[1].reason = evil;
  scene.failure =
      ViewerFailure{evil, {0}, {}, {{Vector3d::Zero(), Vector3d::UnitX(), false, evil}}};
  const std::string text = FormatViewerScene(scene);
  EXPECT_THAT(text, Not(HasSubstr("<")));
  EXPECT_THAT(text, Not(HasSubstr(">")));
  EXPECT_THAT(text, Not(HasSubstr("&")));
  EXPECT_TRUE(std::ranges::all_of(text, [](char c) { return c >= ' ' && c < 127; }));
  const std::string name = ParseJson(text, "scene")["fingers"][0]["name"].get<std::string>();
  EXPECT_EQ(name, "</script><script>alert('\"&\\')</script><!--]]>\uFFFD\uFFFD\uFFFD");
}

TEST(ViewerSceneTest, NumbersThatAreNotFiniteBecomeZero) {
  ViewerScene scene = MakeScene();
  scene.samples[0].contacts[0].point.x() = std::numeric_limits<double>::quiet_NaN();
  scene.samples[1].contacts[0].force.x() = std::numeric_limits<double>::infinity();
  scene.failure = ViewerFailure{
      "",
      {},
      {},
      {{Vector3d::Constant(std::numeric_limits<double>::infinity()), {}, false, "far"}}};
  const Json json = Parsed(scene);
  EXPECT_EQ(ValueOf(json["samples"], 2, 9, 0), 0);
  EXPECT_EQ(ValueOf(json["samples"], 2, 15, 1), 0);
  EXPECT_TRUE(json["failure"]["marks"].empty());
}

TEST(ViewerSceneTest, RefusesSamplesOfDifferentSize) {
  ViewerScene scene = MakeScene();
  scene.samples[1].contacts.clear();
  EXPECT_THROW(static_cast<void>(FormatViewerScene(scene)), std::invalid_argument);
  scene.samples.clear();
  EXPECT_THROW(static_cast<void>(FormatViewerScene(scene)), std::invalid_argument);
}

/// A square of 2 n² triangles.
ShadedMesh MakeGrid(int n) {
  ShadedMesh mesh;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vector3d a(i, j, 0);
      mesh.AddFlat(a, a + Vector3d(1, 0, 0), a + Vector3d(1, 1, 0));
      mesh.AddFlat(a, a + Vector3d(1, 1, 0), a + Vector3d(0, 1, 0));
    }
  }
  return mesh;
}

TEST(ViewerSceneTest, LargeMeshesAreSimplified) {
  const ShadedMesh grid = MakeGrid(60);
  EXPECT_EQ(SimplifyForViewer(grid, 7200).triangles.size(), 7200);
  const ShadedMesh simple = SimplifyForViewer(grid, 1000);
  EXPECT_LE(simple.triangles.size(), 1000);
  EXPECT_GE(simple.triangles.size(), 300);
  Eigen::AlignedBox3d box;
  for (const auto& corners : simple.triangles) {
    for (const Vector3d& p : corners) box.extend(p);
  }
  EXPECT_GT(box.sizes().x(), 55);
}

TEST(ViewerSceneTest, ALongReplayOfAHandStaysSmall) {
  ViewerScene scene = MakeScene();
  scene.fingers.assign(5, {FingerIndex(0), "finger"});
  scene.joints.resize(24);
  scene.links = {{-1, {}, false, MakeGrid(140)}};
  scene.samples.clear();
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    ViewerSample& sample = scene.samples.emplace_back();
    sample.time_s = 0.02 * i;
    sample.X_WO.linear() = Eigen::AngleAxisd(1e-3 * i, Vector3d(1, 2, 3).normalized()).matrix();
    sample.joints.assign(24, std::sin(0.01 * i));
    sample.contacts.assign(5, {ViewerContactState::kHolding, Vector3d::Constant(1e-4 * i),
                               Vector3d(std::sin(0.01 * i), 0, std::cos(0.01 * i)),
                               Vector3d::Constant(std::sin(0.03 * i))});
  }
  EXPECT_LT(FormatViewerScene(scene).size(), 2'000'000);
}

TEST(ViewerScriptsTest, NoScriptEndsItsElement) {
  std::size_t bytes = 0;
  for (const std::string_view script : ViewerScripts()) {
    EXPECT_EQ(script.find("</script"), std::string_view::npos);
    EXPECT_EQ(script.find("<!--"), std::string_view::npos);
    EXPECT_EQ(script.find("]]>"), std::string_view::npos);
    bytes += script.size();
  }
  EXPECT_NE(ViewerScripts()[0].find("Permission is hereby granted"), std::string_view::npos);
  EXPECT_LT(bytes, 950'000);
}

TEST(ViewerScriptsTest, AHashIsThatOfContentSecurityPolicies) {
  // Known answers: SHA-256 of no bytes, and the example of CSP Level 2, section 4.2.5.
  EXPECT_EQ(ScriptHash(""), "sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
  EXPECT_EQ(ScriptHash("alert('Hello, world.');"),
            "sha256-qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng=");
}

}  // namespace viewer_scene_test
}  // namespace regrasp::render
