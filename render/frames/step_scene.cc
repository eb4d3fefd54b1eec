#include "render/frames/step_scene.h"

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/rotation.h"
#include "planner/plan/projection.h"
#include "render/frames/finger_glyph.h"

namespace regrasp::render {

namespace {

/// Convert coordinates with z up to coordinates with y up.
aiVector3D Turned(const Eigen::Vector3d& p) {
  return {static_cast<ai_real>(p.x()), static_cast<ai_real>(p.z()), static_cast<ai_real>(-p.y())};
}

aiMesh* MakeMesh(const ScenePart& part, unsigned material) {
  const auto triangles = static_cast<unsigned>(part.mesh.triangles.size());
  auto* mesh = new aiMesh;
  mesh->mName = part.name;
  mesh->mMaterialIndex = material;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumFaces = triangles;
  mesh->mFaces = new aiFace[triangles];
  // Triangles share vertices with equal positions and normals.
  std::vector<aiVector3D> points, normals;
  std::map<std::array<float, 6>, unsigned> indices;
  for (unsigned t = 0; t < triangles; ++t) {
    aiFace& face = mesh->mFaces[t];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (unsigned i = 0; i < 3; ++i) {
      const aiVector3D p = Turned(part.mesh.triangles[t][i]);
      const aiVector3D n = Turned(part.mesh.normals[t][i]);
      const auto [known, is_new] =
          indices.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z}, static_cast<unsigned>(points.size()));
      if (is_new) {
        points.push_back(p);
        normals.push_back(n);
      }
      face.mIndices[i] = known->second;
    }
  }
  mesh->mNumVertices = static_cast<unsigned>(points.size());
  mesh->mVertices = new aiVector3D[points.size()];
  mesh->mNormals = new aiVector3D[points.size()];
  std::ranges::copy(points, mesh->mVertices);
  std::ranges::copy(normals, mesh->mNormals);
  return mesh;
}

/// Convert an sRGB channel to the linear colours of glTF.
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

/// Return a scene that owns everything it points to.
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

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kLeastTurn = Radians(3);
constexpr double kStep = Radians(4);

// Lengths in diameters.
constexpr double kTurnRadius = 0.40;
constexpr double kAbove = 0.06;  ///< distance from the object
constexpr double kLineRadius = 0.011;
/// Size of the arrow head relative to the head of force arrows.
constexpr double kHead = 2;

/// Return the extent of an object from its origin along a direction.
double Height(const ShadedMesh& surface, const Isometry3d& pose, const Vector3d& along) {
  const Vector3d in_body = pose.linear().transpose() * along;
  double height = 0;
  for (const auto& corners : surface.triangles) {
    for (const Vector3d& p : corners) height = std::max(height, p.dot(in_body));
  }
  return height;
}

}  // namespace

std::vector<Vector3d> RotationArrow(const ShadedMesh& surface, const Isometry3d& before,
                                    const Isometry3d& after, const Vector3d& to_eye) {
  const AngleAxisd turn = object::RotationInWorld(before.linear(), after.linear());
  if (turn.angle() < kLeastTurn) return {};
  // Seen from the end of the axis that is nearer to the eye, with a preference for the top.
  const bool turned_away = turn.axis().dot(to_eye + Vector3d::UnitZ() / 2) < 0;
  const Vector3d out = turned_away ? Vector3d(-turn.axis()) : turn.axis();
  const double height = std::max(Height(surface, before, out) + before.translation().dot(out),
                                 Height(surface, after, out) + after.translation().dot(out));
  Vector3d centre = (before.translation() + after.translation()) / 2;
  centre += (height + kAbove - centre.dot(out)) * out;
  Vector3d middle = to_eye - to_eye.dot(out) * out;
  middle = middle.norm() < kTurnRadius ? out.unitOrthogonal() : middle.normalized();
  std::vector<Vector3d> arrow;
  const int steps = std::max(2, static_cast<int>(std::ceil(turn.angle() / kStep)));
  for (int i = 0; i <= steps; ++i) {
    const double angle = turn.angle() * (static_cast<double>(i) / steps - 0.5);
    arrow.emplace_back(centre + kTurnRadius * (AngleAxisd(angle, turn.axis()) * middle));
  }
  return arrow;
}

