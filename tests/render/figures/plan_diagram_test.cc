#include <gmock/gmock.h>

#include <set>

#include "planner/base/number.h"
#include "render/figures/plan_figure.h"
#include "tests/render/figures/planar_scenes.h"

namespace regrasp::render {
namespace plan_diagram_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<int> FingersOf(const StepDiagram& diagram, plan::FingerRole role) {
  std::vector<int> fingers;
  for (const DiagramFinger& finger : diagram.fingers) {
    if (finger.role == role) fingers.push_back(finger.finger);
  }
  return fingers;
}

std::vector<StepDiagram> DescribeSquarePlan() {
  return DescribePlan(MakeSquare(), MakeSquarePlan());
}

TEST(PlanDiagramTest, HasTheInitialGraspAndThenAFigurePerStep) {
  const std::vector<StepDiagram> diagrams = DescribeSquarePlan();
  ASSERT_EQ(diagrams.size(), 4U);
  EXPECT_EQ(diagrams[0].kind, "hold");
  EXPECT_EQ(diagrams[1].kind, "align");
  EXPECT_EQ(diagrams[2].kind, "switch");
  EXPECT_EQ(diagrams[3].kind, "switch");
}

TEST(PlanDiagramTest, DescribesTheActionOfEachFinger) {
  const std::vector<StepDiagram> diagrams = DescribeSquarePlan();
  ASSERT_EQ(diagrams.size(), 4U);
  EXPECT_THAT(FingersOf(diagrams[0], plan::FingerRole::kHolding), ElementsAre(0, 1, 2));
  EXPECT_THAT(FingersOf(diagrams[1], plan::FingerRole::kMoved), ElementsAre(0));
  EXPECT_THAT(FingersOf(diagrams[1], plan::FingerRole::kHolding), ElementsAre(1, 2));
  EXPECT_THAT(FingersOf(diagrams[2], plan::FingerRole::kPlaced), ElementsAre(3));
  EXPECT_THAT(FingersOf(diagrams[2], plan::FingerRole::kReleased), ElementsAre(0));
  EXPECT_THAT(FingersOf(diagrams[3], plan::FingerRole::kPlaced), ElementsAre(0));
  EXPECT_THAT(FingersOf(diagrams[3], plan::FingerRole::kReleased), ElementsAre(1, 2));
}

TEST(PlanDiagramTest, EveryConeBelongsToTheFingerAtItsPlaceInTheList) {
  int checked = 0;
  for (const StepDiagram& diagram : DescribeSquarePlan()) {
    ASSERT_LE(diagram.grasp.cones.size(), diagram.fingers.size());
    for (std::size_t i = 0; i < diagram.grasp.cones.size(); ++i, ++checked) {
      EXPECT_EQ(diagram.grasp.cones[i].apex, diagram.fingers[i].contact.p);
      EXPECT_NE(diagram.fingers[i].role, plan::FingerRole::kReleased);
    }
  }
  EXPECT_EQ(checked, 3 + 3 + 3 + 2);
}

TEST(PlanDiagramTest, AReleasedFingerIsAtItsFormerContact) {
  const StepDiagram diagram = DescribeSquarePlan()[2];
  const DiagramFinger& released = diagram.fingers.back();
  ASSERT_EQ(released.role, plan::FingerRole::kReleased);
  EXPECT_LT((released.contact.p - Eigen::Vector2d(-0.2, -1)).norm(), 1e-12);
  EXPECT_LT((released.contact.outward - Eigen::Vector2d(0, -1)).norm(), 1e-12);
}

TEST(PlanDiagramTest, AMovedFingerHasItsWayAndTheOthersHaveNone) {
  const StepDiagram diagram = DescribeSquarePlan()[1];
  int moved = 0;
  for (const DiagramFinger& finger : diagram.fingers) {
    if (finger.role != plan::FingerRole::kMoved) {
      EXPECT_TRUE(finger.path.empty());
      continue;
    }
    ++moved;
    ASSERT_EQ(finger.path.size(), 2U);
    EXPECT_EQ(finger.path.front().p, Eigen::Vector2d(0, -1));
    EXPECT_EQ(finger.path.back().p, finger.contact.p);
    EXPECT_NE(finger.path.front().p, finger.path.back().p);
  }
  EXPECT_EQ(moved, 1);
}

TEST(PlanDiagramTest, CaptionsNameStepAndTypeOfGrasp) {
  const std::vector<StepDiagram> diagrams = DescribeSquarePlan();
  ASSERT_EQ(diagrams.size(), 4U);
  EXPECT_EQ(diagrams[0].caption, "(a) hold: fingers 0, 1, 2; parallel grasp");
  EXPECT_EQ(diagrams[1].caption, "(b) align: move 0; parallel grasp");
  EXPECT_EQ(diagrams[2].caption, "(c) switch: place 3, release 0; parallel grasp");
  EXPECT_EQ(diagrams[3].caption, "(d) switch: place 0, release 1, 2; 2-finger grasp");
}

TEST(PlanDiagramTest, ACaptionStatesConesNarrowerThanTheFriction) {
  plan::Plan plan = MakeTrianglePlan();
  EXPECT_THAT(DescribePlan(MakeTriangle(), plan)[0].caption, Not(HasSubstr("φ")));
  plan.friction_angle = Radians(30);  // exactly φ*
  EXPECT_THAT(DescribePlan(MakeTriangle(), plan)[0].caption, Not(HasSubstr("φ")));
  plan.friction_angle = Radians(40);
  EXPECT_THAT(DescribePlan(MakeTriangle(), plan)[0].caption,
              HasSubstr("concurrent grasp; φ = 30° < θ = 40°"));
}

TEST(PlanDiagramTest, LabelsOfPanelsGoOnAfterTheAlphabet) {
  EXPECT_EQ(PanelLabel(0), "(a)");
  EXPECT_EQ(PanelLabel(25), "(z)");
  EXPECT_EQ(PanelLabel(26), "(aa)");
  EXPECT_EQ(PanelLabel(27), "(ab)");
  EXPECT_EQ(PanelLabel(26 + 26 * 26), "(aaa)");
  std::set<std::string> labels;
  for (int i = 0; i < 2000; ++i) labels.insert(PanelLabel(i));
  EXPECT_EQ(labels.size(), 2000U);
}

}  // namespace plan_diagram_test
}  // namespace regrasp::render
