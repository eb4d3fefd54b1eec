#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "planner/planning/candidate_sequence.h"

namespace regrasp::planning {
namespace switch_sequence_test {

using testing::ElementsAre;

/// Return a contact identified by one number.
grasp::Contact At(double x) { return {{x, 0, 0}, {1, 0, 0}, FaceIndex(0)}; }

std::vector<FingerIndex> Fingers(const plan::FingerGrasp& grasp) {
  std::vector<FingerIndex> fingers;
  for (const plan::FingerContact& contact : grasp) fingers.push_back(contact.finger);
  return fingers;
}

std::vector<double> Places(const plan::FingerGrasp& grasp) {
  std::vector<double> places;
  for (const plan::FingerContact& contact : grasp) places.push_back(contact.contact.p.x());
  return places;
}

TEST(MakeSwitchSequence, GivesTheFreeFingerTheNewContactAndReleasesTheOldOne) {
  const std::vector<grasp::Grasp> grasps = {
      {At(1), At(2), At(3), At(4)}, {At(3), At(5), At(1), At(4)}, {At(5), At(6), At(3), At(4)}};
  const CandidateSequence sequence = MakeSwitchSequence(grasps, 5);
  EXPECT_THAT(Fingers(sequence.initial), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(Places(sequence.initial), ElementsAre(1, 2, 3, 4));
  ASSERT_EQ(sequence.steps.size(), 2u);
  EXPECT_THAT(sequence.grasps, testing::SizeIs(3));
  const auto& first = std::get<plan::Switch>(sequence.steps[0]);
  EXPECT_THAT(Fingers(first.place), ElementsAre(4));
  EXPECT_THAT(Places(first.place), ElementsAre(5));
  EXPECT_THAT(first.release, ElementsAre(1));
  const auto& second = std::get<plan::Switch>(sequence.steps[1]);
  EXPECT_THAT(Fingers(second.place), ElementsAre(1));
  EXPECT_THAT(Places(second.place), ElementsAre(6));
  EXPECT_THAT(second.release, ElementsAre(0));
}

TEST(MakeSwitchSequence, SwitchesSeveralFingersWhereTheHandHasThem) {
  const std::vector<grasp::Grasp> grasps = {{At(1), At(2)}, {At(3), At(4)}};
  const CandidateSequence sequence = MakeSwitchSequence(grasps, 4);
  ASSERT_EQ(sequence.steps.size(), 1u);
  const auto& step = std::get<plan::Switch>(sequence.steps[0]);
  EXPECT_THAT(Fingers(step.place), ElementsAre(2, 3));
  EXPECT_THAT(step.release, ElementsAre(0, 1));
  EXPECT_THROW((void)MakeSwitchSequence(grasps, 3), std::invalid_argument);
}

TEST(MakeSwitchSequence, TellsContactsAtOnePointByTheirNormals) {
  grasp::Contact turned = At(1);
  turned.n = {0, 1, 0};
  const std::vector<grasp::Grasp> grasps = {{At(1), At(2)}, {turned, At(2)}};
  EXPECT_EQ(MakeSwitchSequence(grasps, 3).steps.size(), 1u);
}

TEST(MakeSwitchSequence, HasNoStepForTheSameGraspInAnotherOrder) {
  const std::vector<grasp::Grasp> grasps = {{At(1), At(2), At(3)}, {At(3), At(1), At(2)}};
  EXPECT_TRUE(MakeSwitchSequence(grasps, 3).steps.empty());
  EXPECT_THAT(MakeSwitchSequence(grasps, 3).grasps, testing::SizeIs(1));
}

TEST(MakeSwitchSequence, RefusesNothingAndHandsThatAreTooSmall) {
  EXPECT_THROW((void)MakeSwitchSequence({}, 5), std::invalid_argument);
  const std::vector<grasp::Grasp> grasps = {{At(1), At(2), At(3)}};
  EXPECT_THROW((void)MakeSwitchSequence(grasps, 2), std::invalid_argument);
}

}  // namespace switch_sequence_test
}  // namespace regrasp::planning
