#include "render/picture/caption.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "render/picture/cairo_paint.h"

namespace regrasp::render {
namespace caption_test {

/// Return the caption of a plan whose only step slides fingers 1 and 2.
/// @param waypoints  positions of the two fingers at each waypoint, centimetres.
std::string CaptionOf(const std::vector<std::array<double, 2>>& waypoints) {
  plan::Align align;
  for (const auto& places : waypoints) {
    plan::FingerGrasp& grasp = align.waypoints.emplace_back();
    for (const int i : {0, 1}) {
      plan::FingerContact& contact = grasp.emplace_back();
      contact.finger = FingerIndex(i + 1);
      contact.contact.p = Eigen::Vector3d(0.01 * places[i], i, 0);
    }
  }
  plan::Plan plan;
  plan.initial = align.waypoints.front();
  plan.steps = {align};
  return FrameCaption(plan, plan::EntryIndex(1));
}

TEST(CaptionTest, StatesTheDistancesAndTheOrderOfSlidingFingers) {
  EXPECT_EQ(CaptionOf({{0, 0}, {1, 0}}), "step 1/1 · align: move 1 by 1 cm along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {1, 2}}),
            "step 1/1 · align: move 1 by 1 cm, 2 by 2 cm together along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {1, 0}, {1, 2}}),
            "step 1/1 · align: move 1 by 1 cm, then 2 by 2 cm along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {0, 2}, {1, 2}}),
            "step 1/1 · align: move 2 by 2 cm, then 1 by 1 cm along the surface");
  EXPECT_EQ(CaptionOf({{0, 0}, {0, 0}}), "step 1/1 · align");
}

/// Return the caption of an in-hand motion with a translation (metres) and a rotation about z
/// (radians).
std::string CaptionOfMove(double shift, double turn) {
  plan::Move move;
  move.path.resize(2);
  move.path[0].pose = Eigen::Isometry3d::Identity();
  move.path[1].pose =
      Eigen::Translation3d(shift, 0, 0) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ());
  plan::Plan plan;
  plan.steps = {move};
  return FrameCaption(plan, plan::EntryIndex(1));
}

TEST(CaptionTest, StatesTheRotationOrTheTranslationOfTheObject) {
  EXPECT_EQ(CaptionOfMove(0.005, 0.5), "step 1/1 · move: rotate the object by 28.6°");
  EXPECT_EQ(CaptionOfMove(0.005, 0), "step 1/1 · move: translate the object by 5 mm");
  EXPECT_EQ(CaptionOfMove(0.005, 1e-9), "step 1/1 · move: translate the object by 5 mm");
  EXPECT_EQ(CaptionOfMove(1e-9, 1e-9), "step 1/1 · move: free fingers");
}

TEST(CaptionTest, FingersHaveNamesOrNumbers) {
  plan::Switch change;
  change.place.resize(1);
  change.place[0].finger = FingerIndex(1);
  change.release = {FingerIndex(2)};
  plan::Plan plan;
  plan.steps = {change};
  const std::vector<std::string> names = {"thumb", "index"};
  EXPECT_EQ(FrameCaption(plan, plan::EntryIndex(1), names),
            "step 1/1 · switch: place index, release 2");
  EXPECT_EQ(EntryTitle(plan, plan::EntryIndex(1)), "switch: place 1, release 2");
  plan.initial.resize(2);
  plan.initial[0].finger = FingerIndex(0);
  plan.initial[1].finger = FingerIndex(1);
  EXPECT_EQ(EntryTitle(plan, plan::EntryIndex(0), names), "hold: thumb, index");
  EXPECT_EQ(EntryTitle(plan, plan::EntryIndex(0)), "hold: fingers 0, 1");
}

TEST(BreakLinesTest, LinesEndAtSpacesButNotBeforeAUnit) {
  const CairoImage image(MakeImage(4, 4));
  cairo_t* cr = image.context();
  SelectFont(cr, 10, /*bold=*/false);
  const auto lines = [cr](const std::string& text, const std::string& longest) {
    return BreakLines(cr, text, TextWidth(cr, longest) + 0.1);
  };
  using testing::ElementsAre;
  EXPECT_THAT(lines("move 3 by 5.6 cm, then go", "move 3 by 5.6"),
              ElementsAre("move 3 by", "5.6 cm, then", "go"));
  EXPECT_THAT(lines("move 3 by 5.6 cm, then go", "move 3 by 5.6 cm,"),
              ElementsAre("move 3 by 5.6 cm,", "then go"));
  EXPECT_THAT(lines("a m b", "a"), ElementsAre("a", "m", "b"));  // no unit without a number
  EXPECT_THAT(lines("", "a"), ElementsAre(""));
}

}  // namespace caption_test

