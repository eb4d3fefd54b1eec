#include "planner/kinematics/finger_kinematics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace regrasp::kinematics {
namespace {

using Eigen::Vector3d;

double AngleOf(const Joint& joint, const JointConfiguration& configuration) {
  return joint.ratio * configuration[joint.drive] + joint.coupling_offset;
}

Eigen::Matrix3d TurnOf(const Joint& joint, const JointConfiguration& configuration) {
  return Eigen::AngleAxisd(AngleOf(joint, configuration) - joint.rest, joint.axis)
      .toRotationMatrix();
}

}  // namespace

const Joint& LeadingJoint(const Finger& finger, int drive) {
  const auto leads = [&](const Joint& joint) { return joint.drive == drive && !joint.follows; };
  return *std::ranges::find_if(finger.joints, leads);
}

std::vector<double> JointAngles(const Finger& finger, const JointConfiguration& configuration) {
  std::vector<double> angles;
  angles.reserve(finger.joints.size());
  for (const Joint& joint : finger.joints) angles.push_back(AngleOf(joint, configuration));
  return angles;
}

JointConfiguration ConfigurationAt(const Finger& finger, const std::vector<double>& angles) {
  JointConfiguration configuration(finger.drives);
  for (std::size_t i = 0; i < finger.joints.size(); ++i) {
    const Joint& joint = finger.joints[i];
    if (!joint.follows) configuration[joint.drive] = DriveAngle(joint, angles[i]);
  }
  return configuration;
}

JointFrames FramesOf(const Finger& finger, const JointConfiguration& configuration) {
  JointFrames frames;
  frames.reserve(finger.joints.size());
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (const Joint& joint : finger.joints) {
    frame.translation() += frame.linear() * joint.offset;
    frame.linear() *= TurnOf(joint, configuration);
    frames.push_back(frame);
  }
  return frames;
}

TipState TipAt(const Finger& finger, const JointConfiguration& configuration) {
  std::array<Vector3d, kMostJoints> origins;
  std::array<Vector3d, kMostJoints> axes;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  Vector3d origin = Vector3d::Zero();
  const int count = static_cast<int>(finger.joints.size());
  for (int i = 0; i < count; ++i) {
    const Joint& joint = finger.joints[i];
    origin += turned * joint.offset;
    turned = turned * TurnOf(joint, configuration);
    origins[i] = origin;
    axes[i].noalias() = turned * joint.axis;
  }
  TipState state;
  state.centre = origin + turned * finger.tip.centre;
  state.axis = turned * finger.tip.axis;
  state.jacobian.setZero(3, finger.drives);
  for (int i = 0; i < count; ++i) {
    const Joint& joint = finger.joints[i];
    state.jacobian.col(joint.drive) += joint.ratio * axes[i].cross(state.centre - origins[i]);
  }
  return state;
}

double MotionBound(const Finger& finger, const JointConfiguration& from,
                   const JointConfiguration& to, int after, const std::vector<double>& reach) {
  double bound = 0;
  for (int i = 0; i < after; ++i) {
    const Joint& joint = finger.joints[i];
    bound += std::abs(joint.ratio * (to[joint.drive] - from[joint.drive])) * reach[i];
  }
  return bound;
}

std::vector<double> LinkReach(const Finger& finger, const LinkShape& shape) {
  double farthest = 0;
  for (const Vector3d& point : shape.enclosing.points) {
    farthest = std::max(farthest, point.norm());
  }
  farthest += shape.enclosing.radius;
  std::vector<double> reach(shape.after);
  for (int i = shape.after - 1; i >= 0; --i) {
    reach[i] = farthest;
    farthest += finger.joints[i].offset.norm();
  }
  return reach;
}

double MaximumReach(const Finger& finger) {
  double reach = finger.tip.centre.norm() + finger.tip.radius;
  for (std::size_t i = 1; i < finger.joints.size(); ++i) reach += finger.joints[i].offset.norm();
  return reach;
}

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using Drives = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostJoints, 1>;

