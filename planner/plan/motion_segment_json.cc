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
  }
  return json;
}

std::vector<Eigen::Vector3d> ReadForces(const JsonReader& json, int dimension) {
  std::vector<Eigen::Vector3d> forces;
  for (const JsonReader& force : json.Elements()) forces.push_back(force.Vector(dimension));
  return forces;
}

motion::MotionSegments ReadMotionSegments(const JsonReader& json, int dimension) {
  motion::MotionSegments pieces;
  for (const JsonReader& piece : json.Elements()) {
    pieces.push_back({piece.Member("from").Number(), piece.Member("to").Number(),
                      ReadForces(piece.Member("start"), dimension),
                      ReadForces(piece.Member("end"), dimension)});
  }
  return pieces;
}

}  // namespace regrasp::plan
