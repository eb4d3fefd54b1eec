#include "render/frames/step_scene.h"

#include <string>

#include "planner/plan/planned_snapshot.h"
#include "render/frames/finger_glyph.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

constexpr double kGlass = 0.45;  ///< opacity of the object

/// The meshes that shapes of fingers name.
enum Mesh { kConeMesh, kArrowMesh };

FacetMesh Moved(FacetMesh mesh, const Eigen::Isometry3d& pose) {
  for (auto& corners : mesh.triangles) {
    for (Vector3d& p : corners) p = pose * p;
  }
  for (auto& normals : mesh.normals) {
    for (Vector3d& n : normals) n = pose.linear() * n;
  }
  return mesh;
}

FacetMesh Scaled(FacetMesh mesh, double scale, const Vector3d& offset) {
  for (auto& corners : mesh.triangles) {
    for (Vector3d& p : corners) p = scale * p + offset;
  }
  return mesh;
}

struct MeshOfForm {
  const std::vector<FacetMesh>& meshes;

  FacetMesh operator()(const Ball& ball) const {
    return MakeCapsule(ball.centre, ball.centre, ball.radius);
  }
  FacetMesh operator()(const Rod& rod) const { return MakeCapsule(rod.from, rod.to, rod.radius); }
  FacetMesh operator()(const Line& line) const {
    return MakeCapsule(line.from, line.to, line.radius);
  }
  FacetMesh operator()(const MeshInstance& instance) const {
    return Moved(meshes[instance.mesh], instance.pose);
  }
};

void AddTo(FacetMesh& all, const FacetMesh& mesh) {
  all.triangles.insert(all.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
}

/// What is opaque of a finger is one part; what is not, its cone or its ghost, another.
void AddFinger(const FingerGlyph& glyph, const std::vector<FacetMesh>& meshes,
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

std::vector<ScenePart> MakeStepScene(const object::Object& object, const plan::Plan& located,
                                     plan::EntryIndex entry, const BodyOptions& options) {
  const BodyShape body = MakeBodyShape(object, options);
  const PictureFrame frame = {located.scale * object.diameter(),
                              located.scale * object.mass_properties().centroid};
  const std::vector<FacetMesh> meshes = {MakeCone(located.half_angle, kConeLength),
                                         MakeCone(kArrowHeadHalfAngle, kArrowHeadLength)};
  std::vector<ScenePart> parts = {{"object", body.surface, kBodyOutside, kGlass}};
  const plan::Snapshot snapshot = plan::MakePlannedSnapshot(located, entry, {}, 0);
  for (const FingerGlyph& glyph : MakeFingerGlyphs(snapshot, frame, body.rays)) {
    AddFinger(glyph, meshes, parts);
  }
  for (ScenePart& part : parts) {
    part.mesh = Scaled(std::move(part.mesh), frame.diameter_m, frame.centroid_m);
  }
  return parts;
}

}  // namespace regrasp::render
