#include "render/figures/hand_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>

#include "planner/base/number.h"
#include "planner/plan/projection.h"
#include "render/frames/object_tint.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {
namespace hand_figure_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr char kDashed[] = "stroke-dasharray:1.3";  // an outline of the hand behind the object
constexpr char kGhost[] = "stroke-dasharray:2.4";

const object::Polyhedron& Cube() {
  static const object::Polyhedron cube = MakeCube(0.03);
  return cube;
}

plan::FingerContact Hold(int finger, const Vector3d& p, const Vector3d& n) {
  return {FingerIndex(finger), {p, n}};
}

/// Return a plan that rotates a cube of 6 cm and then replaces a finger.
plan::Plan MakePlan() {
  plan::Plan plan;
  plan.dimension = 3;
  plan.friction_angle = Radians(20);
  plan.initial = {Hold(0, {0.03, 0, 0.01}, {-1, 0, 0}), Hold(1, {-0.03, 0, 0.01}, {1, 0, 0})};
  plan::Switch change;
  change.place = {Hold(2, {0, 0.03, 0}, {0, -1, 0})};
  change.release = {FingerIndex(1)};
  plan.steps = {plan::Move{}, change};
  return plan::ProjectPlan(Cube(), plan);
}

/// Return a hand with a palm below the cube and two fingers; the second one is behind it.
FigureHand MakeHand(const plan::Plan& plan) {
  HandView view = {{{FingerIndex(), 0}, false, MakeCapsule({-0.1, 0, 0}, {0.1, 0, 0}, 0.02)},
                   {{FingerIndex(0), 1}, true, MakeCapsule({0, 0, -0.06}, {0, 0, 0}, 0.01)},
                   {{FingerIndex(1), 1}, true, MakeCapsule({0, 0, -0.06}, {0, 0, 0}, 0.01)}};
  FigureHand hand = {std::make_shared<const HandView>(view), {"index", "thumb", "<b>&\n"}, {}};
  for (int entry = 0; entry < 3; ++entry) {
    plan::Snapshot snapshot = plan::MakePlannedSnapshot(plan, entry, {}, 0.01);
    const auto at = [](double x, double y, double z) {
      return Isometry3d(Eigen::Translation3d(x, y, z));
    };
    snapshot.links_W = {at(0, 0, -0.1), at(0.045, 0, 0.01), at(-0.045, 0, 0.01)};
    if (entry == 1) {
      snapshot.X_WO_before = Isometry3d(Eigen::AngleAxisd(Radians(30), Vector3d::UnitZ()));
    }
    hand.snapshots.push_back(snapshot);
  }
  return hand;
}

HandPanels MakePanels(const FigureHand& hand, const SolidFigureOptions& options = {}) {
  return {Cube(), MakePlan(), hand, options};
}

/// Return whether a file has a text. EXPECT_THAT would print the whole file.
bool Has(const std::string& svg, const std::string& text) {
  return svg.find(text) != std::string::npos;
}

std::string Svg(const HandPanels& panels, int index) {
  return DrawStepFigure(panels, index, {.format = FigureFormat::kSvg});
}

TEST(HandFigures, HaveAPanelPerEntryWithTheNamesOfFingers) {
  const HandPanels panels = MakePanels(MakeHand(MakePlan()));
  ASSERT_EQ(panels.count(), 3);
  EXPECT_EQ(panels.caption(0), "(a) hold: index, thumb");
  EXPECT_THAT(panels.caption(2), HasSubstr("release thumb"));
}

TEST(HandFigures, CaptionsStateTheMotionUpToNow) {
  FigureHand hand = MakeHand(MakePlan());
  const std::string without = MakePanels(hand).caption(1);
  hand.progress = {"0° of 30°", "30° of 30°", ""};
  const HandPanels panels = MakePanels(hand);
  EXPECT_EQ(panels.caption(1), without + " (30° of 30°)");
  EXPECT_EQ(panels.caption(2), MakePanels(MakeHand(MakePlan())).caption(2));
}

