// Fingers on faces that are much smaller than a fingertip.

#include "sim/scene/contact_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planner/grasp/quality.h"
#include "sim/scene/scaling.h"
#include "sim/scene/scene.h"
#include "tests/sim/mujoco_file.h"
#include "tests/sim/replay_cases.h"

namespace regrasp::sim {
namespace contact_patches_test {

using Eigen::Vector3d;

constexpr double kRadius = 0.05;  // m
constexpr double kDiameter = 2 * kRadius;
constexpr double kFrictionAngle = Radians(30);
constexpr double kQuality = 0.02;  // the disturbance is 0.01

/// Return a sphere with faces of width `finest` · D at its two poles on the x axis. The width grows
/// by half from ring to ring towards the equator.
object::Polyhedron MakeBall(double finest, int sectors) {
  std::vector<double> angles;
  for (double a = 2 * finest; a < std::numbers::pi / 2; a *= 1.5) angles.push_back(a);
  const std::size_t half = angles.size();
  for (std::size_t k = half; k-- > 0;) angles.push_back(std::numbers::pi - angles[k]);
  object::PolygonSoup soup{{{kRadius, 0, 0}, {-kRadius, 0, 0}}, {}};
  const auto at = [&](std::size_t ring, int sector) {
    return static_cast<int>(2 + ring * sectors + sector % sectors);
  };
  for (std::size_t ring = 0; ring < angles.size(); ++ring) {
    for (int s = 0; s < sectors; ++s) {
      const double turn = 2 * std::numbers::pi * s / sectors;
      soup.vertices.push_back(kRadius * Vector3d(std::cos(angles[ring]),
                                                 std::sin(angles[ring]) * std::cos(turn),
                                                 std::sin(angles[ring]) * std::sin(turn)));
      if (ring == 0) {
        soup.facets.push_back({0, at(0, s), at(0, s + 1)});
        continue;
      }
      soup.facets.push_back({at(ring - 1, s), at(ring, s), at(ring, s + 1)});
      soup.facets.push_back({at(ring - 1, s), at(ring, s + 1), at(ring - 1, s + 1)});
    }
  }
  for (int s = 0; s < sectors; ++s) {
    soup.facets.push_back({1, at(angles.size() - 1, s + 1), at(angles.size() - 1, s)});
  }
  return object::Polyhedron::FromSoup(soup, "ball");
}

/// Return the face whose centre is nearest to a point.
FaceIndex NearestFace(const object::Polyhedron& body, const Vector3d& near) {
  FaceIndex nearest{0};
  const auto distance = [&](FaceIndex face) { return (body.CentroidOf(face) - near).norm(); };
  for (FaceIndex face{1}; face < body.face_count(); ++face) {
    if (distance(face) < distance(nearest)) nearest = face;
  }
  return nearest;
}

/// Draw a contact uniformly over a triangle of the face, or over its part next to the first corner
/// that is `share` as wide.
grasp::Contact DrawOnFace(const object::Polyhedron& body, FaceIndex face, double share,
                          std::mt19937& random) {
  const auto& [a, b, c] = body.triangles()[body.TrianglesOf(face).front()];
  const auto& vertices = body.vertices();
  std::uniform_real_distribution<double> unit(0, 1);
  const double s = share * std::sqrt(unit(random)), v = unit(random);
  return {(1 - s) * vertices[a] + s * (1 - v) * vertices[b] + s * v * vertices[c],
          body.inward_normal(face), face};
}

/// Draw a good grasp of four with two fingers on the finest faces, within `share` of a corner.
plan::FingerGrasp DrawGrasp(const object::Polyhedron& ball, double share, std::mt19937& random) {
  for (;;) {
    plan::FingerGrasp grasp;
    for (const auto& [near, part] : {std::pair{Vector3d(1, 0, 0), share},
                                     {Vector3d(-1, 0, 0), share},
                                     {Vector3d(0.1, 1, 0.1), 1.0},
                                     {Vector3d(0, -1, 0), 1.0}}) {
      const FaceIndex face = NearestFace(ball, kRadius * near);
      grasp.push_back({FingerIndex(grasp.size()), DrawOnFace(ball, face, part, random)});
    }
    if (grasp::QualityAtLeast(plan::ContactsOf(grasp), ball.wrench_frame(), kFrictionAngle,
                              kQuality))
      return grasp;
  }
}

bool IsRectangle(const object::Polyhedron& body, const grasp::Contact& contact) {
  const auto patches =
      MakeContactPatches(body, {contact.face, contact.p, contact.p}, kPatchSize * kDiameter);
  return patches.size() == 1 && patches.front().rectangle;
}

/// Slip limit, over D. Fingers on large faces slip by 5e-9. Fingers whose contact points the engine
/// misplaces slip by 1e-6 and more.
constexpr double kNoSlip = 1e-7;

/// Replays of four grasps of a sphere, which must pass, with counts of their contact patches.
struct Holds {
  int rectangles = 0, others = 0;  ///< patches on the finest faces

