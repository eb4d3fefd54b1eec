#include "render/picture/caption.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/rotation.h"

namespace regrasp::render {

double RoundLength(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= limit) return digit * power;
  }
  return power;
}

std::string FingerLabel(FingerIndex finger, std::span<const std::string> names) {
  const auto index = static_cast<std::size_t>(static_cast<int>(finger));
  const bool named = index < names.size() && !names[index].empty();
  return named ? names[index] : std::to_string(finger);
}

std::string AngleText(double radians) {
  const double tenths = std::round(10 * Degrees(radians));
  const bool whole = std::fmod(tenths, 10) == 0;
  return FormatFixed(tenths == 0 ? 0 : tenths / 10, whole ? 0 : 1) + "°";
}

namespace {

/// Smallest rotation (radians) and translation (metres) that are reported. Smaller ones are
/// rounding errors.
constexpr double kMinRotation = 1e-4;
constexpr double kMinTranslation = 1e-5;
/// Significant digits of a length.
constexpr int kDigits = 2;

using Names = std::span<const std::string>;

std::string List(const std::vector<FingerIndex>& fingers, Names names) {
  std::string text;
  for (const FingerIndex finger : fingers)
    text += (text.empty() ? "" : ", ") + FingerLabel(finger, names);
  return text;
}

std::vector<FingerIndex> FingersOf(const plan::FingerGrasp& grasp) {
  std::vector<FingerIndex> fingers;
  for (const plan::FingerContact& contact : grasp) fingers.push_back(contact.finger);
  return fingers;
}

struct Travel {
  FingerIndex finger;
  double length;  ///< length of the polyline through the waypoints, object units
  int begin;      ///< index of the first waypoint with another position
};

/// Return the fingers whose last waypoint differs from their first, in the order in which they
/// start, then by number.
std::vector<Travel> MovedFingers(const plan::Align& align) {
  std::vector<Travel> moved;
  if (align.waypoints.empty()) return moved;
  for (const plan::FingerContact& first : align.waypoints.front()) {
    const plan::FingerContact* last = plan::FindFinger(align.waypoints.back(), first.finger);
    if (last == nullptr || first.contact.p == last->contact.p) continue;
    Travel travel = {first.finger, 0, 0};
    int index = 0;
    const plan::FingerContact* before = &first;
    for (const plan::FingerGrasp& waypoint : align.waypoints) {
      const plan::FingerContact* here = plan::FindFinger(waypoint, first.finger);
      ++index;
      if (here == nullptr) continue;
      travel.length += (here->contact.p - before->contact.p).norm();
      if (travel.begin == 0 && here->contact.p != first.contact.p) travel.begin = index;
      before = here;
    }
    moved.push_back(travel);
  }
  std::ranges::sort(moved, {}, [](const Travel& t) { return std::pair(t.begin, t.finger); });
  return moved;
}

std::string Describe(const plan::Switch& step, Names names) {
  std::string text = "switch:";
  if (!step.place.empty()) text += " place " + List(FingersOf(step.place), names);
  if (!step.release.empty()) {
    text += (step.place.empty() ? " release " : ", release ") + List(step.release, names);
  }
  return text;
}

std::string Describe(const plan::Align& step, Names names) {
  std::vector<FingerIndex> fingers;
  for (const Travel& travel : MovedFingers(step)) fingers.push_back(travel.finger);
  return fingers.empty() ? "align" : "align: move " + List(fingers, names);
}

/// Return "move: rotate the object by 38°", or "move: translate the object by 2.1 mm" if it does
/// not rotate, with a note if fingertips roll.
std::string Describe(const plan::Move& step, Names /*names*/) {
  if (step.path.empty()) return "move";
  const Eigen::Isometry3d& from = step.path.front().pose;
  const Eigen::Isometry3d& to = step.path.back().pose;
  const double angle = object::RotationInBody(from.linear(), to.linear()).angle();
  const std::string roll = step.contacts.empty() ? "" : ", fingertips roll";
  if (angle >= kMinRotation) {
    return "move: rotate the object by " + AngleText(angle) + roll;
  }
  const double translation = (to.translation() - from.translation()).norm();
  return translation < kMinTranslation
             ? "move: free fingers"
             : "move: translate the object by " + FormatLength(translation, kDigits) + roll;
}

/// Return the motion of the fingers, for example "move 1 by 12 mm, 3 by 0.8 mm together along the
/// surface".
///
/// Fingers that start later follow "then". Empty if no finger moves.
std::string DescribeTravel(const plan::Align& step, double scale, Names names) {
  const std::vector<Travel> moved = MovedFingers(step);
  if (moved.empty()) return "";
  std::string text;
  int before = moved.front().begin;
  for (const auto& [finger, length, begin] : moved) {
    text += text.empty() ? "move " : begin == before ? ", " : ", then ";
    text += FingerLabel(finger, names) + " by " + FormatLength(length * scale, kDigits);
    before = begin;
  }
  const bool together = moved.size() > 1 && moved.front().begin == moved.back().begin;
  return text + (together ? " together" : "") + " along the surface";
}

}  // namespace