namespace label_layout_test {

using Eigen::Vector2d;

constexpr double kRadius = 12;
constexpr int kWidth = 640;
constexpr int kHeight = 480;

TEST(LabelLayoutTest, PutsALoneLabelNextToItsAnchorOnTheWantedSide) {
  const LabelAnchor anchor = {{300, 200}, {0, -1}, Vector2d(300, 230)};
  const auto centres = PlaceLabels({&anchor, 1}, {}, kRadius, kWidth, kHeight);
  ASSERT_EQ(centres.size(), 1U);
  EXPECT_NEAR(centres[0].x(), 300, 1e-9);
  EXPECT_LT(centres[0].y(), 200);
  EXPECT_LT((centres[0] - anchor.anchor).norm(), 2 * kRadius);
}

TEST(LabelLayoutTest, NeverCoversFingersNorOtherLabels) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(80, kWidth - 80);
  std::uniform_real_distribution<double> y(80, kHeight - 80);
  int checked = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<LabelAnchor> anchors;
    std::vector<Obstacle> obstacles;
    for (int finger = 0; finger < 5; ++finger) {
      const Vector2d ball(x(random), y(random));
      const Vector2d end = ball + 40 * Vector2d::Random().normalized();
      anchors.push_back({end, end - ball, ball});
      obstacles.push_back({ball, end, 8});
    }
    const auto centres = PlaceLabels(anchors, obstacles, kRadius, kWidth, kHeight);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      for (const Obstacle& o : obstacles) {
        const Vector2d along = o.b - o.a;
        const double t = std::clamp((centres[i] - o.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        EXPECT_GE((centres[i] - o.a - t * along).norm(), 8 + 0.8 * kRadius);
        ++checked;
      }
      for (std::size_t j = i + 1; j < centres.size(); ++j) {
        EXPECT_GE((centres[i] - centres[j]).norm(), 1.8 * kRadius);
      }
    }
  }
  EXPECT_EQ(checked, 2500);
}

TEST(LabelLayoutTest, ALabelIsNearestToItsOwnFingertip) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> offset(-60, 60);
  int at_another_stem = 0;
  for (int trial = 0; trial < 200; ++trial) {
    // Fingers inside a hole: the stem of each finger ends at the fingertip of the opposite one.
    std::vector<LabelAnchor> anchors;
    std::vector<Obstacle> obstacles;
    const Vector2d middle(320, 240);
    for (int pair = 0; pair < 2; ++pair) {
      const Vector2d a = middle + Vector2d(offset(random), offset(random));
      const Vector2d b = middle + Vector2d(offset(random), offset(random));
      for (const auto& [ball, end] : {std::pair(a, b), std::pair(b, a)}) {
        anchors.push_back({end, end - ball, ball});
        obstacles.push_back({ball, end, 8});
      }
    }
    const auto centres = PlaceLabels(anchors, obstacles, kRadius, kWidth, kHeight);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      for (const LabelAnchor& other : anchors) {
        if (other.Owner() == anchors[i].Owner()) continue;
        EXPECT_LT((centres[i] - anchors[i].Owner()).norm(), (centres[i] - other.Owner()).norm());
        at_another_stem += other.Owner() == anchors[i].anchor ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(at_another_stem, 800);  // the preferred position of a label is wrong
}

TEST(LabelLayoutTest, KeepsLabelsInsideTheImage) {
  const LabelAnchor corner = {{2, 3}, {-1, -1}, Vector2d(4, 5)};
  const auto centres = PlaceLabels({&corner, 1}, {}, kRadius, kWidth, kHeight);
  ASSERT_EQ(centres.size(), 1U);
  EXPECT_GE(centres[0].minCoeff(), kRadius);
}

}  // namespace label_layout_test
}  // namespace regrasp::render