  void Replay(double finest, int sectors, double share, std::mt19937& random) {
    SCOPED_TRACE(std::to_string(finest) + " " + std::to_string(sectors));
    const object::Polyhedron ball = MakeBall(finest, sectors);
    for (int k = 0; k < 4; ++k) {
      const plan::FingerGrasp grasp = DrawGrasp(ball, share, random);
      const StepReplay hold =
          ReplayPlan(ball, MakePlan(grasp, Degrees(kFrictionAngle)), {}).steps.at(0);
      EXPECT_EQ(hold.reason, plan::Reason::kNone) << hold.detail;
      EXPECT_LT(hold.slip_m, kNoSlip * kDiameter);
      for (int f = 0; f < 2; ++f) ++(IsRectangle(ball, grasp[f].contact) ? rectangles : others);
    }
  }
};

TEST(FineFacets, HoldAFingertipThatIsFarLargerThanTheyAre) {
  std::mt19937 random(3);
  Holds holds;
  for (const double finest : {1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 3e-5}) {
    for (const int sectors : {6, 60}) holds.Replay(finest, sectors, 1, random);
  }
  EXPECT_EQ(holds.rectangles + holds.others, 6 * 2 * 4 * 2);
}

TEST(FineFacets, HoldAFingertipInTheirSharpCorners) {
  std::mt19937 random(4);
  Holds holds;
  for (const double finest : {1e-2, 5e-3, 3e-3}) {
    for (const int sectors : {5, 6, 9}) holds.Replay(finest, sectors, 0.05, random);
  }
  EXPECT_GT(holds.others, 0);
}

/// Return the largest distance of the patches' corners from the corners of the engine's meshes,
/// over D; −1 without meshes.
double LargestMeshError(const Scene& scene, const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  double largest = -1;
  for (std::size_t site = 0; site < scene.sites.size(); ++site) {
    const ContactPatch& patch = scene.sites[site].patches.at(0);
    if (patch.rectangle) continue;
    const int geom = mj_name2id(&model, mjOBJ_GEOM, ("site" + std::to_string(site) + "_0").c_str());
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(data.geom_xmat +
                                                                              9 * geom);
    const Eigen::Map<const Vector3d> place(data.geom_xpos + 3 * geom);
    const int mesh = model.geom_dataid[geom];
    for (const Vector3d& corner : patch.outline) {
      double nearest = kDiameter;
      for (int v = 0; v < model.mesh_vertnum[mesh]; ++v) {
        const Eigen::Map<const Eigen::Vector3f> vertex(model.mesh_vert +
                                                       3 * (model.mesh_vertadr[mesh] + v));
        nearest = std::min(nearest, (place + turn * vertex.cast<double>() - corner).norm());
      }
      largest = std::max(largest, nearest / kDiameter);
    }
  }
  return largest;
}

TEST(FineFacets, AreWhereTheyAreAlthoughTheEngineKeepsMeshesInSinglePrecision) {
  std::mt19937 random(5);
  const object::Polyhedron ball = MakeBall(3e-3, 6);
  int meshes = 0;
  for (int k = 0; k < 20; ++k) {
    const plan::Plan plan = MakePlan(DrawGrasp(ball, 0.05, random), Degrees(kFrictionAngle));
    const Scene scene = MakeScene(ball, plan, 0, {});
    const ModelPtr model = LoadFromFile(FormatScene(scene, ball, {}, false));
    ASSERT_NE(model, nullptr);
    const DataPtr data(mj_makeData(model.get()));
    const double error = LargestMeshError(scene, *model, *data);
    if (error >= 0) ++meshes;
    // With corners relative to the object's centre the error would be 8e-9.
    EXPECT_LT(error, 2e-9);
  }
  EXPECT_GT(meshes, 5);
}

}  // namespace contact_patches_test
}  // namespace regrasp::sim
