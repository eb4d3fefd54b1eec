#include "render/frames/step_scene.h"

#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>

#include "planner/base/number.h"
#include "planner/plan/projection.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {
namespace step_scene_test {

using Eigen::Vector3d;
using testing::ElementsAre;

plan::Plan HoldCube(const object::Polyhedron& cube, double scale) {
  plan::Plan plan;
  plan.dimension = 3;
  plan.scale = scale;
  plan.friction_angle = Radians(20);
  plan.initial = {{FingerIndex(0), {Vector3d(3, 0, 1), Vector3d(-1, 0, 0)}},
                  {FingerIndex(2), {Vector3d(-3, 0, 1), Vector3d(1, 0, 0)}}};
  return plan::ProjectPlan(cube, plan);
}

TEST(StepSceneTest, HasTheObjectAndEachFingerInMetresInTheObjectsFrame) {
  const object::Polyhedron cube = MakeCube(3, {1, 0, 0});  // centimetres
  plan::Plan plan = HoldCube(cube, 0.01);
  plan.initial[0].contact.p.x() += 1;
  plan.initial[1].contact.p.x() += 1;
  const std::vector<ScenePart> parts = MakeStepScene(cube, plan, plan::EntryIndex(0));
  std::vector<std::string> names;
  for (const ScenePart& part : parts) names.push_back(part.name);
  EXPECT_THAT(names,
              ElementsAre("object", "finger 0", "finger 0 cone", "finger 2", "finger 2 cone"));
  Eigen::AlignedBox3d box;
  for (const auto& corners : parts[0].mesh.triangles) {
    for (const Vector3d& p : corners) box.extend(p);
  }
  EXPECT_LT((box.min() - Vector3d(-0.02, -0.03, -0.03)).norm(), 1e-12);
  EXPECT_LT((box.max() - Vector3d(0.04, 0.03, 0.03)).norm(), 1e-12);
}

TEST(StepSceneTest, AGlbFileHasAllPartsForWhoeverReadsIt) {
  const object::Polyhedron cube = MakeCube(3);
  const std::vector<ScenePart> parts =
      MakeStepScene(cube, HoldCube(cube, 0.01), plan::EntryIndex(0));
  const std::string bytes = EncodeGlb("a scene", parts);
  EXPECT_EQ(bytes, EncodeGlb("a scene", parts));
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, parts.size());
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    EXPECT_EQ(scene->mMeshes[i]->mNumFaces, parts[i].mesh.triangles.size()) << parts[i].name;
  }
  // Triangles share their vertices: about two triangles per vertex of a round fingertip.
  EXPECT_LT(scene->mMeshes[1]->mNumVertices, parts[1].mesh.triangles.size());
  // The z axis becomes the y axis.
  const aiVector3D& p = scene->mMeshes[0]->mVertices[0];
  const Vector3d& q = parts[0].mesh.triangles[0][0];
  EXPECT_NEAR(p.y, q.z(), 1e-6);
  EXPECT_NEAR(p.z, -q.y(), 1e-6);
}

}  // namespace step_scene_test
}  // namespace regrasp::render
