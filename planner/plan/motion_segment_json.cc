#include "planner/plan/motion_segment_json.h"

namespace regrasp::plan {

Json ForcesJson(const std::vector<Eigen::Vector3d>& forces, int dimension) {
  Json json = Json::array();
  for (const Eigen::Vector3d& force : forces) json.push_back(VectorJson(force, dimension));
  return json;
}

Json MotionSegmentsJson(const motion::MotionSegments& pieces, int dimension) {
  Json json = Json::array();
  for (const motion::MotionSegment& piece : pieces) {
    json.push_back({{"from", piece.from},
                    {"to", piece.to},
                    {"start", ForcesJson(piece.start, dimension)},
                    {"end", ForcesJson(piece.end, dimension)}});
    if (piece.start_torques.empty()) continue;
    json.back()["start_torques"] = piece.start_torques;
    json.back()["end_torques"] = piece.end_torques;
  }
  return json;
}

std::vector<Eigen::Vector3d> ReadForces(const JsonReader& json, int dimension) {
  std::vector<Eigen::Vector3d> forces;
  for (const JsonReader& force : json.Elements()) forces.push_back(force.Vector(dimension));
  return forces;
}

std::vector<double> ReadTorques(const JsonReader& json, const char* name) {
  std::vector<double> torques;
  if (!json.Has(name)) return torques;
  for (const JsonReader& torque : json.Member(name).Elements()) torques.push_back(torque.Number());
  return torques;
}

motion::MotionSegments ReadMotionSegments(const JsonReader& json, int dimension) {
  motion::MotionSegments pieces;
  for (const JsonReader& piece : json.Elements()) {
    pieces.push_back({piece.Member("from").Number(), piece.Member("to").Number(),
                      ReadForces(piece.Member("start"), dimension),
                      ReadForces(piece.Member("end"), dimension),
                      ReadTorques(piece, "start_torques"), ReadTorques(piece, "end_torques")});
  }
  return pieces;
}

}  // namespace regrasp::plan
