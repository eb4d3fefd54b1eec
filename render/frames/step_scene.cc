#include "render/frames/step_scene.h"

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

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

/// Return a transformation in coordinates with y up.
aiMatrix4x4 Turned(const Eigen::Affine3d& pose) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Zero();
  turn(0, 0) = turn(1, 2) = turn(3, 3) = 1;
  turn(2, 1) = -1;
  const Eigen::Matrix4f m = (turn * pose.matrix() * turn.transpose()).cast<float>();
  return {m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3),
          m(2, 0), m(2, 1), m(2, 2), m(2, 3), m(3, 0), m(3, 1), m(3, 2), m(3, 3)};
}

void AddChildren(const std::vector<aiNode*>& children, aiNode& parent) {
  parent.mNumChildren = static_cast<unsigned>(children.size());
  parent.mChildren = new aiNode*[children.size()];
  std::ranges::copy(children, parent.mChildren);
  for (aiNode* child : children) child->mParent = &parent;
}

/// Return the node of a part.
aiNode* NodeOf(const ScenePart& part, unsigned mesh) {
  std::vector<aiNode*> copies;
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    const bool single = part.poses.size() == 1;
    copies.push_back(MakeNode(single ? part.name : part.name + " " + std::to_string(i), mesh));
    copies.back()->mTransformation = Turned(part.poses[i]);
  }
  if (copies.size() == 1) return copies.front();
  auto* node = new aiNode(part.name);
  AddChildren(copies, *node);
  return node;
}

