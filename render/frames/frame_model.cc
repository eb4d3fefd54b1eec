#include "render/frames/frame_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "render/frames/object_tint.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Split a surface into one mesh per colour.
std::vector<ShadedMesh> MakeClusterMeshes(const ShadedMesh& surface,
                                          const roadmap::ClusterView& clusters) {
  std::vector<ShadedMesh> meshes(roadmap::kClusterColors);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    ShadedMesh& mesh = meshes[clusters.color_of_triangle[i]];
    mesh.triangles.push_back(surface.triangles[i]);
    mesh.normals.push_back(surface.normals[i]);
  }
  return meshes;
}

std::vector<ShadedMesh> MakeMeshes(const BodyShape& body, bool planar, double friction_angle,
                                   const std::optional<roadmap::ClusterView>& clusters) {
  std::vector<ShadedMesh> meshes = {
      body.surface, TurnInsideOut(body.surface), body.shell,
      planar ? MakeWedge(friction_angle, kConeLength) : MakeCone(friction_angle, kConeLength),
      MakeCone(kArrowHeadHalfAngle, kArrowHeadLength)};
  if (clusters) {
    for (ShadedMesh& mesh : MakeClusterMeshes(body.surface, *clusters)) {
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

/// Rotate flat friction cones about their axes into the plane.
void LayFlat(std::vector<Shape>& shapes) {
  for (Shape& shape : shapes) {
    auto* mesh = std::get_if<MeshInstance>(&shape.form);
    if (mesh == nullptr || mesh->mesh != kConeMesh) continue;
    const Vector3d axis = mesh->pose.linear().col(2);
    mesh->pose.linear() << Vector3d::UnitZ().cross(axis), Vector3d::UnitZ(), axis;
  }
}

double LargestForce(const std::vector<plan::Snapshot>& snapshots) {
  double largest = 0;
  for (const plan::Snapshot& snapshot : snapshots) {
    for (const plan::FingerState& finger : snapshot.fingers) {
      if (finger.role != plan::FingerRole::kReleased) {
        largest = std::max(largest, finger.force_W.norm());
      }
    }
  }
  return largest;
}

}  // namespace

FrameModel::FrameModel(const object::Object& object, double scale, double friction_angle,
                       const std::vector<plan::Snapshot>& snapshots, const FrameOptions& options)
    : options(options),
      object(object),
      scale(scale),
      friction_angle(friction_angle),
      body(MakeBodyShape(object, options.body)),
      frame{scale * object.diameter(), scale * object.mass_properties().centroid},
      planar(object.dimension() == 2),
      hand(options.hand ? std::make_shared<const HandFigure>(*options.hand, frame) : nullptr),
      meshes(MakeMeshes(body, planar, friction_angle, options.clusters)),
      largest_force(LargestForce(snapshots)) {
  if (hand && opaque()) TintByDirection(meshes[kOutsideMesh]);
}

std::optional<double> FrameModel::FingerRadius() const {
  if (!options.finger_radius) return std::nullopt;
  return *options.finger_radius / object.diameter();
}

std::vector<FingerGlyph> FrameModel::GlyphsOf(const plan::Snapshot& snapshot,
                                              bool free_fingers) const {
  return MakeFingerGlyphs(snapshot, frame, body.rays, {free_fingers, FingerRadius()});
}

std::vector<Shape> FrameModel::FingerShapes(const std::vector<FingerGlyph>& fingers) const {
  std::vector<Shape> shapes;
  for (const FingerGlyph& glyph : fingers) {
    AddFingerShapes(glyph, largest_force, {kConeMesh, kArrowMesh}, shapes);
  }
  if (planar) LayFlat(shapes);
  return shapes;
}

std::vector<ShadedMesh> FrameModel::CanvasMeshes(
    double link_detail, std::span<const std::vector<Vector3d>> eyes) const {
  std::vector<ShadedMesh> all = meshes;
  if (!options.hand) return all;
  for (ShadedMesh& mesh : MakeHandMeshes(*options.hand, frame, link_detail, eyes)) {
    all.push_back(std::move(mesh));
  }
  return all;
}

}  // namespace regrasp::render
