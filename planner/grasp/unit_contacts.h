#pragma once

#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// The contact at a parameter of an edge, 0 at its first end and 1 at its last, and back.
[[nodiscard]] Contact ContactAt(const object::Polygon& polygon, FaceIndex edge, double parameter);
[[nodiscard]] double ParameterOf(const object::Polygon& polygon, const Contact& contact);

/// A contact as the mathematics of one grasp uses it: moved to a frame's origin, divided by its
/// radius, with the rim of its friction cone as numbers.
///
/// The forces of the rim are axial · n + tangential · t for unit t ⟂ n, so the cone's half-angle is
/// atan(tangential / axial). (cos θ, sin θ) makes them unit forces, (1, tan θ) unit normal forces.
/// Of a soft finger (Contact::torsion) the rim has a torque about n too: for all φ the force
/// axial · n + tangential cos φ · t goes with the torque tangential sin φ · torsion.
struct UnitContact {
  Eigen::Vector3d q;
  Eigen::Vector3d n;
  double axial;
  double tangential;
  double torsion = 0;  ///< over the frame's radius, as q
};

/// So many contacts are kept without asking for memory.
inline constexpr int kInlineContacts = 12;
struct UnitContacts : boost::container::small_vector<UnitContact, kInlineContacts> {
  // Boost's iterators are not contiguous ones, so std::span does not take the container itself.
  operator std::span<const UnitContact>() const { return {data(), size()}; }  // NOLINT
};

/// Normals whose length differs from 1 by more than this are not unit: far above the rounding of a
/// normalised vector, far below any real mistake. What is within it is normalised again.
inline constexpr double kUnitTolerance = 1e-6;

/// Checks a grasp and its friction.
///
/// @throws std::invalid_argument  no contact, a value not finite, a normal not unit, a negative
///                                torsion, z or torsion ≠ 0 in the plane, a dimension other than 2
///                                and 3, or a radius not positive.
void CheckGrasp(std::span<const Contact> contacts, const object::WrenchFrame& frame);

/// @throws std::invalid_argument  θ is outside (0, π/2).
void CheckHalfAngle(double half_angle);

/// Moves contacts to a frame of positive radius; the rims are still to be set.
[[nodiscard]] UnitContacts MakeUnitContacts(std::span<const Contact> contacts,
                                            const object::WrenchFrame& frame);

/// The frame in which the contacts themselves are centred and of radius 1; radius 0 where they all
/// coincide. Force closure does not depend on the frame, and is decided most precisely in this one.
[[nodiscard]] object::WrenchFrame ContactFrame(std::span<const Contact> contacts, int dimension);

/// How contacts were moved: q became (q − centre) · scale.
struct Recentring {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 1;
};

/// Moves contacts to their own centre and radius (ContactFrame); only to the centre where that is
/// 0.
Recentring Recentre(UnitContacts& contacts);

/// Whether some contact is a soft finger.
[[nodiscard]] bool HasTorsion(std::span<const UnitContact> contacts);

/// Sets the rims of all contacts to half-angle θ with forces of unit length; of a soft finger,
/// those without a torque.
void SetUnitForces(UnitContacts& contacts, double half_angle);

/// Sets the rims of all contacts to half-angle θ with normal forces of 1.
void SetUnitNormalForces(UnitContacts& contacts, double half_angle);

/// Contacts as fingertips of one torsion make them (Contact::torsion): a view of copies, and of the
/// contacts themselves where the torsion is 0. The contacts must stay alive.
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
