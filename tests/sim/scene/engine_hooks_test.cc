#include <gtest/gtest.h>

#include <memory>

#include "sim/scene/engine.h"

namespace regrasp::sim {
namespace engine_hooks_test {

TEST(EngineHooksTest, AreTakenFromTheFirstSimulationToTheLastWhicheverEndsFirst) {
  const auto error = mju_user_error;
  const auto warning = mju_user_warning;
  auto first = std::make_unique<EngineHooks>();
  auto second = std::make_unique<EngineHooks>();
  EXPECT_NE(mju_user_error, error);
  EXPECT_NE(mju_user_warning, warning);
  first.reset();
  EXPECT_NE(mju_user_error, error);
  EXPECT_NE(mju_user_warning, warning);
  second.reset();
  EXPECT_EQ(mju_user_error, error);
  EXPECT_EQ(mju_user_warning, warning);
}

}  // namespace engine_hooks_test
}  // namespace regrasp::sim
