#include "planner/gait/slide_path.h"

#include <algorithm>
#include <cmath>

#include "planner/gait/certified_path.h"
#include "planner/gait/move_path.h"
#include "planner/gait/reach_map.h"
#include "planner/motion/contact_motion.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/tree/surface_route.h"

namespace regrasp::gait {
namespace {

/// Shares that the way between two contacts is cut into: the fewest, of how far the tip goes in
/// one, metres, and the most.
constexpr double kStride = 0.004;
constexpr int kMostShares = 64;
/// A motion that needs shorter pieces of a proof keeps too close to the limit.
constexpr double kShortestPiece = 1.0 / 64;
/// Faces of a fine mesh that a slide goes over, and the turn of the normal, radians, at edges
/// between them that are concave: a tip of 10 mm is in the surface by kTipDepth there. Whether
/// this one is, by no more, is looked at where it slides.
constexpr int kMostCrossings = 6;
constexpr double kConcave = 0.2;

/// One finger on its way, all else stands still.
class Slider {
 public:
  Slider(const HandSetup& setup, FingerIndex finger, const Surroundings& around)
      : setup_(setup), finger_(finger), around_(around) {}

  /// From a posture at a motion's first contact on.
  [[nodiscard]] std::optional<FingerPath> Follow(const motion::ContactMotion& motion,
                                                 const Posture& from, const Posture* end) const {
    const double radius = setup_.scene.finger(finger_).tip.radius;
    const double length = setup_.scale * motion.velocity().norm() + radius * motion.turn();
    for (int shares = std::max(1, static_cast<int>(std::ceil(length / kStride)));
         shares <= kMostShares; shares *= 2) {
      std::optional<FingerPath> path = InShares(motion, from, shares);
      if (!path) return std::nullopt;
      if (end != nullptr) {
        if ((path->back() - *end).cwiseAbs().maxCoeff() > kSameBranch) return std::nullopt;
        path->back() = *end;
      }
      if (StaysOn(motion, *path)) return IsFree(*path) ? path : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] kinematics::TipTarget TargetOf(const grasp::Contact& contact) const {
    return TargetAt(setup_.scene.finger(finger_), {setup_.scale * contact.p, contact.n},
                    around_.pose);
  }
  [[nodiscard]] std::optional<FingerPath> InShares(const motion::ContactMotion& motion,
                                                   const Posture& from, int shares) const {
    FingerPath path = {from};
    for (int i = 1; i <= shares; ++i) {
      const grasp::Contact contact = i == shares ? motion.to() : motion.At(double(i) / shares);
      const auto next = setup_.inverse[finger_].SolveFrom(TargetOf(contact), path.back());
      if (!next) return std::nullopt;
      path.push_back(*next);
    }
    return path;
  }
  /// Half-way between postures too.
  [[nodiscard]] bool StaysOn(const motion::ContactMotion& motion, const FingerPath& path) const {
    const auto shares = static_cast<double>(path.size() - 1);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Posture middle = (path[i] + path[i + 1]) / 2;
      const kinematics::TipTarget target =
          TargetOf(motion.At((static_cast<double>(i) + 0.5) / shares));
      const auto tip = kinematics::TipAt(setup_.scene.finger(finger_), middle);
      if ((tip.centre - target.centre).norm() > kTipOff) return false;
    }
    return true;
  }
  [[nodiscard]] bool IsFree(const FingerPath& path) const {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      if (!IsClear(setup_.scene, finger_, path[i], path[i + 1], around_.pose, TipContact::kTouching,
                   around_.others)) {
        return false;
      }
    }
    return true;
  }

  const HandSetup& setup_;
  FingerIndex finger_;
  const Surroundings& around_;
};

bool IsSame(const grasp::Contact& a, const grasp::Contact& b) {
  return a.p == b.p && a.face == b.face;
}

}  // namespace

const tree::SurfaceRoute* SlideRoutes::Between(int from, int to) {
  const auto [found, is_new] = known_.try_emplace({from, to});
  if (is_new) {
    found->second = tree::FindSurfaceRoute(memory_.object(), memory_.contact(from),
                                           memory_.contact(to), {kMostCrossings, kConcave});
  }
  return found->second ? &*found->second : nullptr;
}

std::optional<Slide> FindSlide(const HandSetup& setup, const criteria::GraspMemory& memory,
                               FingerIndex finger, const std::vector<int>& grasp,
                               const tree::SurfaceRoute& route, const Posture& from,
                               const Posture& end, const Surroundings& around) {
  Slide slide{{route.front()}, {}};
  const Slider slider(setup, finger, around);
  Posture at = from;
  for (const grasp::Contact& contact : route) {
    if (IsSame(slide.contacts.back(), contact)) continue;
    motion::GraspMotion motion = {{slide.contacts.back(), contact}};
    for (std::size_t i = 1; i < grasp.size(); ++i) {
      motion.emplace_back(memory.contact(grasp[i]), memory.contact(grasp[i]));
    }
    if (!motion::FindMotionProof(motion, memory.dimension(), memory.half_angle(), kShortestPiece)) {
      return std::nullopt;
    }
    std::optional<FingerPath> path =
        slider.Follow(motion.front(), at, &contact == &route.back() ? &end : nullptr);
    if (!path) return std::nullopt;
    at = path->back();
    slide.contacts.push_back(contact);
    slide.paths.push_back(*std::move(path));
  }
  return slide;
}

}  // namespace regrasp::gait
