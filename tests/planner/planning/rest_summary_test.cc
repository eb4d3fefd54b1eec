#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "planner/base/number.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/object/polygon.h"
#include "planner/planning/candidate_sequence.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::planning {
namespace rest_summary_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RestSummary : public testing::Test {
 protected:
  /// Return fingers on the bottom and top of the unit square.
  [[nodiscard]] StaticGrasp At(double bottom, double top) const {
    return {{{{bottom, 0, 0}, square_.inward_normal(FaceIndex(0)), FaceIndex(0)},
             {{top, 1, 0}, square_.inward_normal(FaceIndex(2)), FaceIndex(2)}},
            std::nullopt};
  }

  const object::Polygon square_ = Square(1);
  const criteria::GraspEvaluator evaluator_{square_, {Radians(30), 0.04}};
  const StaticGrasp good_ = At(0.5, 0.5);
  // tan 30° = 0.577.
  const StaticGrasp weak_ = At(0.22, 0.78);
  const StaticGrasp weaker_ = At(0.22, 0.79);
};

TEST_F(RestSummary, GoodGraspsGiveNoWarning) {
  EXPECT_THAT(GraspWarnings({good_, good_}, evaluator_), IsEmpty());
}

TEST_F(RestSummary, OfTheGraspsBelowACriterionTheWeakestIsNamed) {
  const double quality =
      grasp::ComputeQuality(weaker_.grasp, square_.wrench_frame(), Radians(30)).lower;
  EXPECT_THAT(
      GraspWarnings({good_, weak_, weaker_, weak_}, evaluator_),
      ElementsAre(AllOf(HasSubstr("quality falls below the required 0.04"),
                        HasSubstr(FormatShort(quality) + " in the grasp after step 2 of 3"))));
  EXPECT_THAT(GraspWarnings({weak_, good_}, evaluator_),
              ElementsAre(HasSubstr("the start grasp (step 0)")));
}

TEST_F(RestSummary, AFingertipInACornerIsNamed) {
  const object::Polygon notch =
      object::Polygon::FromRings({{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 1}, {0, 1}}}, "notch");
  const criteria::GraspEvaluator evaluator(notch, {Radians(30), 0});
  const StaticGrasp corner = {
      {{{1.9999, 0, 0}, {0, 1, 0}, FaceIndex(0)}, {{1.9999, 1, 0}, {0, -1, 0}, FaceIndex(4)}},
      std::nullopt};
  EXPECT_THAT(GraspWarnings({corner}, evaluator), ElementsAre(HasSubstr("so no fingertip fits")));
}

TEST_F(RestSummary, TheSmallestMarginIsThatOfTheWeakestGrasp) {
  EXPECT_NEAR(SmallestMargin({good_, At(0.4, 0.6), good_}, evaluator_),
              Radians(30) - std::atan(0.2), 1e-6);
}

TEST_F(RestSummary, TheSmallestMarginIsThatOfAllWhateverTheirOrder) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> lean(-0.57, 0.57);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<StaticGrasp> rests;
    double smallest = Radians(30);
    for (int i = 0; i < 6; ++i) {
      const double off = lean(engine) / 2;
      rests.push_back(At(0.5 - off, 0.5 + off));
      const auto required =
          grasp::ComputeRequiredFrictionAngle(rests.back().grasp, square_.wrench_frame());
      smallest = std::min(smallest, Radians(30) - required.value().upper);
    }
    EXPECT_EQ(SmallestMargin(rests, evaluator_), smallest);
    std::ranges::reverse(rests);
    EXPECT_EQ(SmallestMargin(rests, evaluator_), smallest);
  }
}

}  // namespace rest_summary_test
}  // namespace regrasp::planning