/// A view shows three of the six colours.
TEST(HandFigures, FacesOfTheSolidAreTintedByTheirDirection) {
  const std::string svg = Svg(MakePanels(MakeHand(MakePlan()), {.view = {{30, 30}}}), 0);
  int tints = 0;
  ShadedMesh faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d normal = sign * Vector3d::Unit(axis);
      faces.Add({Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()}, {normal, normal, normal});
    }
  }
  TintByDirection(faces);
  for (const auto& colors : faces.colors) {
    std::ostringstream fill;
    fill.precision(8);
    for (const int part : {colors[0].r, colors[0].g, colors[0].b}) {
      fill << (fill.str().empty() ? "rgb(" : ",") << 100 * part / 255.0 << "%";
    }
    tints += static_cast<int>(Has(svg, fill.str()));
  }
  EXPECT_EQ(tints, 3);
}

TEST(HandFigures, AreDeterministicAndSmall) {
  const FigureHand hand = MakeHand(MakePlan());
  const HandPanels first = MakePanels(hand), second = MakePanels(hand);
  for (const int entry : {0, 1, 2}) {
    const std::string svg = Svg(first, entry);
    EXPECT_TRUE(svg == Svg(second, entry));
    EXPECT_LT(svg.size(), 500'000U);
  }
}

TEST(HandFigures, ALinkThatThePanelCutsFadesOut) {
  constexpr char kGradient[] = "Gradient id=";
  const SolidFigureOptions from_front = {.view = ViewDirection{Radians(-90), Radians(10)}};
  FigureHand hand = MakeHand(MakePlan());
  EXPECT_FALSE(Has(Svg(MakePanels(hand, from_front), 0), kGradient));
  HandView view = *hand.view;
  view[1].mesh = MakeCapsule({0, 0, 0}, {5, 0, 0}, 0.01);  // longer than any panel
  hand.view = std::make_shared<const HandView>(view);
  const HandPanels panels = MakePanels(hand, from_front);
  const std::string svg = Svg(panels, 0);
  EXPECT_TRUE(Has(svg, kGradient));
  EXPECT_TRUE(svg == Svg(panels, 0)) << "identifiers of gradients differ";
}

TEST(HandFigures, PartsBehindTheObjectAreDashed) {
  const FigureHand hand = MakeHand(MakePlan());
  const auto from = [&](double azimuth) {
    return Svg(MakePanels(hand, {.view = ViewDirection{Radians(azimuth), Radians(10)}}), 0);
  };
  EXPECT_TRUE(Has(from(0), kDashed)) << "the second finger is behind the cube";
  EXPECT_FALSE(Has(from(90), kDashed)) << "both fingers are to the left and right of the cube";
}

TEST(HandFigures, AnInHandMotionHasAGhostOfTheFormerPose) {
  const HandPanels panels = MakePanels(MakeHand(MakePlan()));
  EXPECT_FALSE(Has(Svg(panels, 0), kGhost));
  EXPECT_TRUE(Has(Svg(panels, 1), kGhost));
}

TEST(HandFigures, AHandWithoutMeshesIsDrawnWithoutLines) {
  FigureHand hand = MakeHand(MakePlan());
  HandView empty = *hand.view;
  for (HandLinkView& link : empty) link.mesh = {};
  hand.view = std::make_shared<const HandView>(empty);
  const std::string svg = Svg(MakePanels(hand), 0);
  EXPECT_TRUE(Has(svg, "</svg>"));
  EXPECT_LT(svg.size(), Svg(MakePanels(MakeHand(MakePlan())), 0).size());
}

TEST(HandFigures, NamesAreDrawnAsGlyphsSoThatMarkupInThemIsHarmless) {
  EXPECT_FALSE(Has(Svg(MakePanels(MakeHand(MakePlan())), 2), "<b>"));
}

}  // namespace hand_figure_test
}  // namespace regrasp::render
