#include "planner/grasp/unit_contacts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace regrasp::grasp {

Contact ContactAt(const object::Polygon& polygon, FaceIndex edge, double parameter) {
  const auto [a, b] = polygon.edge(edge);
  return {a + parameter * (b - a), polygon.inward_normal(edge), edge};
}

double ParameterOf(const object::Polygon& polygon, const Contact& contact) {
  const auto [a, b] = polygon.edge(contact.face);
  return (contact.p - a).dot(b - a) / (b - a).squaredNorm();
}

namespace {

[[noreturn]] void Reject(const char* what) {
  throw std::invalid_argument(std::string("grasp: ") + what);
}

void CheckContact(const Contact& contact, int dimension) {
  if (!contact.p.allFinite() || !contact.n.allFinite()) Reject("contacts must be finite");
  if (std::abs(contact.n.squaredNorm() - 1) > 2 * kUnitTolerance)
    Reject("normals must have unit length");
  if (dimension == 2 && (contact.p.z() != 0 || contact.n.z() != 0)) {
    Reject("planar contacts must have z = 0");
  }
  if (!(contact.torsion >= 0) || !std::isfinite(contact.torsion)) {
    Reject("torsions must be finite and at least 0");
  }
  if (dimension == 2 && contact.torsion != 0) Reject("planar contacts must have no torsion");
}

}  // namespace

void CheckGrasp(std::span<const Contact> contacts, const object::WrenchFrame& frame) {
  if (contacts.empty()) Reject("expected at least one contact");
  if (frame.dimension != 2 && frame.dimension != 3) Reject("the dimension must be 2 or 3");
  if (!(frame.radius > 0) || !std::isfinite(frame.radius) || !frame.origin.allFinite()) {
    Reject("the frame must be finite and its radius positive");
  }
  for (const Contact& contact : contacts) CheckContact(contact, frame.dimension);
}

void CheckFrictionAngle(double friction_angle) {
  if (!(friction_angle > 0) || !(friction_angle < std::numbers::pi / 2)) {
    Reject("the friction angle must be in (0, pi/2)");
  }
}

UnitContacts MakeUnitContacts(std::span<const Contact> contacts, const object::WrenchFrame& frame) {
  UnitContacts result;
  result.reserve(contacts.size());
  const double scale = 1 / frame.radius;
  for (const Contact& contact : contacts) {
    result.push_back({(contact.p - frame.origin) * scale, contact.n / contact.n.norm(), 0, 0,
                      contact.torsion * scale});
  }
  return result;
}

object::WrenchFrame ContactFrame(std::span<const Contact> contacts, int dimension) {
  object::WrenchFrame frame{Eigen::Vector3d::Zero(), 0, dimension};
  for (const Contact& contact : contacts) frame.origin += contact.p;
  frame.origin /= static_cast<double>(contacts.size());
  for (const Contact& contact : contacts) {
    frame.radius = std::max(frame.radius, (contact.p - frame.origin).norm());
  }
  return frame;
}

Recentring Recentre(UnitContacts& contacts) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const UnitContact& contact : contacts) centre += contact.q;
  centre /= static_cast<double>(contacts.size());
  double squared = 0;
  for (UnitContact& contact : contacts) {
    contact.q -= centre;
    squared = std::max(squared, contact.q.squaredNorm());
  }
  if (!(squared > 0)) return {centre, 1};
  const double scale = 1 / std::sqrt(squared);
  for (UnitContact& contact : contacts) {
    contact.q *= scale;
    contact.torsion *= scale;
  }
  return {centre, scale};
}

bool HasTorsion(std::span<const UnitContact> contacts) {
  return std::ranges::any_of(contacts, [](const UnitContact& c) { return c.torsion > 0; });
}

void SetUnitForces(UnitContacts& contacts, double friction_angle) {
  const double axial = std::cos(friction_angle);
  const double tangential = std::sin(friction_angle);
  for (UnitContact& contact : contacts) {
    contact.axial = axial;
    contact.tangential = tangential;
  }
}

void SetUnitNormalForces(UnitContacts& contacts, double friction_angle) {
  const double tangential = std::tan(friction_angle);
  for (UnitContact& contact : contacts) {
    contact.axial = 1;
    contact.tangential = tangential;
  }
}

}  // namespace regrasp::grasp
