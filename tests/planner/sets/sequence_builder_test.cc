#include "planner/sets/sequence_builder.h"

#include <gtest/gtest.h>

#include "tests/fixtures/edge_grasp.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::sets {
namespace finger_sequence_test {

const object::Polygon kSquare = Square(1);
const grasp::Grasp kUpright = MakeGrasp(kSquare, {{0, 0.5}, {2, 0.5}});
const grasp::Grasp kMixed = MakeGrasp(kSquare, {{0, 0.5}, {2, 0.5}, {1, 0.5}});
const grasp::Grasp kLevel = MakeGrasp(kSquare, {{1, 0.5}, {3, 0.5}});

TEST(FollowTo, FingersStayOnTheirFacesAndTheOneWhoseFaceIsGoneTakesTheContactThatIsLeft) {
  const plan::FingerGrasp holding = plan::FingersInOrder(kMixed);
  const grasp::Grasp next = MakeGrasp(kSquare, {{3, 0.1}, {1, 0.6}, {0, 0.4}});
  const plan::FingerGrasp after = FollowTo(holding, next);
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(after[0].contact.p, next[2].p);
  EXPECT_EQ(after[1].contact.p, next[0].p);
  EXPECT_EQ(after[2].contact.p, next[1].p);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(after[k].finger, holding[k].finger);
}

TEST(FingerSequence, ASwitchToTheGraspAtHandIsNoStep) {
  FingerSequence sequence(kUpright, 4);
  sequence.SwitchTo(kUpright, std::nullopt);
  EXPECT_TRUE(sequence.candidate().steps.empty());
  EXPECT_EQ(sequence.candidate().grasps.size(), 1U);
}

TEST(FingerSequence, TwoSwitchesInARowAreOneWhereTheHandHasTheFingers) {
  for (const int fingers : {3, 4}) {
    FingerSequence sequence(kUpright, fingers);
    sequence.SwitchTo(MakeGrasp(kSquare, {{2, 0.5}, {1, 0.5}}), search::VertexPair(0, 1));
    sequence.SwitchTo(kLevel, search::VertexPair(1, 2));
    EXPECT_EQ(sequence.candidate().steps.size(), fingers == 3 ? 2U : 1U);
    EXPECT_EQ(sequence.candidate().grasps.size(), sequence.candidate().steps.size() + 1);
    EXPECT_EQ(sequence.candidate().grasps.back().chosen_for, search::VertexPair(1, 2));
  }
}

TEST(FingerSequence, SwitchesWithARegionStayAsTheyAreAndTellItOfWhatTheyPlace) {
  FingerSequence sequence(kUpright, 4);
  sequence.SwitchTo(kMixed, std::nullopt, 0.25);
  sequence.SwitchTo(kLevel, std::nullopt, 0.125);
  ASSERT_EQ(sequence.candidate().steps.size(), 2U);
  const auto& last = std::get<plan::Switch>(sequence.candidate().steps.back());
  ASSERT_EQ(last.place.size(), 1U);
  EXPECT_EQ(last.place.front().region, 0.125);
}

TEST(FingerSequence, AnAlignMovesTheFingersAndIsNotJoinedWithASwitch) {
  FingerSequence sequence(kUpright, 4);
  const grasp::Grasp moved = MakeGrasp(kSquare, {{2, 0.4}, {0, 0.6}});
  sequence.AlignAlong({kUpright, moved}, std::nullopt);
  sequence.SwitchTo(kLevel, std::nullopt);
  ASSERT_EQ(sequence.candidate().steps.size(), 2U);
  const auto& align = std::get<plan::Align>(sequence.candidate().steps.front());
  ASSERT_EQ(align.waypoints.size(), 2U);
  EXPECT_EQ(align.waypoints[1][0].contact.p, moved[1].p);
  EXPECT_EQ(sequence.candidate().grasps[1].grasp[1].p, moved[0].p);
}

}  // namespace finger_sequence_test
}  // namespace regrasp::sets
