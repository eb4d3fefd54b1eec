#include "hostile_input.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "planner/base/error.h"

namespace regrasp {

namespace {

/// Normals are unit vectors up to the rounding of one normalisation.
constexpr double kUnitTolerance = 1e-12;

HostileTally tally;

bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

void ExpectOneLine(const std::string& message) {
  const std::string start = kHostileName + ": ";
  if (!message.starts_with(start) || message.size() == start.size()) {
    ReportFinding("the message does not name its input and say what is wrong: " + message);
  }
  if (std::ranges::any_of(message, IsControl)) {
    ReportFinding("the message has control characters: " + message);
  }
}

void ExpectFaceIsFound(const object::Object& object, FaceIndex face) {
  const Eigen::Vector3d normal = object.inward_normal(face);
  if (!(std::abs(normal.norm() - 1) <= kUnitTolerance)) ReportFinding("a normal is not unit");
  if (!(object.face_measure(face) > 0)) ReportFinding("a face without area");
  const Eigen::Vector3d point = object.ClosestPoint(face, object.mass_properties().centroid);
  if (!point.allFinite()) ReportFinding("a closest point is not finite");
  const double tolerance = object::kPointTolerance * object.diameter();
  if (!std::ranges::count(object.FacesNear(point, tolerance), face)) {
    ReportFinding("a face is not near a point of its own");
  }
  if (!object.ContainsSegment(face, point, point, tolerance)) {
    ReportFinding("a face does not contain a point of its own");
  }
  if (!(object.DistanceToBorder(face, point) >= 0)) ReportFinding("a distance is not a number");
}

}  // namespace

HostileTally TallyOfHostileInputs() { return tally; }

void ReportFinding(const std::string& what) {
  std::cerr << "finding: " << what << std::endl;
  std::abort();
}

void ReadHostileInput(const std::function<void()>& read) {
  try {
    read();
    ++tally.read;
  } catch (const InputError& error) {
    ExpectOneLine(error.what());
    ++tally.refused;
  } catch (const std::exception& error) {
    ReportFinding(std::string("not an InputError: ") + error.what());
  }
}

void ExpectSound(const object::Object& object) {
  if (!(object.diameter() > 0 && std::isfinite(object.diameter()))) {
    ReportFinding("the diameter is not a positive number");
  }
  const object::MassProperties& mass = object.mass_properties();
  if (!(mass.volume > 0) || !mass.centroid.allFinite() || !mass.inertia.allFinite()) {
    ReportFinding("the mass properties are not those of a solid");
  }
  if (object.face_count() == 0) ReportFinding("an object without faces");
  for (FaceIndex face{0}; face < object.face_count(); ++face) ExpectFaceIsFound(object, face);
}

}  // namespace regrasp