constexpr int kMostSamples = 12'000;
constexpr double kCell = 0.010;  // metres
/// Cost of a sample at one radian from the middle: the equivalent distance of its fingertip from
/// the target, metres.
constexpr double kConfigurationWeight = 0.004;
/// Tolerance of a sample beyond the approach limit, radians, because the solver rotates the
/// fingertip.
constexpr double kApproachSlack = 0.35;

constexpr int kIterations = 40;
/// The iteration stops if the distance exceeds kFarOff, metres, and was not halved in kPatience
/// iterations.
constexpr double kFarOff = 1e-4;
constexpr int kPatience = 6;
constexpr double kDamping = 1e-7;  // m²/rad²: limits the motion along singular directions
constexpr double kMostTurn = 0.4;  // largest rotation per iteration, radians
constexpr double kTowardsMiddle = 0.5;
/// Largest joint motion, radians, at which the secondary task has converged.
constexpr double kSettled = 2e-3;

/// Compute a step of damped least squares with joint centering as the secondary task.
/// Joints at a limit that they would exceed stay there.
struct Step {
  Drives step;
  double second_task = 0;  ///< largest joint motion that only serves the secondary task, radians
};

Step StepTo(const TipState& state, const Vector3d& error, const JointConfiguration& configuration,
            const Drives& to_middle, const JointConfiguration& lower,
            const JointConfiguration& upper) {
  auto jacobian = state.jacobian;
  Drives second = to_middle;
  Step result;
  for (int pass = 0; pass <= configuration.size(); ++pass) {
    const Matrix3d square = jacobian * jacobian.transpose() + kDamping * Matrix3d::Identity();
    const Matrix3d inverse = square.inverse();
    const Drives first = jacobian.transpose() * (inverse * error);
    const Drives null = second - jacobian.transpose() * (inverse * (jacobian * second));
    result.step = first + null;
    result.second_task = null.size() > 0 ? null.cwiseAbs().maxCoeff() : 0;
    bool changed = false;
    for (Eigen::Index i = 0; i < configuration.size(); ++i) {
      const bool beyond = (configuration[i] <= lower[i] && result.step[i] < 0) ||
                          (configuration[i] >= upper[i] && result.step[i] > 0);
      if (!beyond || jacobian.col(i).isZero(0)) continue;
      jacobian.col(i).setZero();
      second[i] = 0;
      changed = true;
    }
    if (!changed) break;
  }
  const double most = result.step.cwiseAbs().maxCoeff();
  if (most > kMostTurn) result.step *= kMostTurn / most;
  return result;
}

}  // namespace

InverseKinematics::InverseKinematics(const Finger& finger, const ConfigurationLimits& limits)
    : finger_(finger), limits_(limits), range_(finger.upper - finger.lower) {
  lower_ = finger.lower;
  upper_ = finger.upper;
  for (int i = 0; i < finger.drives; ++i) {
    const double inside = std::min(limits.from_limits, range_[i] / 2);
    lower_[i] += inside;
    upper_[i] -= inside;
  }
  middle_ = (lower_ + upper_) / 2;
  const int steps =
      std::max(2, static_cast<int>(std::floor(std::pow(kMostSamples, 1.0 / finger.drives) + 1e-9)));
  int count = 1;
  for (int i = 0; i < finger.drives; ++i) count *= steps;
  std::vector<JointConfiguration> configurations;
  std::vector<TipState> tips;
  Eigen::AlignedBox3d box;
  for (int index = 0; index < count; ++index) {
    JointConfiguration configuration(finger.drives);
    for (int i = 0, rest = index; i < finger.drives; ++i, rest /= steps) {
      configuration[i] = lower_[i] + (upper_[i] - lower_[i]) * (rest % steps + 0.5) / steps;
    }
    tips.push_back(TipAt(finger, configuration));
    configurations.push_back(std::move(configuration));
    box.extend(tips.back().centre);
  }
  corner_ = box.min();
  cells_ = (box.sizes() / kCell).array().floor().cast<int>() + 1;
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::vector<int> cell(count);
  for (int i = 0; i < count; ++i) cell[i] = CellOf(CellAt(tips[i].centre));
  std::ranges::stable_sort(order, {}, [&](int i) { return cell[i]; });
  first_of_cell_.assign(static_cast<std::size_t>(cells_.prod()) + 1, 0);
  for (const int i : order) ++first_of_cell_[cell[i] + 1];
  std::partial_sum(first_of_cell_.begin(), first_of_cell_.end(), first_of_cell_.begin());
  for (const int i : order) {
    samples_.push_back(configurations[i]);
    off_middle_.push_back(kConfigurationWeight * kConfigurationWeight *
                          (configurations[i] - middle_).squaredNorm());
    centres_.push_back(tips[i].centre);
    axes_.push_back(tips[i].axis);
  }
}

