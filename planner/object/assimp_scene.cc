#include "planner/object/assimp_scene.h"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <vector>

#include "planner/base/error.h"

namespace regrasp {

namespace {

/// Adds a mesh as one node places it. A node that mirrors turns facets inside out: turned back.
void AddMesh(const aiMesh& mesh, const aiMatrix4x4& placement, PolygonSoup& soup) {
  const std::size_t first = soup.vertices.size();
  for (unsigned int v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D p = placement * mesh.mVertices[v];
    soup.vertices.push_back({p.x, p.y, p.z});
  }
  const bool mirrors = aiMatrix3x3(placement).Determinant() < 0;
  for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices < 3) continue;  // a point or a line
    std::vector<int>& facet = soup.facets.emplace_back();
    for (unsigned int k = 0; k < face.mNumIndices; ++k) {
      const unsigned int index = face.mIndices[mirrors ? face.mNumIndices - 1 - k : k];
      if (index >= mesh.mNumVertices) {
        throw InputError("facet " + std::to_string(soup.facets.size() - 1) + ": vertex index " +
                         std::to_string(index) + " is out of range (" +
                         std::to_string(mesh.mNumVertices) + " vertices)");
      }
      facet.push_back(static_cast<int>(first + index));
    }
  }
}

}  // namespace

PolygonSoup ReadAssimpScene(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  constexpr unsigned int kNoPostProcessing = 0;
  const aiScene* scene = importer.ReadFile(path, kNoPostProcessing);
  if (scene == nullptr) throw InputError(importer.GetErrorString());
  PolygonSoup soup;
  struct Visit {
    const aiNode* node;
    aiMatrix4x4 placement;
  };
  std::vector<Visit> stack;
  if (scene->mRootNode != nullptr) stack.push_back({scene->mRootNode, aiMatrix4x4()});
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const aiMatrix4x4 placement = visit.placement * visit.node->mTransformation;
    for (unsigned int m = 0; m < visit.node->mNumMeshes; ++m) {
      if (visit.node->mMeshes[m] >= scene->mNumMeshes) throw InputError("a node without its mesh");
      AddMesh(*scene->mMeshes[visit.node->mMeshes[m]], placement, soup);
    }
    for (unsigned int c = visit.node->mNumChildren; c-- > 0;) {
      stack.push_back({visit.node->mChildren[c], placement});
    }
  }
  return soup;
}

}  // namespace regrasp
