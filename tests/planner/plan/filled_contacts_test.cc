#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/object/polyhedron.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/projection.h"
#include "tests/fixtures/soups.h"

namespace regrasp::plan {
namespace filled_contacts_test {

using ::testing::HasSubstr;

/// Return a cube whose side at x = 0.5 is a filled surface.
object::Polyhedron CubeWithFilledSide() {
  object::PolygonSoup cube = soups::UnitCubeSoup();
  cube.filled.assign(cube.facets.size(), false);
  cube.filled[3] = true;
  return object::Polyhedron::FromSoup(cube, "cube");
}

FingerContact Contact(int finger, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
  return {FingerIndex(finger), {p, n, {}}};
}

const FingerContact kLeft = Contact(0, {-0.5, 0, 0}, {1, 0, 0});
const FingerContact kRight = Contact(1, {0.5, 0, 0}, {-1, 0, 0});
const FingerContact kTop = Contact(2, {0, 0, 0.5}, {0, 0, -1});

std::string WarningOf(const Plan& plan) {
  const object::Polyhedron cube = CubeWithFilledSide();
  return FilledContactsWarning(cube, ProjectPlan(cube, plan));
}

TEST(FilledContacts, FingersOnTheOriginalSurfaceAreNoneToWarnOf) {
  Plan plan;
  plan.initial = {kLeft, kTop};
  EXPECT_EQ(WarningOf(plan), "");
}

TEST(FilledContacts, TheFirstIsNamedAndAllAreCounted) {
  Plan plan;
  plan.initial = {kLeft, kRight};
  EXPECT_THAT(WarningOf(plan), HasSubstr("1 contact is on filled surface "
                                         "(finger 1 in the initial grasp)"));
  plan.initial = {kLeft, kTop};
  plan.steps = {Switch{{kRight}, {}}, Align{{{kLeft, kTop, kRight}, {kLeft, kTop, kRight}}}};
  EXPECT_THAT(WarningOf(plan), HasSubstr("2 contacts are on filled surface "
                                         "(finger 1 in step 1)"));
}

}  // namespace filled_contacts_test
}  // namespace regrasp::plan
