#pragma once

#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Convert between a contact and its parameter on an edge, 0 at the first end and 1 at the last.
[[nodiscard]] Contact ContactAt(const object::Polygon& polygon, FaceIndex edge, double parameter);
[[nodiscard]] double ParameterOf(const object::Polygon& polygon, const Contact& contact);

/// Contact in normalized coordinates: relative to a frame's origin and divided by its radius.
/// The rim of its friction cone is stored as numbers.
///
/// The forces of the rim are axial · n + tangential · t for unit t ⟂ n, so the friction angle is
/// atan(tangential / axial). (cos θ, sin θ) makes them unit forces, (1, tan θ) unit normal forces.
/// The rim of a soft finger (Contact::torsion) also has a torque about n: for all φ, the force
/// axial · n + tangential cos φ · t with the torque tangential sin φ · torsion.
struct UnitContact {
  Eigen::Vector3d q;
  Eigen::Vector3d n;
  double axial;
  double tangential;
  double torsion = 0;  ///< torsional friction length over the frame's radius, as q
};

/// Number of contacts stored without memory allocation.
inline constexpr int kInlineContacts = 12;
struct UnitContacts : boost::container::small_vector<UnitContact, kInlineContacts> {
  // Boost's iterators are not contiguous iterators, so std::span does not accept the container
  // itself.
  operator std::span<const UnitContact>() const { return {data(), size()}; }  // NOLINT
};

/// Largest deviation from 1 of the length of a unit normal. Much larger than the rounding of a
/// normalized vector, much smaller than real mistakes. Normals within it are normalized again.
inline constexpr double kUnitTolerance = 1e-6;

/// Check a grasp.
///
/// @throws std::invalid_argument  if there is no contact, a value is not finite, a normal is not a
///     unit vector, or a torsion is negative; if z or torsion is not 0 in the plane; if the
///     dimension is neither 2 nor 3, or the radius is not positive.
void CheckGrasp(std::span<const Contact> contacts, const object::WrenchFrame& frame);

/// Check a friction angle.
/// @throws std::invalid_argument  if θ is outside (0, π/2).
void CheckFrictionAngle(double friction_angle);

/// Transform contacts to a frame of positive radius; their rims are not set.
[[nodiscard]] UnitContacts MakeUnitContacts(std::span<const Contact> contacts,
                                            const object::WrenchFrame& frame);

/// Return the frame in which the contacts themselves are centred and have radius 1.
/// The radius is 0 if all contacts coincide. Force closure does not depend on the frame, and its
/// decision is most precise in this one.
[[nodiscard]] object::WrenchFrame ContactFrame(std::span<const Contact> contacts, int dimension);

/// Transformation of contacts: q became (q − centre) · scale.
struct Recentring {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 1;
};

/// Transform contacts to their own centre and radius (ContactFrame).
/// If the radius is 0, only to the centre.
Recentring Recentre(UnitContacts& contacts);

/// Return whether any contact is a soft finger.
[[nodiscard]] bool HasTorsion(std::span<const UnitContact> contacts);

/// Set the rims of all contacts to friction angle θ with forces of unit length.
/// For a soft finger, the forces without a torque have unit length.
void SetUnitForces(UnitContacts& contacts, double friction_angle);

/// Set the rims of all contacts to friction angle θ with normal forces of 1.
void SetUnitNormalForces(UnitContacts& contacts, double friction_angle);

/// View of contacts with one torsional friction length of all fingertips (Contact::torsion).
/// Refers to copies, or to the contacts themselves if the torsion is 0. The contacts must outlive
/// it.
class SoftContacts {
 public:
  SoftContacts(std::span<const Contact> contacts, double torsion) : view_(contacts) {
    if (torsion == 0) return;
    soft_.assign(contacts.begin(), contacts.end());
    for (Contact& contact : soft_) contact.torsion = torsion;
    view_ = {soft_.data(), soft_.size()};
  }
  SoftContacts(const SoftContacts&) = delete;
  SoftContacts& operator=(const SoftContacts&) = delete;

  [[nodiscard]] std::span<const Contact> view() const { return view_; }

 private:
  boost::container::small_vector<Contact, kInlineContacts> soft_;
  std::span<const Contact> view_;
};

}  // namespace regrasp::grasp
