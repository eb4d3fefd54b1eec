// Fingers on non-convex objects: the contacts that they must have, and the contacts that they must
// not have.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "sim/scene/contact_patches.h"
#include "sim/scene/scaling.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace nonconvex_contacts_test {

using Eigen::Vector3d;

/// Counts of contacts of the fingers in static grasps.
struct TouchCount {
  int contacts = 0;
  int ghosts = 0;            ///< wrong face, or a force that the planned face cannot exert
  int missed = 0;            ///< holding fingers without force
  double largest_error = 0;  ///< error of the contact point, over the diameter
};

/// Share of all forces below which a finger counts as without force.
constexpr double kNoForce = 1e-9;
/// Angle by which a force may exceed the friction cone because the engine's contacts creep,
/// radians.
constexpr double kOutside = 0.01;
/// Tolerance of a fingertip's contact point, over the diameter: a tenth of the slip limit.
constexpr double kTouch = 1e-4;

/// Compare the contact points in the static grasp with those of the plan.
void Count(const object::Object& object, const plan::FingerGrasp& planned,
           const plan::Snapshot& rest, double friction_angle, TouchCount& count) {
  double all_forces = 0;
  for (const plan::FingerState& state : rest.fingers) all_forces += state.force_W.norm();
  const Eigen::Isometry3d X_OW = rest.X_WO.inverse();
  for (const plan::FingerContact& held : planned) {
    const auto state = std::ranges::find(rest.fingers, held.finger, &plan::FingerState::finger);
    ASSERT_NE(state, rest.fingers.end());
    ++count.contacts;
    const Vector3d force_O = X_OW.linear() * state->force_W;
    if (force_O.norm() <= kNoForce * all_forces) {
      ++count.missed;
      continue;
    }
    const Vector3d touch_O = X_OW * state->contact_W;
    const double along = force_O.dot(held.contact.n) / force_O.norm();
    const bool own_force = std::acos(std::clamp(along, -1.0, 1.0)) <= friction_angle + kOutside;
    const double to_own =
        (object.ClosestPoint(held.contact.face, touch_O) - touch_O).norm() / object.diameter();
    if (!own_force || to_own > kTouch) ++count.ghosts;
    count.largest_error =
        std::max(count.largest_error, (touch_O - held.contact.p).norm() / object.diameter());
  }
}

/// Replay a grasp and count its contacts.
TouchCount Hold(const object::Object& object, const plan::FingerGrasp& grasp, double degrees) {
  const plan::Plan plan = MakePlan(grasp, degrees);
  const ReplayResult result = ReplayPlan(object, plan, {});
  TouchCount count;
  EXPECT_EQ(result.steps.at(0).reason, plan::Reason::kNone) << result.steps[0].detail;
  Count(object, grasp, result.steps[0].snapshot, Radians(degrees), count);
  return count;
}

void ExpectTouchesItsOwn(const TouchCount& count, int contacts) {
  EXPECT_EQ(count.contacts, contacts);
  EXPECT_EQ(count.ghosts, 0);
  EXPECT_EQ(count.missed, 0);
  EXPECT_LT(count.largest_error, kTouch);
}

