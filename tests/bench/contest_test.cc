#include "bench/contest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/number.h"
#include "tests/fixtures/models.h"

namespace regrasp {
namespace contest_test {

constexpr ContestLimits kFewPairs = {5, 1e3};

struct Case {
  const char* model;
  ContestSetting setting;
  std::size_t asked;  ///< number of contenders that support the object
};

class Contests : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, Contests,
                         testing::Values(Case{"cube.obj", {Radians(25), 0, 4, 4}, 3},
                                         Case{"tetrahedron.obj", {Radians(10), 0, 4, 4}, 4},
                                         Case{"polygon20.wkt", {Radians(10), 0, 2, 2}, 4},
                                         Case{"polygon20.wkt", {Radians(10), 0, 2, 3}, 3}),
                         [](const auto& test) { return "case" + std::to_string(test.index); });

TEST_P(Contests, NoPlannerJoinsMoreThanGeneral) {
  const object::ObjectFile file = ReadModel(GetParam().model);
  const ContestSetting& setting = GetParam().setting;
  const std::vector<GraspPair> pairs = DrawPairs(*file.object, setting, kFewPairs);
  ASSERT_EQ(pairs.size(), 5);
  const Contest contest =
      RunContest(*file.object, pairs, MakeContenders(*file.object, setting), kFewPairs.seconds);
  std::size_t asked = 0;
  for (const Standing& standing : contest.standings) {
    EXPECT_NE(standing.answers.empty(), standing.absent.empty()) << standing.planner;
    if (standing.answers.empty()) continue;
    ++asked;
    EXPECT_EQ(standing.answers.size(), pairs.size()) << standing.planner;
    for (const PairAnswer& answer : standing.answers) {
      EXPECT_GT(answer.seconds, 0) << standing.planner;
      EXPECT_EQ(answer.joined, answer.steps > 0) << standing.planner;
      EXPECT_EQ(answer.joined, answer.travel > 0) << standing.planner;
      EXPECT_LE(answer.margin, setting.friction_angle) << standing.planner;
    }
  }
  EXPECT_EQ(asked, GetParam().asked);
  EXPECT_EQ(FindBetterThanGeneral(contest), std::nullopt);
  EXPECT_EQ(contest.standings.front().planner, kGeneral);
  EXPECT_EQ(contest.standings.front().joined_count(), 5);
}

TEST(Contest, DrawsTheSamePairsAgain) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const ContestSetting setting = {Radians(25), 0, 4, 4};
  const auto once = DrawPairs(*file.object, setting, kFewPairs);
  const auto again = DrawPairs(*file.object, setting, kFewPairs);
  ASSERT_EQ(once.size(), 5);
  ASSERT_EQ(again.size(), 5);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(once[i].start[3].p, again[i].start[3].p);
    EXPECT_EQ(once[i].goal[0].p, again[i].goal[0].p);
    EXPECT_NE(once[i].start[0].p, once[i].goal[0].p);
  }
}

TEST(Contest, HasNoPairsWhereNoGraspIsForceClosure) {
  // The corners of a triangle are wider than 10 degrees allow for two contacts.
  const object::ObjectFile file = ReadModel("triangle.wkt");
  EXPECT_TRUE(DrawPairs(*file.object, {Radians(5), 0, 2, 2}, kFewPairs).empty());
  EXPECT_FALSE(DrawPairs(*file.object, {Radians(5), 0, 2, 3}, kFewPairs).empty());
}

TEST(Contest, AsksForNoFurtherPairWhenTimeIsUp) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const std::vector<GraspPair> pairs(3);
  const Contender slow = {"slow", "", 0, [](const GraspPair&, std::uint64_t) {
                            Answer answer;
                            answer.seconds = 1;
                            return answer;
                          }};
  const auto count = [&](double seconds) {
    return RunContest(*file.object, pairs, {slow}, seconds).standings[0].answers.size();
  };
  EXPECT_EQ(count(0.5), 1);
  EXPECT_EQ(count(1.5), 2);
  EXPECT_EQ(count(10), 3);
}

TEST(Contest, SeesAPlannerThatJoinsMoreThanGeneral) {
  const auto standing = [](const char* name, const std::vector<bool>& joined) {
    Standing of_planner;
    of_planner.planner = name;
    for (const bool is : joined) of_planner.answers.push_back({is, 1, 1, 0, 0, 0, true});
    return of_planner;
  };
  Contest contest;
  contest.standings = {standing(kGeneral, {true, false, true}), standing("same", {false, true})};
  EXPECT_EQ(FindBetterThanGeneral(contest), std::nullopt);
  contest.standings.push_back(standing("better", {true, true}));
  EXPECT_EQ(FindBetterThanGeneral(contest), "better");
}

}  // namespace contest_test
}  // namespace regrasp
