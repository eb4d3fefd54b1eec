#include "planner/motion/path_force_closure.h"

#include <algorithm>
#include <numbers>

#include "planner/grasp/force_closure.h"
#include "planner/motion/motion_certificate.h"

namespace regrasp {

namespace {

/// So many intervals of one motion are looked at: a motion that needs more keeps within about 1e-5
/// of the limit, and no file may keep the program busy for more than seconds.
constexpr int kMostIntervals = 100'000;
/// Each of these costs tens of force-closure tests.
constexpr int kMostAngleIntervals = 20'000;

/// Intervals shorter than this are given more room than kPathAngleAccuracy: twice as much with
/// every halving, so that the search ends.
constexpr double kWidenBelow = 1e-4;

/// Required half-angles of single instants are found to this, radians.
constexpr double kInstantAccuracy = kPathAngleAccuracy / 100;

/// ComputeRequiredHalfAngle looks no farther.
constexpr double kLargestHalfAngle = std::numbers::pi / 2 - 1e-6;

class PathDecision {
 public:
  PathDecision(const GraspMotion& motion, const WrenchFrame& frame, double half_angle)
      : motion_(motion), frame_(frame), half_angle_(half_angle) {}

  PathForceClosure Decide() {
    result_.holds = true;
    Decide(0, 1);
    return result_;
  }

 private:
  void Decide(double from, double to) {
    const double centre = from + (to - from) / 2;
    if (!result_.holds) return;
    if (++intervals_ > kMostIntervals) return Lose(centre);
    if (CertifyForceClosure(motion_, frame_.dimension, half_angle_, centre, (to - from) / 2)) {
      return;
    }
    if (!HoldsAt(centre)) return Lose(centre);
    if (to - from > kShortestInterval) {
      Decide(from, centre);
      Decide(centre, to);
      return;
    }
    if (!HoldsAt(from)) return Lose(from);
    if (!HoldsAt(to)) return Lose(to);
    if (++result_.undecided > kMostUndecided) Lose(centre);
  }

  [[nodiscard]] bool HoldsAt(double t) const {
    return IsForceClosure(GraspAt(motion_, t), frame_, half_angle_);
  }

  void Lose(double t) {
    if (!result_.holds) return;
    result_.holds = false;
    result_.lost_at = t;
  }

  const GraspMotion& motion_;
  const WrenchFrame& frame_;
  double half_angle_;
  int intervals_ = 0;
  PathForceClosure result_;
};

class PathAngle {
 public:
  PathAngle(const GraspMotion& motion, const WrenchFrame& frame) : motion_(motion), frame_(frame) {}

  /// @returns false where an instant is force closure at no angle.
  bool Include(double t) {
    const auto required = ComputeRequiredHalfAngle(GraspAt(motion_, t), frame_, kInstantAccuracy);
    if (!required) return false;
    bounds_.lower = std::max(bounds_.lower, required->lower);
    bounds_.upper = std::max(bounds_.upper, required->upper);
    return true;
  }

  /// @returns false where an instant is force closure at no angle.
  bool Cover(double from, double to) {
    const double length = to - from;
    const double centre = from + length / 2;
    if (!complete_) return true;
    if (++intervals_ > kMostAngleIntervals) complete_ = false;
    if (!Include(centre)) return false;
    const double room = kPathAngleAccuracy * std::max(1.0, kWidenBelow / length);
    const double angle = std::min(bounds_.upper + room, kLargestHalfAngle);
    if (CertifyForceClosure(motion_, frame_.dimension, angle, centre, length / 2)) {
      certified_ = std::max(certified_, angle);
      return true;
    }
    if (length <= kShortestInterval) complete_ = false;
    return Cover(from, centre) && Cover(centre, to);
  }

  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] RequiredHalfAngle bounds() const { return {bounds_.lower, certified_}; }

 private:
  const GraspMotion& motion_;
  const WrenchFrame& frame_;
  RequiredHalfAngle bounds_;  ///< of the instants seen so far
  double certified_ = 0;
  bool complete_ = true;
  int intervals_ = 0;
};

}  // namespace

PathForceClosure DecidePathForceClosure(const GraspMotion& motion, const WrenchFrame& frame,
                                        double half_angle) {
  return PathDecision(motion, frame, half_angle).Decide();
}

std::optional<RequiredHalfAngle> ComputePathRequiredHalfAngle(const GraspMotion& motion,
                                                              const WrenchFrame& frame,
                                                              std::optional<double> proven) {
  PathAngle search(motion, frame);
  // The ends first: the largest angle of all is often one of theirs.
  if (!search.Include(0) || !search.Include(1) || !search.Cover(0, 1)) return std::nullopt;
  RequiredHalfAngle bounds = search.bounds();
  if (!search.complete()) {
    if (!proven) return std::nullopt;
    bounds.upper = *proven;
  }
  if (proven) bounds.upper = std::min(bounds.upper, *proven);
  return bounds;
}

}  // namespace regrasp
