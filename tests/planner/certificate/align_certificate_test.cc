#include "planner/certificate/align_certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "tests/fixtures/project_path.h"
#include "tests/planner/motion/random_boxes.h"

namespace regrasp::certificate {
namespace align_certificate_test {

using Eigen::Vector3d;

constexpr double kFrictionAngle = Radians(20);
const double kMu = std::tan(kFrictionAngle);

/// Return a sliding step with two motions over the sides of a cube. Its waypoints list the fingers
/// in different orders.
plan::Align MakeAlign() {
  grasp::Grasp middle = motion::CrossedGrasp();
  middle[0].p.y() += 0.1;
  middle[3].p.z() -= 0.1;
  grasp::Grasp end = middle;
  end[2].p.x() -= 0.1;
  plan::Align align{{plan::FingersInOrder(motion::CrossedGrasp()), plan::FingersInOrder(middle),
                     plan::FingersInOrder(end)}};
  std::ranges::reverse(align.waypoints[1]);
  std::ranges::rotate(align.waypoints[2], align.waypoints[2].begin() + 1);
  return align;
}

TEST(AlignCertificateTest, EachWayIsProvedInTheOrderOfItsFirstWaypoint) {
  const plan::Align align = MakeAlign();
  const auto certificate = FindAlignCertificate(align, 3, kFrictionAngle);
  ASSERT_TRUE(certificate);
  ASSERT_EQ(certificate->size(), 2U);
  const motion::ProofVerdict verdict = CheckAlignCertificate(align, 3, kMu, *certificate);
  EXPECT_TRUE(verdict.proves()) << verdict.why;
  // The force of the finger that a waypoint lists first points along that finger's normal.
  for (std::size_t w = 0; w < certificate->size(); ++w) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Vector3d& n = align.waypoints[w][i].contact.n;
      EXPECT_GT((*certificate)[w].front().start[i].dot(n), 0) << w << " " << i;
    }
  }
}

TEST(AlignCertificateTest, ForcesInAnotherOrderProveNothing) {
  const plan::Align align = MakeAlign();
  plan::AlignCertificate wrong = *FindAlignCertificate(align, 3, kFrictionAngle);
  std::ranges::reverse(wrong[1][0].start);
  const motion::ProofVerdict verdict = CheckAlignCertificate(align, 3, kMu, wrong);
  EXPECT_FALSE(verdict.proves());
  EXPECT_NE(verdict.why.find("waypoint 1"), std::string::npos) << verdict.why;
}

TEST(AlignCertificateTest, OfAnotherAlignOrLessFrictionOrTooFewWaysProvesNothing) {
  const plan::Align align = MakeAlign();
  const plan::AlignCertificate certificate = *FindAlignCertificate(align, 3, kFrictionAngle);
  plan::Align other = align;
  other.waypoints[1][0].contact.p.x() += 0.85;
  EXPECT_FALSE(CheckAlignCertificate(other, 3, kMu, certificate).proves());
  other = align;
  other.waypoints[1].pop_back();
  EXPECT_FALSE(CheckAlignCertificate(other, 3, kMu, certificate).proves());
  EXPECT_FALSE(FindAlignCertificate(other, 3, kFrictionAngle));
  EXPECT_FALSE(CheckAlignCertificate(align, 3, kMu / 10, certificate).proves());
  EXPECT_FALSE(CheckAlignCertificate(align, 3, kMu, {certificate[0]}).proves());
  EXPECT_FALSE(FindAlignCertificate(align, 3, Radians(1)));
}

TEST(AlignCertificateTest, PlansGetTheCertificatesThatTheyLack) {
  const object::ObjectFile cube = object::ReadObject(ProjectPath("models/cube.obj"));
  const double side = cube.object->diameter() / std::sqrt(12.0);
  plan::Plan plan;
  plan.friction_angle = kFrictionAngle;
  plan.fingers = 5;
  plan::Align align = MakeAlign();
  for (plan::FingerGrasp& waypoint : align.waypoints) {
    for (plan::FingerContact& held : waypoint) held.contact.p *= side;
  }
  plan::Align too_far = align;
  too_far.waypoints[1][0].contact.p.x() = 0.99 * side;
  too_far.waypoints[1][3].contact.p.y() = 0.99 * side;
  plan::Align claimed = align;
  claimed.certificate.emplace();
  plan.initial = align.waypoints[0];
  plan.steps = {align, too_far, claimed, plan::Switch{{}, {FingerIndex(0)}}};
  AddCertificates(*cube.object, plan);
  const auto certificate = [&](int step) {
    return std::get<plan::Align>(plan.steps[step]).certificate;
  };
  ASSERT_TRUE(certificate(0));
  EXPECT_TRUE(CheckAlignCertificate(align, 3, kMu, *certificate(0)).proves());
  EXPECT_FALSE(certificate(1)) << "force closure is lost on the way";
  EXPECT_TRUE(certificate(2)->empty()) << "what a planner claims stays";
}

}  // namespace align_certificate_test
}  // namespace regrasp::certificate
