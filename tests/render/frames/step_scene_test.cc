#include "render/frames/step_scene.h"

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <string>
#include <vector>

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
  EXPECT_THAT(names, ElementsAre("object", "finger 0 sphere", "finger 0 cylinder", "finger 0 cone",
                                 "finger 2 sphere", "finger 2 cylinder", "finger 2 cone"));
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
    aiString mode;
    scene->mMaterials[scene->mMeshes[i]->mMaterialIndex]->Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
    EXPECT_STREQ(mode.C_Str(), parts[i].opacity < 1 ? "BLEND" : "OPAQUE") << parts[i].name;
  }
  EXPECT_LT(parts[0].opacity, 1) << "the object";
  // Triangles share their vertices: about two triangles per vertex of a round fingertip.
  EXPECT_LT(scene->mMeshes[1]->mNumVertices, parts[1].mesh.triangles.size());
  // The z axis becomes the y axis.
  const aiVector3D& p = scene->mMeshes[0]->mVertices[0];
  const Vector3d& q = parts[0].mesh.triangles[0][0];
  EXPECT_NEAR(p.y, q.z(), 1e-6);
  EXPECT_NEAR(p.z, -q.y(), 1e-6);
}

/// A node with a mesh, and its transformation to the scene.
struct PlacedMesh {
  std::string name;
  unsigned mesh;
  aiMatrix4x4 pose;
};

void Collect(const aiNode& node, const aiMatrix4x4& parent, std::vector<PlacedMesh>& all) {
  const aiMatrix4x4 pose = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    all.push_back({node.mName.C_Str(), node.mMeshes[i], pose});
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) Collect(*node.mChildren[i], pose, all);
}

TEST(StepSceneTest, CopiesOfAMarkerShareOneMeshAtTheirPoses) {
  const object::Polyhedron cube = MakeCube(3);
  plan::Plan plan = HoldCube(cube, 0.01);
  plan::Align slide;
  slide.waypoints = {plan.initial, plan.initial};
  slide.waypoints[1][0].contact.p.z() = -2;
  plan.steps = {slide};
  const std::vector<ScenePart> parts =
      MakeStepScene(cube, plan::ProjectPlan(cube, plan), plan::EntryIndex(1));
  const std::string bytes = EncodeGlb("a scene", parts);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  std::vector<PlacedMesh> nodes;
  Collect(*scene->mRootNode, aiMatrix4x4(), nodes);
  std::size_t copies = 0, triangles = 0, drawn = 0;
  for (const ScenePart& part : parts) {
    copies += part.poses.size();
    triangles += part.mesh.triangles.size();
    drawn += part.poses.size() * part.mesh.triangles.size();
  }
  ASSERT_EQ(nodes.size(), copies);
  EXPECT_GT(drawn, 4 * triangles) << "the dashes of a track share their meshes";
  std::size_t node = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const Eigen::Affine3d& pose : parts[i].poses) {
      ASSERT_EQ(nodes[node].mesh, i) << nodes[node].name;
      const Vector3d p = pose * parts[i].mesh.triangles[5][1];
      double nearest = 1;
      const aiMesh& mesh = *scene->mMeshes[i];
      for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
        const aiVector3D q = nodes[node].pose * mesh.mVertices[k];
        nearest = std::min(nearest, (Vector3d(q.x, -q.z, q.y) - p).norm());
      }
      EXPECT_LT(nearest, 1e-6) << parts[i].name;
      ++node;
    }
  }
}

TEST(StepSceneTest, AFrictionConeHasItsApexAtTheContact) {
  const object::Polyhedron cube = MakeCube(3);
  const std::vector<ScenePart> parts =
      MakeStepScene(cube, HoldCube(cube, 0.01), plan::EntryIndex(0));
  const auto cone = std::ranges::find(parts, "finger 0 cone", &ScenePart::name);
  ASSERT_NE(cone, parts.end());
  ASSERT_EQ(cone->poses.size(), 1u);
  EXPECT_LT((cone->poses[0] * Vector3d::Zero() - Vector3d(0.03, 0, 0.01)).norm(), 1e-9);
  const Vector3d axis = cone->poses[0].linear() * Vector3d::UnitZ();
  EXPECT_LT((axis - cube.diameter() * 0.01 * Vector3d(-1, 0, 0)).norm(), 1e-9);
}

}  // namespace step_scene_test
}  // namespace regrasp::render