/// Return a solid of squares about the z axis, each connected to the next: steps, posts and holes.
object::Polyhedron MakeTower(const std::vector<std::pair<double, double>>& half_and_height) {
  object::PolygonSoup soup;
  for (const auto& [half, z] : half_and_height) {
    soup.vertices.insert(soup.vertices.end(),
                         {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
  }
  const int last = static_cast<int>(soup.vertices.size()) - 4;
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    for (int ring = 0; ring < last; ring += 4) {
      soup.facets.push_back({ring + i, ring + next, ring + 4 + next, ring + 4 + i});
    }
  }
  soup.facets.push_back({3, 2, 1, 0});
  soup.facets.push_back({last, last + 1, last + 2, last + 3});
  return object::Polyhedron::FromSoup(soup, "tower");
}

/// Return a block of 10 × 10 × 6 cm with a blind hole of 2 × 2 cm, 4 cm deep, in its top.
object::Polyhedron MakeBlindHole() {
  return MakeTower({{0.05, 0}, {0.05, 0.06}, {0.01, 0.06}, {0.01, 0.02}});
}

/// Return a box without a lid, 10 × 10 × 6 cm, with walls of 0.2 mm and a floor of 1 cm.
object::Polyhedron MakeThinBox() {
  return MakeTower({{0.05, 0}, {0.05, 0.06}, {0.0498, 0.06}, {0.0498, 0.01}});
}

TEST(NonconvexContacts, FingersPressInABlindHole) {
  const object::Polyhedron body = MakeBlindHole();
  TouchCount count = Hold(body,
                          plan::FingersInOrder({ContactAt(body, {0.001, 0.002, 0.02}, {0, 0, -1}),
                                                ContactAt(body, {0.002, 0.001, 0}, {0, 0, 1}),
                                                ContactAt(body, {0.01, 0.001, 0.04}, {1, 0, 0}),
                                                ContactAt(body, {0.05, 0.002, 0.039}, {-1, 0, 0})}),
                          30);
  ExpectTouchesItsOwn(count, 4);
  // Two fingers press outwards on opposite walls of the hole, one presses on its bottom.
  count = Hold(body,
               plan::FingersInOrder({ContactAt(body, {-0.01, 0, 0.04}, {-1, 0, 0}),
                                     ContactAt(body, {0.01, 0.001, 0.041}, {1, 0, 0}),
                                     ContactAt(body, {0.003, 0.003, 0.02}, {0, 0, -1}),
                                     ContactAt(body, {0.002, 0.004, 0}, {0, 0, 1})}),
               30);
  ExpectTouchesItsOwn(count, 4);
}

TEST(NonconvexContacts, FingersPinchThinWallsFromBothSides) {
  // The walls are thinner than the contact patches. Two pinch grasps alone let the object rotate
  // about the line between them.
  const object::Polyhedron body = MakeThinBox();
  const TouchCount count =
      Hold(body,
           plan::FingersInOrder({ContactAt(body, {0.05, 0.02, 0.04}, {-1, 0, 0}),
                                 ContactAt(body, {0.0498, 0.02, 0.04}, {1, 0, 0}),
                                 ContactAt(body, {-0.02, 0.05, 0.04}, {0, -1, 0}),
                                 ContactAt(body, {-0.02, 0.0498, 0.04}, {0, 1, 0}),
                                 ContactAt(body, {-0.02, -0.03, 0}, {0, 0, 1}),
                                 ContactAt(body, {-0.02, -0.03, 0.01}, {0, 0, -1})}),
           30);
  ExpectTouchesItsOwn(count, 6);
}

TEST(NonconvexContacts, FingersPressOutwardsInAChannel) {
  const object::ObjectFile file = ReadModel("u_channel.obj");
  const object::Object& body = *file.object;
  const TouchCount count =
      Hold(body,
           plan::FingersInOrder({ContactAt(body, {0.02, 0.05, 0.01}, {-1, 0, 0}),
                                 ContactAt(body, {0.08, 0.051, 0.009}, {1, 0, 0}),
                                 ContactAt(body, {0.05, 0.02, -0.01}, {0, -1, 0}),
                                 ContactAt(body, {0.049, 0, -0.011}, {0, 1, 0})}),
           30);
  ExpectTouchesItsOwn(count, 4);
}

TEST(NonconvexContacts, FingersTouchBothFacesOfAnInnerCornerDownToATenThousandth) {
  const object::ObjectFile file = ReadModel("l_block.obj");
  const object::Object& l = *file.object;
  int holds = 0;
  for (const double share : {1e-1, 1e-2, 1e-3, 1e-4}) {
    SCOPED_TRACE(share);
    const double d = share * l.diameter();
    const TouchCount count =
        Hold(l,
             plan::FingersInOrder({ContactAt(l, {0.04 + d, 0.04, 0.012}, {0, -1, 0}),
                                   ContactAt(l, {0.04 + d, 0, 0.012}, {0, 1, 0}),
                                   ContactAt(l, {0.04, 0.04 + d, -0.012}, {-1, 0, 0}),
                                   ContactAt(l, {0, 0.04 + d, -0.012}, {1, 0, 0})}),
             30);
    ExpectTouchesItsOwn(count, 4);
    ++holds;
  }
  EXPECT_EQ(holds, 4);
}

/// Return a block of 10 × 10 × 6 cm with a pit in its top, or a bump if `deeper` is negative. The
/// pit is as deep as wide.
object::Polyhedron MakePitted(double width, double deeper) {
  return MakeTower({{0.05, 0}, {0.05, 0.06}, {width / 2, 0.06}, {width / 2, 0.06 - deeper}});
}

TEST(NonconvexContacts, EveryFaceHasAPatchHoweverSmallItIs) {
  int faces = 0;
  for (const double width : {1e-1, 1e-3, 1e-5, 3e-6}) {
    for (const double sign : {1.0, -1.0}) {
      SCOPED_TRACE(sign * width);
      const double D = MakePitted(0.01, 0.01).diameter();
      const object::Polyhedron body = MakePitted(width * D, sign * std::min(width, 0.1) * D);
      for (FaceIndex face{0}; face < body.face_count(); ++face) {
        const Vector3d p = body.ClosestPoint(face, body.CentroidOf(face));
        const auto patches = MakeContactPatches(body, {face, p, p}, kPatchSize * D);
        ASSERT_FALSE(patches.empty());
        for (const ContactPatch& patch : patches) {
          ASSERT_GE(patch.outline.size(), 3u);
          for (const Vector3d& corner : patch.outline) {
            EXPECT_LT((body.ClosestPoint(face, corner) - corner).norm(), 1e-12);
          }
        }
        ++faces;
      }
    }
  }
  EXPECT_EQ(faces, 8 * 11);
}

TEST(NonconvexContacts, AFingerOnAFaceThatIsSmallerThanItsTipIsJudged) {
  for (const double deeper : {3e-6, -1e-5}) {
    SCOPED_TRACE(deeper);
    const double D = MakePitted(0.01, 0.01).diameter();
    const object::Polyhedron body = MakePitted(std::abs(deeper) * D, deeper * D);
    plan::Plan plan =
        MakePlan(plan::FingersInOrder({ContactAt(body, {0, 0, 0.06 - deeper * D}, {0, 0, -1}),
                                       ContactAt(body, {0, 0.002, 0}, {0, 0, 1}),
                                       ContactAt(body, {-0.05, 0, 0.03}, {1, 0, 0}),
                                       ContactAt(body, {0.05, 0.002, 0.029}, {-1, 0, 0})}),
                 30);
    for (const plan::FingerContact& held : plan.initial) ASSERT_GE(held.contact.face, 0);
    const ReplayResult result = ReplayPlan(body, plan, {});
    ASSERT_EQ(result.steps.size(), 1u);
    EXPECT_NE(result.steps[0].reason, plan::Reason::kSimulationUnstable) << result.steps[0].detail;
    // A fingertip whose support is narrower than the slip limit may fall into the pit, but not off
    // the bump.
    if (deeper < 0) {
      EXPECT_EQ(result.steps[0].reason, plan::Reason::kNone) << result.steps[0].detail;
    }
    plan.friction_angle = Radians(0.5);
    EXPECT_NE(ReplayPlan(body, plan, {}).steps.at(0).reason, plan::Reason::kNone);
  }
}

/// Draw a grasp of four that resists the disturbance, with clearance for each finger.
plan::FingerGrasp DrawGrasp(const object::Polyhedron& body, double friction_angle,
                            std::mt19937& random) {
  constexpr double kQuality = 0.015;  // the disturbance is 0.01
  constexpr int kMostDraws = 100'000;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    grasp::Grasp grasp;
    while (grasp.size() < 4) {
      const grasp::Contact contact = DrawContact(body, random);
      if (criteria::HasClearance(body, contact)) grasp.push_back(contact);
    }
    if (grasp::IsForceClosure(grasp, body.wrench_frame(), friction_angle) &&
        grasp::QualityAtLeast(grasp, body.wrench_frame(), friction_angle, kQuality)) {
      return plan::FingersInOrder(grasp);
    }
  }
  ADD_FAILURE() << "no grasp was drawn";
  return {};
}

