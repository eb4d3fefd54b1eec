#include "render/frames/gltf.h"

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <cmath>
#include <memory>

#include "planner/base/error.h"

namespace regrasp::render {

namespace {

/// From z up to y up.
aiVector3D Turned(const Eigen::Vector3d& p) {
  return {static_cast<ai_real>(p.x()), static_cast<ai_real>(p.z()), static_cast<ai_real>(-p.y())};
}

aiMesh* MakeMesh(const ScenePart& part, unsigned material) {
  const auto triangles = static_cast<unsigned>(part.mesh.triangles.size());
  auto* mesh = new aiMesh;
  mesh->mName = part.name;
  mesh->mMaterialIndex = material;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = 3 * triangles;
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  mesh->mNormals = new aiVector3D[mesh->mNumVertices];
  mesh->mNumFaces = triangles;
  mesh->mFaces = new aiFace[triangles];
  for (unsigned t = 0; t < triangles; ++t) {
    aiFace& face = mesh->mFaces[t];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (unsigned i = 0; i < 3; ++i) {
      face.mIndices[i] = 3 * t + i;
      mesh->mVertices[3 * t + i] = Turned(part.mesh.triangles[t][i]);
      mesh->mNormals[3 * t + i] = Turned(part.mesh.normals[t][i]);
    }
  }
  return mesh;
}

/// glTF's colours are linear, ours sRGB.
float Linear(unsigned char channel) {
  const float value = static_cast<float>(channel) / 255;
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

aiMaterial* MakeMaterial(const ScenePart& part) {
  auto* material = new aiMaterial;
  const aiString name(part.name);
  material->AddProperty(&name, AI_MATKEY_NAME);
  const aiColor4D color(Linear(part.color.r), Linear(part.color.g), Linear(part.color.b),
                        static_cast<float>(part.opacity));
  material->AddProperty(&color, 1, AI_MATKEY_BASE_COLOR);
  const float metallic = 0, roughness = 0.8F;
  material->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  material->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  const aiString mode(part.opacity < 1 ? "BLEND" : "OPAQUE");
  material->AddProperty(&mode, AI_MATKEY_GLTF_ALPHAMODE);
  return material;
}

aiNode* MakeNode(const std::string& name, unsigned mesh) {
  auto* node = new aiNode(name);
  node->mNumMeshes = 1;
  node->mMeshes = new unsigned[1]{mesh};
  return node;
}

/// The scene owns, and deletes, all that it points to.
std::unique_ptr<aiScene> MakeScene(const std::string& name, const std::vector<ScenePart>& parts) {
  auto scene = std::make_unique<aiScene>();
  const auto count = static_cast<unsigned>(parts.size());
  scene->mMeshes = new aiMesh*[count]();
  scene->mMaterials = new aiMaterial*[count]();
  scene->mRootNode = new aiNode(name);
  scene->mRootNode->mChildren = new aiNode*[count]();
  for (unsigned i = 0; i < count; ++i) {
    scene->mMeshes[i] = MakeMesh(parts[i], i);
    scene->mMaterials[i] = MakeMaterial(parts[i]);
    scene->mRootNode->mChildren[i] = MakeNode(parts[i].name, i);
    scene->mRootNode->mChildren[i]->mParent = scene->mRootNode;
  }
  scene->mNumMeshes = scene->mNumMaterials = scene->mRootNode->mNumChildren = count;
  return scene;
}

}  // namespace

std::string EncodeGlb(const std::string& name, const std::vector<ScenePart>& parts) {
  const std::unique_ptr<aiScene> scene = MakeScene(name, parts);
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(scene.get(), "glb2");
  if (blob == nullptr) {
    throw EnvironmentError(std::string("glTF: assimp: ") + exporter.GetErrorString());
  }
  return {static_cast<const char*>(blob->data), blob->size};
}

}  // namespace regrasp::render
