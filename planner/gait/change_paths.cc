#include "planner/gait/change_paths.h"

#include <utility>

#include "planner/gait/finger_path.h"

namespace regrasp::gait {
namespace {

/// One finger goes along a path, all else stays.
void Append(const Keyframe& before, FingerIndex finger, const Posture& posture, Stretch& stretch) {
  stretch.path.push_back(before);
  stretch.path.back().postures[finger] = posture;
}

}  // namespace

Change ChangeBetween(const Holding& from, const Holding& to) {
  Change change;
  for (FingerIndex finger{0}; finger < std::ssize(from); ++finger) {
    if (from[finger] == to[finger]) continue;
    if (from[finger] == kNone) {
      change.placed = finger;
    } else if (to[finger] == kNone) {
      change.released = finger;
    } else {
      change.slid.push_back(finger);
    }
  }
  return change;
}

std::optional<std::vector<Stretch>> ChangePaths::Find(const Hold& from, Hold& to, int node,
                                                      const Rolled& rolled) {
  const Change change = ChangeBetween(from.holding, to.holding);
  Keyframe frame = carrier_.FrameAt(from, node);
  std::vector<Stretch> stretches;
  const auto take = [&](std::optional<Stretch> stretch) {
    if (!stretch) return false;
    frame = stretch->path.back();
    stretches.push_back(*std::move(stretch));
    return true;
  };
  const auto& [placed, released, slid] = change;
  if (!slid.empty() && !take(Slide(slid, from.holding, to.holding, node, frame))) {
    return std::nullopt;
  }
  if (placed.valid() && !take(Place(placed, to.holding[placed], node, frame, rolled.before))) {
    return std::nullopt;
  }
  if (released.valid() &&
      !take(Release(released, from.holding[released], to, node, frame, rolled.after))) {
    return std::nullopt;
  }
  return stretches;
}

std::optional<Stretch> ChangePaths::Place(FingerIndex finger, int point, int node,
                                          const Keyframe& before, const RolledTips& rolled) {
  const Posture touching = *carrier_.reach().Find(finger, point, node);
  Surroundings around = AllBut(setup_.scene, finger, before);
  AddRolled(setup_.scene, rolled, around);
  const auto path =
      FindPathToContact(setup_.scene, setup_.inverse[finger], finger, before.postures[finger],
                        TargetAt(setup_.scene.finger(finger), setup_.points[point], before.pose),
                        touching, around, random_);
  if (!path) return std::nullopt;
  Stretch stretch{Stretch::Kind::kPlace, finger, point, {}};
  for (const Posture& posture : *path) Append(before, finger, posture, stretch);
  return stretch;
}

/// To where the finger is to wait, or else no farther than above its contact.
std::optional<Stretch> ChangePaths::Release(FingerIndex finger, int point, Hold& to, int node,
                                            const Keyframe& before, const RolledTips& rolled) {
  Surroundings around = AllBut(setup_.scene, finger, before);
  AddRolled(setup_.scene, rolled, around);
  const auto up =
      FindWayUp(setup_.scene, setup_.inverse[finger], finger,
                TargetAt(setup_.scene.finger(finger), setup_.points[point], before.pose),
                before.postures[finger], around);
  if (!up) return std::nullopt;
  const auto onward =
      FindFreePath(setup_.scene, finger, up->back(), to.waiting[finger], around, random_);
  FingerPath path = *up;
  if (onward) {
    path.insert(path.end(), onward->begin() + 1, onward->end());
  } else {
    to.waiting[finger] = up->back();
    if (!carrier_.IsPassable(to, node)) return std::nullopt;
  }
  Stretch stretch{Stretch::Kind::kRelease, finger, point, {}};
  for (const Posture& posture : path) Append(before, finger, posture, stretch);
  return stretch;
}

std::optional<Stretch> ChangePaths::Slide(const std::vector<FingerIndex>& slid, const Holding& from,
                                          const Holding& to, int node, const Keyframe& before) {
  Stretch stretch{Stretch::Kind::kSlide, {}, kNone, {before}};
  std::vector<Sliding> fingers;
  for (const FingerIndex finger : slid) {
    stretch.slid.push_back({finger, from[finger], to[finger]});
    fingers.push_back({finger, routes_.Between(from[finger], to[finger]),
                       carrier_.reach().Find(finger, to[finger], node)});
  }
  auto slide = FindSlide(setup_, memory_, fingers, from, before);
  if (!slide) return std::nullopt;
  stretch.along = std::move(slide->along);
  stretch.along_at = {0};
  for (const std::vector<Keyframe>& path : slide->paths) {
    stretch.path.insert(stretch.path.end(), path.begin() + 1, path.end());
    stretch.along_at.push_back(static_cast<int>(stretch.path.size()) - 1);
  }
  return stretch;
}

}  // namespace regrasp::gait