/// Return true if a contact is in a hole, in a channel or next to a wall: a sphere as large as the
/// object does not fit there.
bool IsInside(const object::Object& object, const grasp::Contact& contact) {
  return criteria::ComputeClearance(object, contact, object.diameter()) < object.diameter();
}

TEST(NonconvexContacts, RandomGraspsTouchTheirOwnFacesAndNothingElse) {
  constexpr int kGrasps = 10;
  constexpr double kDegrees = 30;
  std::mt19937 random(17);
  int bodies = 0, inside = 0;
  const auto check = [&](const std::string& name, const object::Polyhedron& body) {
    SCOPED_TRACE(name);
    TouchCount count;
    for (int k = 0; k < kGrasps; ++k) {
      const plan::FingerGrasp grasp = DrawGrasp(body, Radians(kDegrees), random);
      const ReplayResult result = ReplayPlan(body, MakePlan(grasp, kDegrees), {});
      EXPECT_EQ(result.steps.at(0).reason, plan::Reason::kNone)
          << k << ": " << result.steps[0].detail;
      Count(body, grasp, result.steps[0].snapshot, Radians(kDegrees), count);
      inside += static_cast<int>(std::ranges::count_if(
          grasp, [&](const plan::FingerContact& held) { return IsInside(body, held.contact); }));
    }
    ExpectTouchesItsOwn(count, 4 * kGrasps);
    ++bodies;
  };
  for (const char* name :
       {"l_block.obj", "hole_block.obj", "u_channel.obj", "body36.obj", "mug500.obj"}) {
    const object::ObjectFile file = ReadModel(name);
    check(name, dynamic_cast<const object::Polyhedron&>(*file.object));
  }
  check("blind hole", MakeBlindHole());
  EXPECT_EQ(bodies, 6);
  EXPECT_GT(inside, 40);
}

