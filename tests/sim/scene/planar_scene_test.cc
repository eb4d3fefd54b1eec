#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "planner/criteria/reach.h"
#include "sim/scene/contact_patches.h"
#include "tests/sim/mujoco_file.h"
#include "tests/sim/planar_cases.h"

namespace regrasp::sim {
namespace planar_scene_test {

plan::Plan FramePlan(const object::Polygon& frame) {
  return MakePlanarPlan({OnEdge(frame, 0, 4, 0.45), OnEdge(frame, 1, 6, 0.5)}, 15);
}

TEST(PlanarSceneMjcf, StockMujocoLoadsItAndItsKeyframeHoldsTheObject) {
  const object::Polygon frame = MakeFrame();
  const auto model = LoadFromFile(SceneMjcf(frame, FramePlan(frame), {}));
  ASSERT_NE(model, nullptr);
  ASSERT_EQ(model->nkey, 1);
  const DataPtr data(mj_makeData(model.get()));
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  constexpr int kSteps = 2000;
  const auto disturbance = [&](double force) {
    const int body = mj_name2id(model.get(), mjOBJ_BODY, "object");
    data->xfrc_applied[6 * body + 1] = force;  // across the fingers
    for (int i = 0; i < kSteps; ++i) mj_step(model.get(), data.get());
    return std::hypot(data->qpos[0], data->qpos[1]) + std::abs(data->qpos[2]) * frame.diameter();
  };
  const double weight = model->body_mass[1] * 9.81;
  EXPECT_LT(disturbance(weight), 1e-3 * frame.diameter());
  // Without the controls the object falls.
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  mju_zero(data->ctrl, model->nu);
  EXPECT_GT(disturbance(weight), 1e-2 * frame.diameter());
}

TEST(PlanarSceneMjcf, HasThePrismsMassItsJointsAndFingersAlongZ) {
  const object::Polygon frame = MakeFrame();
  ReplayOptions options;
  options.thickness = 0.012;
  const auto model = LoadFromFile(SceneMjcf(frame, FramePlan(frame), options));
  ASSERT_NE(model, nullptr);
  const int body = mj_name2id(model.get(), mjOBJ_BODY, "object");
  const double mass = 1000 * 0.0048 * 0.012;
  EXPECT_NEAR(model->body_mass[body], mass, 1e-12);
  ASSERT_EQ(model->body_jntnum[body], 3);
  EXPECT_EQ(model->jnt_type[0], mjJNT_SLIDE);
  EXPECT_EQ(model->jnt_type[1], mjJNT_SLIDE);
  EXPECT_EQ(model->jnt_type[2], mjJNT_HINGE);
  // A box of 80 mm without one of 40 mm: principal moments of both prisms about their centre.
  const auto moment = [](double m, double a, double b) { return m * (a * a + b * b) / 12; };
  const double outer = 1000 * 0.0064 * 0.012, inner = 1000 * 0.0016 * 0.012;
  std::array<double, 3> expected = {moment(outer, 0.08, 0.08) - moment(inner, 0.04, 0.04),
                                    moment(outer, 0.08, 0.012) - moment(inner, 0.04, 0.012), 0};
  expected[2] = expected[1];
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(model->body_inertia[3 * body + k], expected[k], 1e-9 * expected[0]);
  }
  for (const char* const name : {"finger0", "finger1", "finger2", "finger3"}) {
    const int geom = mj_name2id(model.get(), mjOBJ_GEOM, name);
    ASSERT_GE(geom, 0);
    EXPECT_EQ(model->geom_type[geom], mjGEOM_CAPSULE);
    EXPECT_EQ(model->geom_condim[geom], 3);
    EXPECT_EQ(model->body_jntnum[model->geom_bodyid[geom]], 2);
  }
  EXPECT_EQ(model->nu, 8);
  EXPECT_EQ(mju_norm3(model->opt.gravity), 0);
}

TEST(PlanarSceneMjcf, FingersDoNotCollideWithEachOther) {
  const object::Polygon frame = MakeFrame();
  const auto model = LoadFromFile(SceneMjcf(frame, FramePlan(frame), {}));
  ASSERT_NE(model, nullptr);
  int pairs = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) {
      const auto geom = [&](int f) {
        return mj_name2id(model.get(), mjOBJ_GEOM, ("finger" + std::to_string(f)).c_str());
      };
      EXPECT_EQ(model->geom_contype[geom(i)] & model->geom_conaffinity[geom(j)], 0);
      EXPECT_EQ(model->geom_contype[geom(j)] & model->geom_conaffinity[geom(i)], 0);
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, 6);
}

