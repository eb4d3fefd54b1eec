#include "planner/motion/path_force_closure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

#include "planner/grasp/force_closure.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/motion/find_motion_proof.h"

namespace regrasp::motion {

namespace {

/// Length of intervals below which the slack exceeds kPathAngleAccuracy. It doubles with every
/// halving, and for all intervals with every kPatience evaluated intervals, so that the search
/// ends.
constexpr double kWidenBelow = 1e-4;
constexpr int kPatience = 200;

/// Tolerance of required friction angles of single instants, radians.
constexpr double kInstantAccuracy = kPathAngleAccuracy / 100;

/// Largest friction angle of ComputeRequiredFrictionAngle.
constexpr double kLargestFrictionAngle = std::numbers::pi / 2 - 1e-6;

/// Proofs of pieces of a motion, found in floating point and checked in exact arithmetic.
class SegmentProofs {
 public:
  SegmentProofs(const GraspMotion& motion, int dimension) : motion_(motion), dimension_(dimension) {
    for (const ContactMotion& contact : motion) {
      from_.push_back(contact.from());
      to_.push_back(contact.to());
    }
  }

  [[nodiscard]] std::optional<MotionSegment> Prove(double friction_angle, double from,
                                                   double to) const {
    auto proof = FindSegmentProof(motion_, dimension_, friction_angle, from, to);
    if (!proof) return std::nullopt;
    const double mu = std::tan(friction_angle);
    if (!CheckSegmentProof(from_, to_, dimension_, mu, *proof).proves()) return std::nullopt;
    return proof;
  }

 private:
  const GraspMotion& motion_;
  int dimension_;
  grasp::Grasp from_;
  grasp::Grasp to_;
};

class PathDecision {
 public:
  PathDecision(const GraspMotion& motion, const object::WrenchFrame& frame, double friction_angle,
               ProofBudget& budget)
      : motion_(motion),
        proofs_(motion, frame.dimension),
        frame_(frame),
        friction_angle_(friction_angle),
        budget_(budget) {}

  PathForceClosure Decide() {
    result_.decision = grasp::Decision::kYes;
    Decide(0, 1);
    return result_;
  }

 private:
  void Decide(double from, double to) {
    const double centre = from + (to - from) / 2;
    if (Ended()) return;
    if (++intervals_ > kMostIntervals || !budget_.SpendPiece(motion_.size())) {
      return EndEarly(centre);
    }
    if (!HoldsAt(centre)) return Lose(centre);
    if (auto proof = proofs_.Prove(friction_angle_, from, to)) {
      result_.pieces.push_back(*std::move(proof));
      return;
    }
    if (to - from > kShortestInterval) {
      Decide(from, centre);
      Decide(centre, to);
      return;
    }
    if (!HoldsAt(from)) return Lose(from);
    if (!HoldsAt(to)) return Lose(to);
    LeaveOpen(centre);
    if (++result_.undecided > kMostUndecided) EndEarly(centre);
  }

  [[nodiscard]] bool Ended() const {
    return result_.decision == grasp::Decision::kNo || result_.ended_early;
  }

  [[nodiscard]] bool HoldsAt(double t) const {
    return grasp::IsForceClosure(GraspAt(motion_, t), frame_, friction_angle_);
  }

  void Lose(double t) {
    result_.decision = grasp::Decision::kNo;
    result_.at = t;
  }

  void LeaveOpen(double t) {
    if (result_.decision != grasp::Decision::kYes) return;
    result_.decision = grasp::Decision::kTooClose;
    result_.at = t;
  }

  void EndEarly(double t) {
    LeaveOpen(t);
    result_.ended_early = true;
  }

  const GraspMotion& motion_;
  SegmentProofs proofs_;
  const object::WrenchFrame& frame_;
  double friction_angle_;
  ProofBudget& budget_;
  int intervals_ = 0;
  PathForceClosure result_;
};

/// Search for a bound on the whole path.
/// Intervals with a proof are finished, others are halved, those with the largest required friction
/// angle at their middle first. The largest angle is thus known before intervals that it easily
/// covers are evaluated.
class PathAngle {
 public:
  PathAngle(const GraspMotion& motion, const object::WrenchFrame& frame,
            std::optional<double> proven, ProofBudget& budget)
      : motion_(motion),
        proofs_(motion, frame.dimension),
        frame_(frame),
        proven_(proven),
        budget_(budget) {}

  /// Search for the bound.
  /// @returns false if an instant is force closure at no angle.
  bool Search() {
    // The ends first, because one of them often has the largest angle.
    if (!Include(0) || !IncludeEnd(1) || !IncludeEnd(0.5)) return false;
    open_.push({0, 1, 0});
    while (!open_.empty() && complete_) {
      if (!budget_.SpendPiece(motion_.size())) complete_ = false;
      const Interval interval = open_.top();
      open_.pop();
      if (!Cover(interval)) return false;
    }
    return true;
  }

