#include "planner/grasp/quality_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "planner/grasp/cone_support.h"

namespace regrasp::grasp {

template <int kDim>
WrenchSet<kDim>::WrenchSet(std::span<const UnitContact> contacts)
    : contacts_(contacts), simplex_(contacts, {}) {
  simplex_.FindWeights(/*stop_early=*/false);
}

template <int kDim>
typename WrenchSet<kDim>::SupportPoint WrenchSet<kDim>::Support(const Vector& twist) const {
  SupportPoint support{0, Vector::Zero()};
  for (const UnitContact& contact : contacts_) {
    const Eigen::Vector3d u = Velocity<kDim>(contact, twist.data());
    const double spin = Spin<kDim>(contact, twist.data());
    const double value = ConeSupport(contact, u, spin);
    if (value > support.value) {
      support.value = value;
      WriteWrench<kDim>(contact, SupportWrench<kDim>(contact, u, spin), support.point.data());
    }
  }
  return support;
}

template <int kDim>
typename WrenchSet<kDim>::Hit WrenchSet<kDim>::Shoot(const Vector& direction, double gap,
                                                     double enough) const {
  typename WrenchSimplex<kDim>::Vector column;
  for (int r = 0; r < kDim; ++r) column[r] = -direction[r];
  WrenchSimplex<kDim> simplex = simplex_;
  Hit hit;
  hit.distance = simplex.Maximise(column, 0, {.gap = gap, .enough = enough}).lower;
  const auto twist = simplex.twist();
  hit.normal = Eigen::Map<const Vector>(twist.data());
  return hit;
}

template <int kDim>
typename WrenchSet<kDim>::Vector WrenchSet<kDim>::RimWrench(int contact, double angle) const {
  const UnitContact& unit = contacts_[contact];
  const Eigen::Vector3d first = AnyTangent<kDim>(unit.n);
  Eigen::Vector3d tangent;
  if constexpr (kDim == 3) {
    tangent = std::cos(angle) < 0 ? Eigen::Vector3d(-first) : first;
  } else {
    tangent = std::cos(angle) * first + std::sin(angle) * unit.n.cross(first);
  }
  Vector wrench;
  WriteWrench<kDim>(unit, {unit.axial * unit.n + unit.tangential * tangent}, wrench.data());
  return wrench;
}

template <int kDim>
typename WrenchSet<kDim>::Vector WrenchSet<kDim>::TorsionWrench(int contact, double sign) const {
  const UnitContact& unit = contacts_[contact];
  Vector wrench;
  WriteWrench<kDim>(unit, {unit.axial * unit.n, sign * unit.tangential * unit.torsion},
                    wrench.data());
  return wrench;
}

template class WrenchSet<3>;
template class WrenchSet<6>;

namespace {

/// Number of stored twists. Testing all of them takes a microsecond, a twentieth of the time of the
/// fastest decision by rays.
constexpr std::size_t kMostTwists = 64;

}  // namespace

QualityFilter::QualityFilter(const object::WrenchFrame& frame, double friction_angle)
    : frame_(frame), friction_angle_(friction_angle) {
  CheckFrictionAngle(friction_angle);
}

bool QualityFilter::IsClearlyAtLeast(std::span<const Contact> grasp, double threshold) {
  assert(threshold > 0);
  UnitContacts contacts = MakeUnitContacts(grasp, frame_);
  SetUnitNormalForces(contacts, friction_angle_);
  return frame_.dimension == 3 ? Decide<6>(contacts, threshold) : Decide<3>(contacts, threshold);
}

template <int kDim>
bool QualityFilter::Decide(const UnitContacts& contacts, double threshold) {
  if (IsRefuted<kDim>(contacts, threshold)) return false;
  ++shot_count_;
  const WrenchSet<kDim> set(contacts);
  RaySearch<kDim> rays(set, threshold);
  rays.Run();
  if (rays.bounds().upper < threshold) {
    if (twists_.size() == kMostTwists) twists_.pop_back();
    Twist twist = Twist::Zero();
    twist.head<kDim>() = rays.nearest();
    twists_.insert(twists_.begin(), twist);
  }
  return rays.bounds().lower >= threshold;
}

template <int kDim>
bool QualityFilter::IsRefuted(const UnitContacts& contacts, double threshold) {
  for (std::size_t i = 0; i < twists_.size(); ++i) {
    const bool refutes = std::all_of(contacts.begin(), contacts.end(), [&](const auto& contact) {
      return ConeSupportOf<kDim>(contact, twists_[i].data()) < threshold;
    });
    if (!refutes) continue;
    std::swap(twists_[i], twists_[i / 2]);
    return true;
  }
  return false;
}

}  // namespace regrasp::grasp
