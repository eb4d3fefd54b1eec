#include "planner/grasp/quality_filter.h"

#include <algorithm>
#include <cassert>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/quality_rays.h"

namespace regrasp::grasp {

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