std::string EntryTitle(const plan::Plan& plan, plan::EntryIndex entry, Names names) {
  if (entry == 0) {
    const std::vector<FingerIndex> fingers = FingersOf(plan.initial);
    const bool numbered = std::ranges::all_of(fingers, [&](FingerIndex finger) {
      return FingerLabel(finger, names) == std::to_string(finger);
    });
    return (numbered ? "hold: fingers " : "hold: ") + List(fingers, names);
  }
  return std::visit([names](const auto& kind) { return Describe(kind, names); },
                    plan::StepOf(plan, entry));
}

std::string FrameCaption(const plan::Plan& plan, plan::EntryIndex entry, Names names) {
  if (entry == 0) return EntryTitle(plan, entry, names);
  const std::string step =
      "step " + std::to_string(entry) + "/" + std::to_string(plan.steps.size());
  const auto* align = std::get_if<plan::Align>(&plan::StepOf(plan, entry));
  const std::string travel = align != nullptr ? DescribeTravel(*align, plan.scale, names) : "";
  return step + " · " + (travel.empty() ? EntryTitle(plan, entry, names) : "align: " + travel);
}

namespace {

using Eigen::Vector2d;

constexpr int kAngles = 24;
/// Distances from the anchor to the centre of the label, in label radii.
constexpr double kDistances[] = {1.15, 1.7, 2.4, 3.3, 4.5, 6, 8, 11};
constexpr double kDistanceCost = 0.35;  ///< cost per label radius of distance
constexpr double kAngleCost = 0.4;      ///< cost of the side opposite to the preferred one
constexpr double kOverlapCost = 6;      ///< cost of covering an obstacle by one label radius
constexpr double kOutsideCost = 100;
/// Least distance of a label's centre from the border, in label radii. Names are wider than the
/// circle of a label.
constexpr double kInsideMargin = 1.25;
constexpr double kWrongOwnerCost = 200;
/// Largest ratio of the distances to the own and to another owner that is free of cost.
constexpr double kClearlyNearer = 0.9;
constexpr double kUnclearOwnerCost = 2;
/// Weight of other labels as obstacles, and the factor by which they are enlarged.
constexpr double kLabelWeight = 2;
constexpr double kLabelMargin = 1.1;
constexpr int kRounds = 4;

double Cover(const Vector2d& centre, double radius, const Obstacle& obstacle) {
  const double gap = DistanceToSegment(centre, obstacle.a, obstacle.b) - obstacle.radius - radius;
  return gap < 0 ? -gap / radius * obstacle.weight : 0;
}

struct Layout {
  std::span<const LabelAnchor> anchors;
  std::span<const Obstacle> obstacles;
  double radius;
  int width, height;
  std::vector<Vector2d> centres;

  [[nodiscard]] double Cost(std::size_t label, const Vector2d& centre) const {
    double cost = 0;
    for (const Obstacle& obstacle : obstacles) {
      cost += kOverlapCost * Cover(centre, radius, obstacle);
    }
    for (std::size_t other = 0; other < centres.size(); ++other) {
      if (other == label) continue;
      const Obstacle taken = {centres[other], centres[other], radius * kLabelMargin, kLabelWeight};
      cost += kOverlapCost * Cover(centre, radius, taken);
    }
    const Vector2d& own = anchors[label].Owner();
    for (const LabelAnchor& other : anchors) {
      if (other.Owner() == own) continue;
      const double share = (centre - own).norm() / (centre - other.Owner()).norm();
      if (share >= 1) cost += kWrongOwnerCost;
      if (share > kClearlyNearer) cost += kUnclearOwnerCost;
    }
    const double margin = kInsideMargin * radius;
    const bool inside = centre.x() >= margin && centre.x() <= width - margin &&
                        centre.y() >= margin && centre.y() <= height - margin;
    return inside ? cost : cost + kOutsideCost;
  }

  [[nodiscard]] Vector2d BestPlace(std::size_t label) const {
    const LabelAnchor& wish = anchors[label];
    const double wanted = std::atan2(wish.direction.y(), wish.direction.x());
    Vector2d best = wish.anchor;
    double best_cost = std::numeric_limits<double>::infinity();
    for (const Vector2d& middle : {wish.anchor, wish.Owner()}) {
      for (const double distance : kDistances) {
        for (int i = 0; i < kAngles; ++i) {
          const double turn = 2 * std::numbers::pi * i / kAngles;
          const double angle = wanted + turn;
          const Vector2d centre =
              middle + distance * radius * Vector2d(std::cos(angle), std::sin(angle));
          const double cost = Cost(label, centre) + kDistanceCost * distance +
                              kAngleCost * (1 - std::cos(turn)) / 2;
          if (cost < best_cost) {
            best_cost = cost;
            best = centre;
          }
        }
      }
    }
    return best;
  }
};

}  // namespace

std::vector<Vector2d> PlaceLabels(std::span<const LabelAnchor> anchors,
                                  std::span<const Obstacle> obstacles, double label_radius,
                                  int width, int height) {
  Layout layout = {anchors, obstacles, label_radius, width, height, {}};
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    layout.centres.push_back(layout.BestPlace(i));
  }
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < anchors.size(); ++i) layout.centres[i] = layout.BestPlace(i);
  }
  return layout.centres;
}

}  // namespace regrasp::render
