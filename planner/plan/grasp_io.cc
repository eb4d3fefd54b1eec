#include "planner/plan/grasp_io.h"

#include "planner/base/file.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/projection.h"

namespace regrasp::plan {

namespace {

/// Return the contact of a point without a normal, on its only face.
grasp::Contact ContactOfPoint(const JsonReader& json, const object::Object& object,
                              const Eigen::Vector3d& point) {
  const double tolerance = SurfaceTolerance(object);
  const std::vector<FaceIndex> faces = object.FacesNear(point, tolerance);
  if (faces.empty()) {
    json.Member("point").Fail(OffSurfaceText(object, point));
  }
  const FaceIndex face = faces.front();
  if (faces.size() > 1 || object.DistanceToBorder(face, point) <= tolerance) {
    json.Member("point").Fail("on a border of face " + std::to_string(face) +
                              ", requires a normal");
  }
  return {object.ClosestPoint(face, point), object.inward_normal(face), face};
}

grasp::Contact ReadOnObject(const JsonReader& json, const object::Object& object) {
  if (!json.Has("normal")) {
    return ContactOfPoint(json, object, json.Member("point").Vector(object.dimension()));
  }
  const ProjectedContact projected = ProjectContact(object, ReadContact(json, object.dimension()));
  if (projected.reason == Reason::kOffSurface) {
    json.Member("point").Fail(OffSurfaceText(object, projected.contact.p));
  }
  if (projected.reason != Reason::kNone) {
    const grasp::Contact nearest = NearestContact(object, projected.contact);
    json.Member("normal").Fail(projected.detail + ", expected " +
                               VectorText(nearest.n, object.dimension()));
  }
  return projected.contact;
}

}  // namespace

grasp::Grasp ParseGrasp(std::string_view text, const std::string& name,
                        const object::Object& object) {
  const Json json = ParseJson(text, name);
  const JsonReader root(json, name);
  root.ExpectFormat("regrasp-grasp");
  grasp::Grasp grasp;
  for (const JsonReader& element : root.Member("contacts").Elements()) {
    grasp.push_back(ReadOnObject(element, object));
  }
  if (grasp.empty()) root.Member("contacts").Fail("expected at least one contact");
  return grasp;
}

grasp::Grasp ReadGrasp(const std::filesystem::path& path, const object::Object& object) {
  return ParseGrasp(ReadFile(path), path.string(), object);
}

std::string FormatGrasp(const grasp::Grasp& grasp, int dimension) {
  Json json = Json::object();
  json["format"] = "regrasp-grasp";
  json["version"] = 1;
  json["contacts"] = GraspJson(grasp, dimension);
  return FormatJson(json);
}

namespace {

/// Number of contacts on filled surface, and the first one.
struct Found {
  int count = 0;
  std::string first;

  void Add(const object::Object& object, const FingerGrasp& grasp, const std::string& where) {
    for (const FingerContact& contact : grasp) {
      if (!contact.contact.face.valid() || !object.IsFilled(contact.contact.face)) continue;
      if (count++ == 0) first = "finger " + std::to_string(contact.finger) + " in " + where;
    }
  }
};

}  // namespace

std::string FilledContactsWarning(const object::Object& object, const Plan& projected) {
  Found found;
  found.Add(object, projected.initial, "the initial grasp");
  for (std::size_t i = 0; i < projected.steps.size(); ++i) {
    const std::string where = "step " + std::to_string(i + 1);
    if (const auto* step = std::get_if<Switch>(&projected.steps[i])) {
      found.Add(object, step->place, where);
    } else if (const auto* align = std::get_if<Align>(&projected.steps[i])) {
      found.Add(object, align->waypoints.back(), where);
    }
  }
  if (found.count == 0) return "";
  return std::to_string(found.count) + (found.count == 1 ? " contact is" : " contacts are") +
         " on filled surface (" + found.first + "), which may differ from the true surface";
}

}  // namespace regrasp::plan