/// Return a scene that owns everything it points to.
std::unique_ptr<aiScene> MakeScene(const std::string& name, const std::vector<ScenePart>& parts) {
  auto scene = std::make_unique<aiScene>();
  const auto count = static_cast<unsigned>(parts.size());
  scene->mMeshes = new aiMesh*[count]();
  scene->mMaterials = new aiMaterial*[count]();
  scene->mRootNode = new aiNode(name);
  std::vector<aiNode*> nodes;
  for (unsigned i = 0; i < count; ++i) {
    scene->mMeshes[i] = MakeMesh(parts[i], i);
    scene->mMaterials[i] = MakeMaterial(parts[i]);
    nodes.push_back(NodeOf(parts[i], i));
  }
  AddChildren(nodes, *scene->mRootNode);
  scene->mNumMeshes = scene->mNumMaterials = count;
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
/// A shorter arc has no room for a shaft behind its head.
constexpr double kShortestArc = Radians(30);
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
  const double arc = std::max(turn.angle(), kShortestArc);
  const int steps = static_cast<int>(std::ceil(arc / kStep));
  for (int i = 0; i <= steps; ++i) {
    const double angle = arc * (static_cast<double>(i) / steps - 0.5);
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

ShadedMesh Scaled(ShadedMesh mesh, double scale, const Vector3d& offset) {
  for (auto& corners : mesh.triangles) {
    for (Vector3d& p : corners) p = scale * p + offset;
  }
  return mesh;
}

/// The forms that markers consist of, as meshes of unit size.
enum class UnitForm { kSphere, kCylinder, kCone, kArrowHead };

/// Return an open cylinder of radius 1 from the origin to (0, 0, 1).
ShadedMesh MakeCylinder() {
  constexpr int kSides = 32;
  const auto across = [](int i) {
    const double turn = 2 * std::numbers::pi * i / kSides;
    return Vector3d(std::cos(turn), std::sin(turn), 0);
  };
  ShadedMesh cylinder;
  for (int i = 0; i < kSides; ++i) {
    const Vector3d a = across(i), b = across(i + 1), up = Vector3d::UnitZ();
    cylinder.Add({a, b, b + up}, {a, b, b});
    cylinder.Add({a, b + up, a + up}, {a, b, a});
  }
  return cylinder;
}

/// A unit form at a pose.
struct PlacedForm {
  UnitForm form;
  Eigen::Affine3d pose;
};

/// Splits shapes into unit forms.
struct FormsOf {
  std::vector<PlacedForm>& placed;

  void operator()(const Sphere& sphere) const {
    placed.push_back(
        {UnitForm::kSphere, Eigen::Translation3d(sphere.centre) * Eigen::Scaling(sphere.radius)});
  }
  void operator()(const Capsule& capsule) const { AddCapsule(capsule); }
  void operator()(const Line& line) const { AddCapsule(line); }
  void operator()(const MeshInstance& instance) const {
    placed.push_back({instance.mesh == kConeMesh ? UnitForm::kCone : UnitForm::kArrowHead,
                      Eigen::Affine3d(instance.pose)});
  }
  template <class Form>
  void AddCapsule(const Form& form) const {
    for (const Vector3d& end : {form.from, form.to}) (*this)(Sphere{end, form.radius});
    const Vector3d along = form.to - form.from;
    if (along.norm() == 0) return;
    placed.push_back(
        {UnitForm::kCylinder, Eigen::Translation3d(form.from) *
                                  object::AligningRotation(Vector3d::UnitZ(), along) *
                                  Eigen::Scaling(form.radius, form.radius, along.norm())});
  }
};

/// Add a finger: one part per unit form, opaque or translucent.
void AddFinger(const FingerGlyph& glyph, const std::map<UnitForm, ShadedMesh>& meshes,
               std::vector<ScenePart>& parts) {
  static const std::map<UnitForm, std::string> kNames = {{UnitForm::kSphere, "sphere"},
                                                         {UnitForm::kCylinder, "cylinder"},
                                                         {UnitForm::kCone, "cone"},
                                                         {UnitForm::kArrowHead, "arrow head"}};
  std::vector<Shape> shapes;
  AddFingerShapes(glyph, /*largest_force=*/0, {kConeMesh, kArrowMesh}, shapes);
  std::map<std::pair<bool, UnitForm>, ScenePart> by_form;
  for (const Shape& shape : shapes) {
    std::vector<PlacedForm> placed;
    std::visit(FormsOf{placed}, shape.form);
    for (const auto& [form, pose] : placed) {
      const bool pale = shape.opacity < 1;
      ScenePart& part = by_form[{pale, form}];
      if (part.name.empty()) {
        part = {"finger " + std::to_string(glyph.finger) + " " + kNames.at(form),
                meshes.at(form),
                FingerColor(glyph.finger),
                shape.opacity,
                {}};
        if (pale && form != UnitForm::kCone) part.name += " ghost";
      }
      part.poses.push_back(pose);
    }
  }
  for (auto& [form, part] : by_form) parts.push_back(std::move(part));
}

}  // namespace

std::vector<ScenePart> MakeStepScene(const object::Object& object, const plan::Plan& projected,
                                     plan::EntryIndex entry, const BodyOptions& options) {
  const BodyShape body = MakeBodyShape(object, options);
  const NormalizedFrame frame = {projected.scale * object.diameter(),
                                 projected.scale * object.mass_properties().centroid};
  const std::map<UnitForm, ShadedMesh> meshes = {
      {UnitForm::kSphere, MakeCapsule(Vector3d::Zero(), Vector3d::Zero(), 1)},
      {UnitForm::kCylinder, MakeCylinder()},
      {UnitForm::kCone, MakeCone(projected.friction_angle, kConeLength)},
      {UnitForm::kArrowHead, MakeCone(kArrowHeadHalfAngle, kArrowHeadLength)}};
  std::vector<ScenePart> parts = {{"object", body.surface, kBodyOutside, kGlass}};
  const plan::Snapshot snapshot = plan::MakePlannedSnapshot(projected, entry, {}, 0);
  for (const FingerGlyph& glyph : MakeFingerGlyphs(snapshot, frame, body.rays)) {
    AddFinger(glyph, meshes, parts);
  }
  parts[0].mesh = Scaled(std::move(parts[0].mesh), frame.diameter_m, frame.centroid_m);
  const Eigen::Affine3d to_metres =
      Eigen::Translation3d(frame.centroid_m) * Eigen::Scaling(frame.diameter_m);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    for (Eigen::Affine3d& pose : parts[i].poses) pose = to_metres * pose;
  }
  return parts;
}

}  // namespace regrasp::render