TEST(NonconvexContacts, WrongContactsAreSeen) {
  const object::ObjectFile file = ReadModel("l_block.obj");
  const object::Object& l = *file.object;
  const plan::FingerGrasp grasp = plan::FingersInOrder(
      {ContactAt(l, {0.05, 0.04, 0.012}, {0, -1, 0}), ContactAt(l, {0.05, 0, 0.012}, {0, 1, 0}),
       ContactAt(l, {0.04, 0.05, -0.012}, {-1, 0, 0}), ContactAt(l, {0, 0.05, -0.012}, {1, 0, 0})});
  const ReplayResult result = ReplayPlan(l, MakePlan(grasp, 30), {});
  const plan::Snapshot& rest = result.steps.at(0).snapshot;
  const auto count = [&](const plan::FingerGrasp& planned, const plan::Snapshot& seen) {
    TouchCount found;
    Count(l, planned, seen, Radians(30), found);
    return found;
  };
  ExpectTouchesItsOwn(count(grasp, rest), 4);
  // Planned on the other wall of the corner.
  plan::FingerGrasp other = grasp;
  other[0].contact = ContactAt(l, {0.04, 0.05, 0.012}, {-1, 0, 0});
  EXPECT_EQ(count(other, rest).ghosts, 1);
  EXPECT_GT(count(other, rest).largest_error, kTouch);
  // A force from the side, like that of a non-existent wall.
  plan::Snapshot pushed = rest;
  for (plan::FingerState& state : pushed.fingers) {
    if (state.finger == 1) state.force_W = state.force_W.norm() * Vector3d::UnitX();
  }
  EXPECT_EQ(count(grasp, pushed).ghosts, 1);
  plan::Snapshot loose = rest;
  for (plan::FingerState& state : loose.fingers) {
    if (state.finger == 2) state.force_W.setZero();
  }
  EXPECT_EQ(count(grasp, loose).missed, 1);
}

}  // namespace nonconvex_contacts_test
}  // namespace regrasp::sim
