#pragma once

#include <algorithm>
#include <cmath>

#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {

// Wrenches and twists of contacts as kDim numbers. In space, kDim is 6: (force, torque) and (v,
// omega). In the plane, kDim is 3: (force x, force y, torque z) and (v x, v y, omega z). The power
// of a force g and a torque τ about the normal at a contact is twist · wrench = u · g + s τ. Here u
// is the velocity of the contact point and s = n · omega the spin about its normal.

/// Load that a contact applies: a force and, for a soft finger, a torque about the normal.
struct ContactWrench {
  Eigen::Vector3d force;
  double torque = 0;
};

/// Write the wrench (g, q × g + τ n) of the load that a contact applies.
template <int kDim>
inline void WriteWrench(const UnitContact& contact, const ContactWrench& applied, double* out) {
  const Eigen::Vector3d& force = applied.force;
  if constexpr (kDim == 6) {
    Eigen::Vector3d torque = contact.q.cross(force);
    if (applied.torque != 0) torque += applied.torque * contact.n;
    std::copy_n(force.data(), 3, out);
    std::copy_n(torque.data(), 3, out + 3);
  } else {
    out[0] = force.x();
    out[1] = force.y();
    out[2] = contact.q.x() * force.y() - contact.q.y() * force.x();
  }
}

/// Return the velocity u = v + omega × q of a contact point under a twist.
template <int kDim>
[[nodiscard]] inline Eigen::Vector3d Velocity(const UnitContact& contact, const double* twist) {
  if constexpr (kDim == 6) {
    const Eigen::Map<const Eigen::Vector3d> v(twist);
    const Eigen::Map<const Eigen::Vector3d> omega(twist + 3);
    return v + omega.cross(contact.q);
  } else {
    return {twist[0] - twist[2] * contact.q.y(), twist[1] + twist[2] * contact.q.x(), 0};
  }
}

/// Return the spin n · omega of the object about a contact's normal under a twist.
/// 0 in the plane, because no contact resists it.
template <int kDim>
[[nodiscard]] inline double Spin(const UnitContact& contact, const double* twist) {
  if constexpr (kDim == 6) return contact.n.dot(Eigen::Map<const Eigen::Vector3d>(twist + 3));
  return 0;
}

/// Return the support of the cone, the largest u · g + s τ over its rim.
///
///     axial n·u + tangential √(|u − (n·u) n|² + (torsion s)²).
[[nodiscard]] inline double ConeSupport(const UnitContact& contact, const Eigen::Vector3d& u,
                                        double spin = 0) {
  const double approach = contact.n.dot(u);
  const double turning = contact.torsion * spin;
  return contact.axial * approach +
         contact.tangential *
             std::sqrt((u - approach * contact.n).squaredNorm() + turning * turning);
}

/// Return the support of the cone for a twist.
template <int kDim>
[[nodiscard]] inline double ConeSupportOf(const UnitContact& contact, const double* twist) {
  return ConeSupport(contact, Velocity<kDim>(contact, twist), Spin<kDim>(contact, twist));
}

/// Distance below the friction angle up to which a twist separates, radians, at which it separates
/// by much more than rounding.
inline constexpr double kClearlyRefuted = 1e-10;

/// Return the largest friction angle at which a contact's whole cone works against a twist.
/// There its support is 0: tan θ = −n·u / √(|u − (n·u) n|² + (torsion s)²). Not positive if not
/// even the normal force works against the twist.
template <int kDim>
[[nodiscard]] inline double HeldOffFrictionAngle(const UnitContact& contact, const double* twist) {
  const Eigen::Vector3d u = Velocity<kDim>(contact, twist);
  const double approach = contact.n.dot(u);
  const double turning = contact.torsion * Spin<kDim>(contact, twist);
  return std::atan2(-approach,
                    std::sqrt((u - approach * contact.n).squaredNorm() + turning * turning));
}

/// Return a unit vector perpendicular to n, in the plane if kDim is 3.
template <int kDim>
[[nodiscard]] inline Eigen::Vector3d AnyTangent(const Eigen::Vector3d& n) {
  if constexpr (kDim == 3) return {-n.y(), n.x(), 0};
  // The axis farther from n makes the cross product at least √3/2 long.
  return n.cross(std::abs(n.x()) < 0.5 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY())
      .normalized();
}

/// Ratio of sliding to approach velocity below which cancellation makes the computed sliding
/// direction imprecise.
inline constexpr double kSlowSliding = 1e-4;

/// Return the direction in which a contact with velocity u slides, exactly perpendicular to n.
template <int kDim>
[[nodiscard]] inline Eigen::Vector3d SlidingDirection(const Eigen::Vector3d& n,
                                                      const Eigen::Vector3d& u) {
  if constexpr (kDim == 3) {
    const Eigen::Vector3d tangent = AnyTangent<kDim>(n);
    return tangent.dot(u) < 0 ? Eigen::Vector3d(-tangent) : tangent;
  }
  const double approach = n.dot(u);
  const Eigen::Vector3d sliding = u - approach * n;
  const double speed = sliding.norm();
  if (!(speed > 0)) return AnyTangent<kDim>(n);
  const Eigen::Vector3d tangent = sliding * (1 / speed);
  if (speed > kSlowSliding * std::abs(approach)) return tangent;
  return (tangent - n.dot(tangent) * n).normalized();
}

/// Return the rim force of a hard-finger contact that attains ConeSupport.
template <int kDim>
[[nodiscard]] inline Eigen::Vector3d SupportForce(const UnitContact& contact,
                                                  const Eigen::Vector3d& u) {
  return contact.axial * contact.n + contact.tangential * SlidingDirection<kDim>(contact.n, u);
}

/// Return the load on the rim that attains ConeSupport, for any contact.
/// Friction force and torque are those of the ellipsoid's point whose normal is along sliding and
/// spin.
template <int kDim>
[[nodiscard]] inline ContactWrench SupportWrench(const UnitContact& contact,
                                                 const Eigen::Vector3d& u, double spin) {
  const double turning = contact.torsion * spin;
  if (turning == 0) return {SupportForce<kDim>(contact, u)};
  const double sliding = (u - contact.n.dot(u) * contact.n).norm();
  const double share = contact.tangential / std::hypot(sliding, turning);
  return {contact.axial * contact.n + (share * sliding) * SlidingDirection<kDim>(contact.n, u),
          share * turning * contact.torsion};
}

}  // namespace regrasp::grasp