/// Return the lower and upper end of a patch along its edge, as shares of the edge.
std::pair<double, double> Ends(const object::Polygon& polygon, FaceIndex edge,
                               const ContactPatch& patch) {
  const auto [from, to] = polygon.edge(edge);
  const Eigen::Vector3d along = (to - from) / (to - from).squaredNorm();
  double low = 2, high = -2;
  for (const Eigen::Vector3d& corner : patch.outline) {
    low = std::min(low, along.dot(corner - from));
    high = std::max(high, along.dot(corner - from));
  }
  return {low, high};
}

TEST(EdgePatch, CoversThePathAndItsSurroundingsAndEndsWithTheEdge) {
  const object::Polygon square = MakeSquare(0.03);
  const auto ends = [&](double from, double to) {
    const ContactSite site{FaceIndex(1), OnEdge(square, 1, from).p, OnEdge(square, 1, to).p};
    const ContactPatch patch = MakeEdgePatch(square, site, 0.003, 0.02);
    EXPECT_TRUE(patch.rectangle);
    EXPECT_EQ(patch.outline.size(), 4u);
    const Eigen::Vector3d outward =
        (patch.outline[1] - patch.outline[0]).cross(patch.outline[2] - patch.outline[1]);
    EXPECT_LT((outward.normalized() + square.inward_normal(FaceIndex(1))).norm(), 1e-12);
    for (const Eigen::Vector3d& corner : patch.outline) {
      EXPECT_NEAR(std::abs(corner.z()), 0.01, 1e-15);
      EXPECT_NEAR(corner.x(), 0.03, 1e-15);
    }
    return Ends(square, FaceIndex(1), patch);
  };
  const auto expect = [](std::pair<double, double> found, double low, double high) {
    EXPECT_NEAR(found.first, low, 1e-12);
    EXPECT_NEAR(found.second, high, 1e-12);
  };
  expect(ends(0.5, 0.5), 0.45, 0.55);
  expect(ends(0.7, 0.4), 0.35, 0.75);
  expect(ends(0.01, 0.2), 0, 0.25);
  expect(ends(1, 1), 0.95, 1);
}

TEST(PlanarClearance, IsTheLargestDiscThatTouchesOnlyAtTheContact) {
  const object::Polygon l = MakeL(), frame = MakeFrame();
  // A disc in contact with both edges of a right angle touches each at the distance of its radius
  // from the corner.
  EXPECT_NEAR(criteria::ComputeClearance(l, OnEdge(l, 2, 0.9), 0.1), 0.004, 1e-12);
  EXPECT_NEAR(criteria::ComputeClearance(l, OnEdge(l, 3, 0.02), 0.1), 0.0008, 1e-12);
  // In the hole the opposite wall limits the clearance.
  EXPECT_NEAR(criteria::ComputeClearance(frame, OnEdge(frame, 4, 0.5), 0.1), 0.02, 1e-12);
  // Convex edges and ends do not limit it.
  EXPECT_EQ(criteria::ComputeClearance(l, OnEdge(l, 0, 0.5), 0.1), 0.1);
  EXPECT_EQ(criteria::ComputeClearance(l, OnEdge(l, 0, 1), 0.1), 0.1);
}

TEST(VisibleSurfaceTest, OfAPolygonIsItsClosedPrism) {
  const object::Polygon frame = MakeFrame();
  const VisibleSurface prism = MakeVisibleSurface(frame, 0.01);
  double volume = 0;
  Eigen::Vector3d flux = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : prism.triangles) {
    const Eigen::Vector3d &p = prism.vertices[a], &q = prism.vertices[b], &r = prism.vertices[c];
    volume += p.dot(q.cross(r)) / 6;
    flux += (q - p).cross(r - p);
  }
  EXPECT_NEAR(volume, 0.0048 * 0.01, 1e-15);
  EXPECT_LT(flux.norm(), 1e-15);
}

}  // namespace planar_scene_test
}  // namespace regrasp::sim