void AddRotationArrow(const std::vector<Vector3d>& arrow, int arrow_head, Color color,
                      std::vector<Shape>& shapes) {
  const Vector3d& tip = arrow.back();
  const double head = kHead * kArrowHeadLength;
  // The head is aligned with the chord of its length.
  auto base = arrow.end() - 1;
  while (base != arrow.begin() && (*base - tip).norm() < 0.9 * head) --base;
  for (auto at = arrow.begin(); at != base; ++at) {
    shapes.push_back({Line{*at, *(at + 1), kLineRadius}, color});
  }
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() =
      kHead * object::AligningRotation(Vector3d::UnitZ(), *base - tip).toRotationMatrix();
  pose.translation() = tip;
  shapes.push_back({MeshInstance{arrow_head, pose}, color});
}

std::vector<Obstacle> ObstaclesOf(const Camera& camera, const std::vector<Vector3d>& arrow) {
  std::vector<Obstacle> covered;
  for (std::size_t i = 0; i + 1 < arrow.size(); ++i) {
    covered.push_back({camera.Project(arrow[i]), camera.Project(arrow[i + 1]),
                       kLineRadius * camera.PixelsPerUnit(arrow[i])});
  }
  return covered;
}

namespace {

constexpr double kGlass = 0.45;  ///< opacity of the object

/// Meshes that the shapes of fingers refer to.
enum Mesh { kConeMesh, kArrowMesh };

ShadedMesh Moved(ShadedMesh mesh, const Eigen::Isometry3d& pose) {
  for (auto& corners : mesh.triangles) {
    for (Vector3d& p : corners) p = pose * p;
  }
  for (auto& normals : mesh.normals) {
    for (Vector3d& n : normals) n = pose.linear() * n;
  }
  return mesh;
}

ShadedMesh Scaled(ShadedMesh mesh, double scale, const Vector3d& offset) {
  for (auto& corners : mesh.triangles) {
    for (Vector3d& p : corners) p = scale * p + offset;
  }
  return mesh;
}

struct MeshOfForm {
  const std::vector<ShadedMesh>& meshes;

  ShadedMesh operator()(const Sphere& sphere) const {
    return MakeCapsule(sphere.centre, sphere.centre, sphere.radius);
  }
  ShadedMesh operator()(const Capsule& capsule) const {
    return MakeCapsule(capsule.from, capsule.to, capsule.radius);
  }
  ShadedMesh operator()(const Line& line) const {
    return MakeCapsule(line.from, line.to, line.radius);
  }
  ShadedMesh operator()(const MeshInstance& instance) const {
    return Moved(meshes[instance.mesh], instance.pose);
  }
};

void AddTo(ShadedMesh& all, const ShadedMesh& mesh) {
  all.triangles.insert(all.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
}

/// Add a finger as one opaque part and one translucent part (cone or ghost).
void AddFinger(const FingerGlyph& glyph, const std::vector<ShadedMesh>& meshes,
               std::vector<ScenePart>& parts) {
  std::vector<Shape> shapes;
  AddFingerShapes(glyph, /*largest_force=*/0, {kConeMesh, kArrowMesh}, shapes);
  const std::string name = "finger " + std::to_string(glyph.finger);
  ScenePart solid = {name, {}, FingerColor(glyph.finger), 1};
  ScenePart pale = {name + " cone", {}, FingerColor(glyph.finger), 1};
  for (const Shape& shape : shapes) {
    ScenePart& part = shape.opacity < 1 ? pale : solid;
    AddTo(part.mesh, std::visit(MeshOfForm{meshes}, shape.form));
    part.opacity = shape.opacity;
  }
  for (ScenePart& part : std::vector{solid, pale}) {
    if (!part.mesh.triangles.empty()) parts.push_back(std::move(part));
  }
}

}  // namespace

std::vector<ScenePart> MakeStepScene(const object::Object& object, const plan::Plan& projected,
                                     plan::EntryIndex entry, const BodyOptions& options) {
  const BodyShape body = MakeBodyShape(object, options);
  const NormalizedFrame frame = {projected.scale * object.diameter(),
                                 projected.scale * object.mass_properties().centroid};
  const std::vector<ShadedMesh> meshes = {MakeCone(projected.friction_angle, kConeLength),
                                          MakeCone(kArrowHeadHalfAngle, kArrowHeadLength)};
  std::vector<ScenePart> parts = {{"object", body.surface, kBodyOutside, kGlass}};
  const plan::Snapshot snapshot = plan::MakePlannedSnapshot(projected, entry, {}, 0);
  for (const FingerGlyph& glyph : MakeFingerGlyphs(snapshot, frame, body.rays)) {
    AddFinger(glyph, meshes, parts);
  }
  for (ScenePart& part : parts) {
    part.mesh = Scaled(std::move(part.mesh), frame.diameter_m, frame.centroid_m);
  }
  return parts;
}

}  // namespace regrasp::render
