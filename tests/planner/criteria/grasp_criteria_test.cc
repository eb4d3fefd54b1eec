#include "planner/criteria/grasp_criteria.h"

#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "planner/grasp/quality.h"
#include "planner/object/polygon.h"
#include "tests/fixtures/polygons.h"

namespace regrasp::criteria {
namespace grasp_criteria_test {

class GraspCriteriaTest : public testing::Test {
 protected:
  /// Return contacts on the bottom and top of the unit square, displaced along them by `lean`.
  [[nodiscard]] grasp::Grasp Leaning(double lean) const {
    return {{{0.5 - lean / 2, 0, 0}, square_.inward_normal(FaceIndex(0)), FaceIndex(0)},
            {{0.5 + lean / 2, 1, 0}, square_.inward_normal(FaceIndex(2)), FaceIndex(2)}};
  }
  [[nodiscard]] double QualityOf(const grasp::Grasp& grasp) const {
    return grasp::ComputeQuality(grasp, frame_, Radians(30)).lower;
  }

  const object::Polygon square_ = Square(1);
  const object::WrenchFrame frame_ = square_.wrench_frame();
  // tan 30° = 0.577.
  const grasp::Grasp weak_ = Leaning(0.57);
};

TEST_F(GraspCriteriaTest, ALeastShareAsksForNothingAndAllOfThemForAll) {
  const GraspCriteria criteria{Radians(30), 0.04};
  EXPECT_TRUE(criteria.AsksMore());
  EXPECT_EQ(criteria.Relaxed(1).min_quality, 0.04);
  EXPECT_EQ(criteria.Relaxed(0.5).min_quality, 0.02);
  EXPECT_FALSE(criteria.Relaxed(0).AsksMore());
  EXPECT_EQ(criteria.Relaxed(0).friction_angle, criteria.friction_angle);
}

TEST_F(GraspCriteriaTest, AGraspMeetsTheShareOfTheCriteriaThatItsQualityIs) {
  const double quality = QualityOf(weak_);
  const GraspCriteria criteria{Radians(30), 2 * quality};
  EXPECT_FALSE(MeetsCriteria(weak_, frame_, criteria));
  EXPECT_NEAR(Shortfall(weak_, frame_, criteria), -0.5, 0.1);
  EXPECT_FALSE(MeetsCriteria(weak_, frame_, criteria.Relaxed(0.55)));
  EXPECT_TRUE(MeetsCriteria(weak_, frame_, criteria.Relaxed(0.45)));
  EXPECT_TRUE(MeetsCriteria(weak_, frame_, criteria.Relaxed(0)));
}

TEST_F(GraspCriteriaTest, UnmetCriteriaAreNamedWithWhatWasAskedAndReached) {
  const double quality = QualityOf(weak_);
  const auto unmet = FindUnmet(weak_, frame_, {Radians(30), 2 * quality});
  ASSERT_EQ(unmet.size(), 1u);
  EXPECT_EQ(unmet[0].name, "quality");
  EXPECT_EQ(unmet[0].asked, 2 * quality);
  EXPECT_EQ(unmet[0].reached, quality);
  EXPECT_TRUE(FindUnmet(weak_, frame_, {Radians(30), 0.5 * quality}).empty());
  EXPECT_TRUE(FindUnmet(weak_, frame_, {Radians(30), 0}).empty());
}

TEST_F(GraspCriteriaTest, MessagesSayWhatIsAskedForBeyondForceClosure) {
  EXPECT_EQ(WithWhatIsAsked({Radians(30), 0.01}), " with a quality of at least 0.01");
  EXPECT_EQ(WithWhatIsAsked({Radians(30), 0}), "");
}

}  // namespace grasp_criteria_test
}  // namespace regrasp::criteria