  [[nodiscard]] bool complete() const { return complete_; }
  [[nodiscard]] grasp::RequiredFrictionAngle bounds() const { return {bounds_.lower, proved_}; }

 private:
  struct Interval {
    double from;
    double to;
    double required;  ///< required angle at the middle; 0 if within the known bound

    [[nodiscard]] double length() const { return to - from; }
    bool operator<(const Interval& other) const {
      return std::pair(required, from) < std::pair(other.required, other.from);
    }
  };

  /// Return whether an instant requires no larger angle than the known bound; initially false.
  bool IsCovered(double t) const {
    return bounds_.lower > 0 && grasp::IsForceClosure(GraspAt(motion_, t), frame_, bounds_.lower);
  }

  bool IncludeEnd(double t) { return IsCovered(t) || Include(t).has_value(); }

  /// Include an instant in the bound.
  /// @returns its required friction angle; nullopt if it is force closure at no angle.
  std::optional<double> Include(double t) {
    const auto required = RequiredAt(t);
    if (!required) return std::nullopt;
    bounds_.lower = std::max(bounds_.lower, required->lower);
    bounds_.upper = std::max(bounds_.upper, required->upper);
    return required->upper;
  }

  /// Return the required friction angle, but at least that of earlier instants.
  /// This suffices for the bound.
  [[nodiscard]] std::optional<grasp::RequiredFrictionAngle> RequiredAt(double t) const {
    const grasp::Grasp grasp = GraspAt(motion_, t);
    if (!proven_ || *proven_ > kLargestFrictionAngle) {
      return grasp::ComputeRequiredFrictionAngle(grasp, frame_, kInstantAccuracy);
    }
    const double lower = std::min(bounds_.lower, *proven_);
    return grasp::NarrowRequiredFrictionAngle(grasp, frame_, {lower, *proven_}, kInstantAccuracy);
  }

  bool Add(double from, double to) {
    const double middle = from + (to - from) / 2;
    // Its angle is computed only if it raises the bound, because that costs as much as twenty
    // decisions.
    if (IsCovered(middle)) {
      open_.push({from, to, 0});
      return true;
    }
    const auto required = Include(middle);
    if (required) open_.push({from, to, *required});
    return required.has_value();
  }

  bool Cover(const Interval& interval) {
    const int widened = intervals_++ / kPatience;
    const double slack =
        std::ldexp(kPathAngleAccuracy, widened) * std::max(1.0, kWidenBelow / interval.length());
    const double angle = std::min(bounds_.upper + slack, kLargestFrictionAngle);
    if (proofs_.Prove(angle, interval.from, interval.to)) {
      proved_ = std::max(proved_, angle);
      return true;
    }
    if (angle == kLargestFrictionAngle || interval.length() <= kShortestInterval) complete_ = false;
    const double middle = interval.from + interval.length() / 2;
    return Add(interval.from, middle) && Add(middle, interval.to);
  }

  const GraspMotion& motion_;
  SegmentProofs proofs_;
  const object::WrenchFrame& frame_;
  std::optional<double> proven_;
  ProofBudget& budget_;
  grasp::RequiredFrictionAngle bounds_;  ///< bounds over the instants evaluated so far
  std::priority_queue<Interval> open_;
  double proved_ = 0;
  bool complete_ = true;
  int intervals_ = 0;
};

/// Return the default budget of a single motion.
ProofBudget BudgetOf(const GraspMotion& motion) {
  return ProofBudget(kMostIntervals * static_cast<std::int64_t>(motion.size()));
}

}  // namespace

PathForceClosure DecidePathForceClosure(const GraspMotion& motion, const object::WrenchFrame& frame,
                                        double friction_angle, ProofBudget& budget) {
  return PathDecision(motion, frame, friction_angle, budget).Decide();
}

PathForceClosure DecidePathForceClosure(const GraspMotion& motion, const object::WrenchFrame& frame,
                                        double friction_angle) {
  ProofBudget budget = BudgetOf(motion);
  return DecidePathForceClosure(motion, frame, friction_angle, budget);
}

std::optional<grasp::RequiredFrictionAngle> ComputePathRequiredFrictionAngle(
    const GraspMotion& motion, const object::WrenchFrame& frame, std::optional<double> proven,
    ProofBudget& budget) {
  PathAngle search(motion, frame, proven, budget);
  if (!search.Search()) return std::nullopt;
  grasp::RequiredFrictionAngle bounds = search.bounds();
  if (!search.complete()) {
    if (!proven) return std::nullopt;
    bounds.upper = *proven;
  }
  if (proven) bounds.upper = std::min(bounds.upper, *proven);
  return bounds;
}

std::optional<grasp::RequiredFrictionAngle> ComputePathRequiredFrictionAngle(
    const GraspMotion& motion, const object::WrenchFrame& frame, std::optional<double> proven) {
  ProofBudget budget = BudgetOf(motion);
  return ComputePathRequiredFrictionAngle(motion, frame, proven, budget);
}

}  // namespace regrasp::motion
