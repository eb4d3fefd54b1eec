#include "render/picture/fault_text.h"

#include <gtest/gtest.h>

#include "planner/base/angle.h"

namespace regrasp::render {
namespace {

using Eigen::Vector3d;
using plan::Fault;
using plan::Reason;

Fault Misplaced(const Vector3d& away, double turned = 0) {
  const Vector3d n = Vector3d::UnitX();
  return {.fingers = {FingerIndex(2)},
          .found = grasp::Contact{away, Eigen::AngleAxisd(turned, Vector3d::UnitZ()) * n},
          .expected = {{Vector3d::Zero(), n}}};
}

TEST(FaultText, TellsANumberAndItsUnit) {
  const auto text = [](Reason reason, const Fault& fault) {
    return FaultText(reason, fault, "detail", 0.001);
  };
  EXPECT_EQ(text(Reason::kOffSurface, Misplaced({4.1, 0, 0})),
            "finger 2 is 4.1 mm off the surface");
  EXPECT_EQ(text(Reason::kOffSurface, Misplaced({4.1e6, 0, 0})),
            "finger 2 is 4.1 km off the surface");
  EXPECT_EQ(text(Reason::kWrongNormal, Misplaced({0, 0, 0}, Radians(23))),
            "the normal of finger 2 is off by 23.00°");
  EXPECT_EQ(text(Reason::kDiscontinuous, Misplaced({0, 3, 0}, Radians(90))),
            "finger 2 is 3 mm from where it was, turned by 90.00°");
  EXPECT_EQ(text(Reason::kNotForceClosure, {.required = Radians(7.34), .half_angle = Radians(6)}),
            "the grasp needs 7.34°, has 6.00°");
  Fault slipped = Misplaced({0, 0.3, 0});
  slipped.push = plan::FaultPush{{0, 0, -5.25}, Vector3d::Zero()};
  EXPECT_EQ(text(Reason::kSlipped, slipped), "finger 2 slipped by 300 µm under a push of 5.2 N");
  Fault moved;
  moved.X_WO_before = Eigen::Isometry3d::Identity();
  moved.moved_m = 0.0012;
  moved.turned = Radians(0.5);
  EXPECT_EQ(text(Reason::kObjectMoved, moved), "the object moved by 1.2 mm and turned by 0.50°");
}

TEST(FaultText, IsTheDetailWhereThereIsNoNumber) {
  EXPECT_EQ(FaultText(Reason::kTooManyFingers, {.fingers = {FingerIndex(7)}}, "finger 7", 1),
            "finger 7");
  EXPECT_EQ(FaultText(Reason::kWrongNormal, Misplaced({0, 0, 0}), "the normal is 1.001 long", 1),
            "the normal is 1.001 long");
  EXPECT_EQ(FaultText(Reason::kNotForceClosure, {}, "", 1),
            "the grasp is force closure at no friction");
}

}  // namespace
}  // namespace regrasp::render
