#include "planner/object/object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "planner/object/polyhedron.h"
#include "tests/fixtures/counted_deadline.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::object {
namespace reading_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kCube = ProjectPath("models/cube.obj");
const std::string kSquare = ProjectPath("models/square.wkt");
const std::string kScene = ProjectPath("tests/data/objects/good/placed.gltf");

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

/// Make a block of n × n × 1 cells.
PolygonSoup Block(int n) {
  PolygonSoup soup;
  const auto vertex = [n](int x, int y, int z) { return (z * (n + 1) + y) * (n + 1) + x; };
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) soup.vertices.emplace_back(x, y, z);
    }
  }
  for (int i = 0; i < n; ++i) {
    soup.facets.push_back(
        {vertex(i, 0, 0), vertex(i + 1, 0, 0), vertex(i + 1, 0, 1), vertex(i, 0, 1)});
    soup.facets.push_back(
        {vertex(i + 1, n, 0), vertex(i, n, 0), vertex(i, n, 1), vertex(i + 1, n, 1)});
    soup.facets.push_back(
        {vertex(0, i + 1, 0), vertex(0, i, 0), vertex(0, i, 1), vertex(0, i + 1, 1)});
    soup.facets.push_back(
        {vertex(n, i, 0), vertex(n, i + 1, 0), vertex(n, i + 1, 1), vertex(n, i, 1)});
    for (int j = 0; j < n; ++j) {
      soup.facets.push_back(
          {vertex(i, j, 0), vertex(i, j + 1, 0), vertex(i + 1, j + 1, 0), vertex(i + 1, j, 0)});
      soup.facets.push_back(
          {vertex(i, j, 1), vertex(i + 1, j, 1), vertex(i + 1, j + 1, 1), vertex(i, j + 1, 1)});
    }
  }
  return soup;
}

TEST(Reading, LooksAtTheDeadlineWhileItLooksForIntersections) {
  const auto looks = [](int n) {
    const CountedDeadline never;
    Reading reading;
    reading.deadline = never.deadline();
    EXPECT_EQ(Polyhedron::FromSoup(Block(n), "block", reading).face_count(), 6);
    return never.looks();
  };
  EXPECT_GT(looks(60), looks(2) + 3);  // about 14,400 triangles with a dozen neighbours each
}

TEST(Reading, EndsAtTheDeadlineInWhicheverStageItComes) {
  for (const std::string& path : {kCube, kSquare, kScene}) {
    const CountedDeadline never;
    EXPECT_EQ(WhatStops(path, never.deadline()), "");
    EXPECT_GE(never.looks(), 2) << path;
    for (int look = 1; look <= never.looks(); ++look) {
      EXPECT_THAT(WhatStops(path, CountedDeadline(look).deadline()),
                  AllOf(StartsWith(path), HasSubstr("time limit reached while reading")))
          << look;
    }
  }
}

}  // namespace reading_test
}  // namespace regrasp::object
