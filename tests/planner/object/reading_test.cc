#include "planner/object/reading.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/planner/counted_deadline.h"

namespace regrasp {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kCube = REGRASP_SOURCE_DIR "/models/cube.obj";
const std::string kSquare = REGRASP_SOURCE_DIR "/models/square.wkt";
const std::string kScene = REGRASP_TEST_DATA "/objects/good/placed.gltf";

std::string WhatStops(const std::string& path, const Deadline& deadline) {
  Reading reading;
  reading.deadline = deadline;
  try {
    static_cast<void>(ReadObject(path, reading));
    return "";
  } catch (const TimeUp& time_up) {
    return time_up.what();
  }
}

TEST(Reading, TellsItsStages) {
  std::vector<std::string> told;
  const Reading reading = {[&](std::string_view text) { told.emplace_back(text); }, {}};
  EXPECT_EQ(ReadObject(kCube, reading).object->face_count(), 6);
  EXPECT_THAT(told, ElementsAre(AllOf(StartsWith("reading "), EndsWith("cube.obj")),
                                HasSubstr("facets"), HasSubstr("facets"), HasSubstr("facets"),
                                HasSubstr("facets"), HasSubstr("6 faces")));
}

TEST(Reading, EndsAtTheDeadlineInWhicheverStageItComes) {
  for (const std::string& path : {kCube, kSquare, kScene}) {
    const CountedDeadline never;
    EXPECT_EQ(WhatStops(path, never.deadline()), "");
    EXPECT_GE(never.looks(), 2) << path;
    for (int look = 1; look <= never.looks(); ++look) {
      EXPECT_THAT(WhatStops(path, CountedDeadline(look).deadline()),
                  AllOf(StartsWith(path), HasSubstr("the time was up while it was read")))
          << look;
    }
  }
}

}  // namespace
}  // namespace regrasp
