#include "planner/repair/run_stage.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "tests/fixtures/soups.h"

namespace regrasp::repair {
namespace run_stage_test {

StageResult CubeWithFacts() {
  StageResult result{soups::UnitCubeSoup()};
  result.facts["holes"] = 3;
  return result;
}

TEST(RunStage, ResultAndFactsComeBack) {
  const StageRun run = RunStage(CubeWithFacts, {});
  ASSERT_TRUE(run.result);
  EXPECT_EQ(run.result->facts["holes"], 3);
  EXPECT_EQ(run.result->soup.facets, soups::UnitCubeSoup().facets);
}

TEST(RunStage, AStageThatCannotGoOnSaysWhy) {
  const StageRun run = RunStage([]() -> StageResult { throw std::runtime_error("no"); }, {});
  EXPECT_FALSE(run.result);
  EXPECT_EQ(run.failure, "no");
}

TEST(RunStage, AStageThatCrashesTakesNothingWithIt) {
  const StageRun run = RunStage([]() -> StageResult { std::abort(); }, {});
  EXPECT_FALSE(run.result);
  EXPECT_EQ(run.failure, "crashed or ran out of memory");
}

}  // namespace run_stage_test
}  // namespace regrasp::repair
