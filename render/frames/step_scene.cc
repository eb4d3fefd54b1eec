#include "render/frames/step_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/base/number.h"
#include "planner/plan/snapshot.h"
#include "render/frames/finger_glyph.h"

namespace regrasp::render {

namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kLeastTurn = Radians(3);
constexpr double kStep = Radians(4);

// In diameters.
constexpr double kTurnRadius = 0.40;
constexpr double kAbove = 0.06;  ///< the object
constexpr double kLineRadius = 0.011;
/// The arrow's head, of that of forces.
constexpr double kHead = 2;

/// How far a body goes along a direction from its origin.
double Height(const FacetMesh& surface, const Isometry3d& pose, const Vector3d& along) {
  const Vector3d in_body = pose.linear().transpose() * along;
  double height = 0;
  for (const auto& corners : surface.triangles) {
    for (const Vector3d& p : corners) height = std::max(height, p.dot(in_body));
  }
  return height;
}

}  // namespace

std::vector<Vector3d> TurnArrow(const FacetMesh& surface, const Isometry3d& before,
                                const Isometry3d& after, const Vector3d& to_eye) {
  const AngleAxisd turn(after.linear() * before.linear().transpose());
  if (turn.angle() < kLeastTurn) return {};
  // Seen from the end of the axis that is nearer to the eye, or else from above.
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

void AddTurnArrow(const std::vector<Vector3d>& arrow, int arrow_head, Color color,
                  std::vector<Shape>& shapes) {
  const Vector3d& tip = arrow.back();
  const double head = kHead * kArrowHeadLength;
  // The head lies along the chord that is as long as it.
  auto base = arrow.end() - 1;
  while (base != arrow.begin() && (*base - tip).norm() < 0.9 * head) --base;
  for (auto at = arrow.begin(); at != base; ++at) {
    shapes.push_back({Line{*at, *(at + 1), kLineRadius}, color});
  }
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() =
      kHead * Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), *base - tip).toRotationMatrix();
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