Vector3i InverseKinematics::CellAt(const Vector3d& point) const {
  const Vector3d cell = (point - corner_) / kCell;
  // Clamping prevents integer overflow for distant points.
  return cell.cwiseMax(-10)
      .cwiseMin(cells_.cast<double>() + Vector3d::Constant(10))
      .array()
      .floor()
      .cast<int>();
}

int InverseKinematics::CellOf(const Vector3i& cell) const {
  return (cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0];
}

int InverseKinematics::NearestSample(const TipTarget& target) const {
  const Vector3i at = CellAt(target.centre);
  const double least_cosine = std::cos(std::min(limits_.approach + kApproachSlack, 3.14));
  int best = -1;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int z = std::max(0, at[2] - 1); z <= std::min(cells_[2] - 1, at[2] + 1); ++z) {
    for (int y = std::max(0, at[1] - 1); y <= std::min(cells_[1] - 1, at[1] + 1); ++y) {
      const int left = std::max(0, at[0] - 1);
      const int right = std::min(cells_[0] - 1, at[0] + 1);
      if (left > right) continue;
      const int end = first_of_cell_[CellOf({right, y, z}) + 1];
      for (int i = first_of_cell_[CellOf({left, y, z})]; i < end; ++i) {
        if (axes_[i].dot(target.towards) < least_cosine) continue;
        const double cost = (centres_[i] - target.centre).squaredNorm() + off_middle_[i];
        if (cost >= best_cost) continue;
        best_cost = cost;
        best = i;
      }
    }
  }
  return best;
}

bool InverseKinematics::Fits(const TipTarget& target,
                             const JointConfiguration& configuration) const {
  return TipAt(finger_, configuration).axis.dot(target.towards) >= std::cos(limits_.approach);
}

std::optional<JointConfiguration> InverseKinematics::Solve(const TipTarget& target) const {
  const int sample = NearestSample(target);
  if (sample < 0) return std::nullopt;
  return SolveFrom(target, samples_[sample]);
}

std::optional<JointConfiguration> InverseKinematics::SolveFrom(
    const TipTarget& target, const JointConfiguration& start) const {
  return Iterate(target, start, true);
}

std::optional<JointConfiguration> InverseKinematics::SolveNear(
    const TipTarget& target, const JointConfiguration& start) const {
  return Iterate(target, start, false);
}

std::optional<JointConfiguration> InverseKinematics::Iterate(const TipTarget& target,
                                                             const JointConfiguration& start,
                                                             bool towards_middle) const {
  JointConfiguration configuration = start;
  bool settled = !towards_middle;
  double off_before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kIterations; ++i) {
    const TipState state = TipAt(finger_, configuration);
    const Vector3d error = target.centre - state.centre;
    if (i % kPatience == 0) {
      if (error.norm() > std::max(kFarOff, off_before / 2)) return std::nullopt;
      off_before = error.norm();
    }
    if (settled && error.norm() <= kTipTolerance) {
      return Fits(target, configuration) ? std::optional(configuration) : std::nullopt;
    }
    // In the last iterations joint centering is dropped so that the position converges.
    const bool to_middle = !settled && i < kIterations - 10;
    const Drives second = to_middle ? Drives(kTowardsMiddle * (middle_ - configuration))
                                    : Drives(Drives::Zero(configuration.size()));
    const Step step = StepTo(state, error, configuration, second, lower_, upper_);
    configuration = (configuration + step.step).cwiseMax(lower_).cwiseMin(upper_);
    if (!to_middle || step.second_task < kSettled) settled = true;
  }
  return std::nullopt;
}

}  // namespace regrasp::kinematics
