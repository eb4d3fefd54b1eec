#include "planner/gait/explain_gait.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "planner/base/angle.h"
#include "planner/base/number.h"

namespace regrasp::gait {
namespace {

/// Of what the request may expand, the share of one try: all together take as long as a search that
/// finds nothing; and no fewer.
constexpr std::int64_t kShareOfTry = 20;
constexpr std::int64_t kFewestExpanded = 40;

/// Something that can be otherwise, and by how much, the least first.
struct Relaxation {
  std::string vain;  ///< "more friction"
  std::vector<double> changes;
  /// Changes the request. @returns in words.
  std::function<std::string(double, GaitRequest&)> change;
  std::string helps = {};  ///< the least change that does, in words
};

Relaxation MoreFriction() {
  return {"more friction", {1.1, 1.2, 1.5, 2}, [](double factor, GaitRequest& request) {
            const double before = std::tan(request.criteria.half_angle);
            request.criteria.half_angle = std::atan(factor * before);
            return "a friction of " + FormatShort(factor * before, 3) + " instead of " +
                   FormatShort(before, 3);
          }};
}

/// Contacts that are given grow with the object, poses stay.
Relaxation OtherSize() {
  return {"another size of the object",
          {0.9, 1.1, 0.8, 1.25, 0.65, 1.5, 0.5, 2},
          [](double factor, GaitRequest& request) {
            request.scale *= factor;
            return "the object " + FormatShort(factor, 3) + " times as large (--scale " +
                   FormatShort(request.scale, 4) + ")";
          }};
}

/// The palm tilted about an axis of the hand, `hand` being a place for it.
Relaxation TiltedPalm(kinematics::HandModel& hand) {
  return {"a tilt of the palm",
          {15, -15, 30, -30, 45, -45},
          [&hand](double degrees, GaitRequest& request) {
            hand = *request.hand;
            Eigen::Index least = 0;
            hand.up.cwiseAbs().minCoeff(&least);
            const Eigen::Vector3d axis =
                hand.up.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(least))).normalized();
            hand.up = Eigen::AngleAxisd(Radians(degrees), axis) * hand.up;
            request.hand = &hand;
            return "the palm tilted by " + FormatShort(std::abs(degrees), 3) +
                   " degrees (\"up\" of the hand file: " + FormatShort(hand.up.x(), 3) + ", " +
                   FormatShort(hand.up.y(), 3) + ", " + FormatShort(hand.up.z(), 3) + ")";
          }};
}

/// One of many tries, which looks at fewer rests. Nothing is asked of motors that don't stop it.
GaitRequest TryOf(const GaitRequest& request, bool with_motors) {
  GaitRequest tried = request;
  if (!with_motors) tried.reserve = Reserve::kNone;
  tried.most_expanded = std::min(request.most_expanded,
                                 std::max(kFewestExpanded, request.most_expanded / kShareOfTry));
  return tried;
}

bool AreMotorsInTheWay(const GaitRequest& request) {
  if (request.reserve != Reserve::kRequired) return false;
  request.progress("trying without the hand's motors");
  return FindGait(TryOf(request, false)).gait.has_value();
}

}  // namespace

std::string ExplainGait(const GaitRequest& request) {
  const bool with_motors = AreMotorsInTheWay(request);
  kinematics::HandModel tilted;
  std::vector<Relaxation> kinds = {MoreFriction(), OtherSize()};
  const bool is_upright = !request.start_pose && !request.goal_pose &&
                          request.start_grasp.empty() && request.goal_grasp.empty();
  if (is_upright) kinds.push_back(TiltedPalm(tilted));
  // The least of each kind first: time is for all alike.
  const auto most =
      std::ranges::max(kinds, {}, [](const Relaxation& kind) { return kind.changes.size(); });
  for (std::size_t i = 0; i < most.changes.size(); ++i) {
    for (Relaxation& kind : kinds) {
      if (i >= kind.changes.size() || !kind.helps.empty()) continue;
      GaitRequest changed = TryOf(request, with_motors);
      const std::string words = kind.change(kind.changes[i], changed);
      changed.progress = [&](std::string_view) { request.progress("trying " + words); };
      if (FindGait(changed).gait) kind.helps = words;
    }
  }
  std::string helps;
  std::string vain;
  for (const Relaxation& kind : kinds) {
    if (!kind.helps.empty()) helps += (helps.empty() ? "" : "; ") + kind.helps;
    if (kind.helps.empty()) vain += (vain.empty() ? "" : ", ") + kind.vain;
  }
  std::string text;
  if (!helps.empty()) text = "would do, each alone: " + helps;
  if (!vain.empty()) {
    if (!text.empty()) text += "; ";
    text += "not found to help: " + vain;
  }
  if (request.deadline.IsOver()) text += " (the time limit ended the tries)";
  return text;
}

}  // namespace regrasp::gait
