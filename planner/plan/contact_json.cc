#include "planner/plan/contact_json.h"

#include <limits>

namespace regrasp::plan {

grasp::Contact ReadContact(const JsonReader& json, int dimension) {
  return {json.Member("point").Vector(dimension), json.Member("normal").Vector(dimension)};
}

FingerIndex ReadFinger(const JsonReader& json) {
  return FingerIndex(json.Integer(0, std::numeric_limits<int>::max()));
}

namespace {

std::optional<double> ReadRegion(const JsonReader& contact) {
  if (!contact.Has("region")) return std::nullopt;
  const JsonReader region = contact.Member("region");
  const double half_width = region.Number();
  if (half_width < 0) region.Fail("expected a number from 0, found " + region.Quoted());
  return half_width;
}

}  // namespace

FingerGrasp ReadFingerGrasp(const JsonReader& json, int dimension) {
  FingerGrasp grasp;
  for (const JsonReader& element : json.Elements()) {
    grasp.push_back({ReadFinger(element.Member("finger")), ReadContact(element, dimension),
                     ReadRegion(element)});
  }
  return grasp;
}

Json ContactJson(const grasp::Contact& contact, int dimension) {
  Json json = Json::object();
  json["point"] = VectorJson(contact.p, dimension);
  json["normal"] = VectorJson(contact.n, dimension);
  return json;
}

Json GraspJson(const grasp::Grasp& grasp, int dimension) {
  Json json = Json::array();
  for (const grasp::Contact& contact : grasp) json.push_back(ContactJson(contact, dimension));
  return json;
}

Json FingerGraspJson(const FingerGrasp& grasp, int dimension) {
  Json json = Json::array();
  for (const FingerContact& held : grasp) {
    Json contact = Json::object();
    contact["finger"] = held.finger;
    contact.update(ContactJson(held.contact, dimension));
    if (held.region) contact["region"] = *held.region;
    json.push_back(std::move(contact));
  }
  return json;
}

}  // namespace regrasp::plan
