// The common property of the fuzz targets rejects the behaviour that it must reject.

#include "hostile_input.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vector>

#include "mutation.h"
#include "planner/base/error.h"
#include "small_objects.h"

namespace regrasp {
namespace {

void ReadAndThrow(const std::string& message) {
  ReadHostileInput([&] { throw InputError(message); });
}

TEST(HostileInput, WhatIsReadAndWhatIsRefusedInOneLineCounts) {
  const HostileTally before = TallyOfHostileInputs();
  ReadHostileInput([] {});
  ReadAndThrow(kHostileName + ": line 1: no");
  EXPECT_EQ(TallyOfHostileInputs().read, before.read + 1);
  EXPECT_EQ(TallyOfHostileInputs().refused, before.refused + 1);
}

TEST(HostileInputDeathTest, OtherExceptionsAreFindings) {
  EXPECT_DEATH(ReadHostileInput([] { throw std::invalid_argument("theta"); }),
               "not an InputError: theta");
  EXPECT_DEATH(ReadHostileInput([] { throw EnvironmentError("disk"); }), "not an InputError: disk");
}

TEST(HostileInputDeathTest, MessagesOfSeveralLinesOrOfNoInputAreFindings) {
  EXPECT_DEATH(ReadAndThrow(kHostileName + ": one\ntwo"), "control characters");
  EXPECT_DEATH(ReadAndThrow(kHostileName + ": a tab\there"), "control characters");
  EXPECT_DEATH(ReadAndThrow("no name"), "does not name its input");
  EXPECT_DEATH(ReadAndThrow(kHostileName + ": "), "does not name its input");
  EXPECT_DEATH(ReadAndThrow(""), "does not name its input");
}

TEST(HostileInput, SoundObjectsAreSound) {
  ExpectSound(SmallSolid());
  ExpectSound(SmallPolygon());
}

TEST(Mutation, IsTheSameForTheSameSeedAndChangesMostInputs) {
  const std::vector<std::string> inputs = {"POLYGON((0 0, 1 0, 0 1, 0 0))", "v 1 2 3", ""};
  std::mt19937_64 first(1), second(1);
  int changed = 0;
  constexpr int kMutations = 200;
  for (int k = 0; k < kMutations; ++k) {
    const std::string& input = inputs[k % inputs.size()];
    const std::string mutation = Mutate(input, inputs, first);
    EXPECT_EQ(mutation, Mutate(input, inputs, second)) << k;
    changed += mutation != input;
  }
  EXPECT_GT(changed, kMutations / 2);
}

}  // namespace
}  // namespace regrasp
