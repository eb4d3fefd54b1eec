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

std::optional<std::vector<Stretch>> ChangePaths::Find(const Change& change, const Hold& from,
                                                      Hold& to, int node, const Rolled& rolled) {
  Keyframe frame = carrier_.FrameAt(from, node);
  std::vector<Stretch> stretches;
  const auto take = [&](std::optional<Stretch> stretch) {
    if (!stretch) return false;
    frame = stretch->path.back();
    stretches.push_back(*std::move(stretch));
    return true;
  };
  if (change.slid.valid() && !take(Slide(change, from.holding, node, frame))) return std::nullopt;
  if (change.placed.valid() && !take(Place(change, node, frame, rolled.before))) {
    return std::nullopt;
  }
  if (change.released.valid() &&
      !take(Release(change, from.holding[change.released], to, node, frame, rolled.after))) {
    return std::nullopt;
  }
  return stretches;
}

std::optional<Stretch> ChangePaths::Place(const Change& change, int node, const Keyframe& before,
                                          const RolledTips& rolled) {
  const FingerIndex finger = change.placed;
  const Posture touching = *carrier_.reach().Find(finger, change.point, node);
  Surroundings around = AllBut(setup_.scene, finger, before);
  AddRolled(setup_.scene, rolled, around);
  const auto path = FindPathToContact(
      setup_.scene, setup_.inverse[finger], finger, before.postures[finger],
      TargetAt(setup_.scene.finger(finger), setup_.points[change.point], before.pose), touching,
      around, random_);
  if (!path) return std::nullopt;
  Stretch stretch{Stretch::Kind::kPlace, finger, change.point, {}};
  for (const Posture& posture : *path) Append(before, finger, posture, stretch);
  return stretch;
}

/// To where the finger is to wait, or else no farther than above its contact.
std::optional<Stretch> ChangePaths::Release(const Change& change, int point, Hold& to, int node,
                                            const Keyframe& before, const RolledTips& rolled) {
  const FingerIndex finger = change.released;
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

std::optional<Stretch> ChangePaths::Slide(const Change& change, const Holding& from, int node,
                                          const Keyframe& before) {
  const FingerIndex finger = change.slid;
  std::vector<int> grasp = {from[finger]};
  for (FingerIndex other{0}; other < setup_.scene.finger_count(); ++other) {
    if (other != finger && from[other] != kNone) grasp.push_back(from[other]);
  }
  const auto slide =
      FindSlide(setup_, memory_, finger, grasp, *routes_.Between(from[finger], change.point),
                before.postures[finger], *carrier_.reach().Find(finger, change.point, node),
                AllBut(setup_.scene, finger, before));
  if (!slide) return std::nullopt;
  Stretch stretch{Stretch::Kind::kSlide, finger,          change.point, {before},
                  from[finger],          slide->contacts, {0}};
  for (const FingerPath& path : slide->paths) {
    for (std::size_t i = 1; i < path.size(); ++i) Append(before, finger, path[i], stretch);
    stretch.along_at.push_back(static_cast<int>(stretch.path.size()) - 1);
  }
  return stretch;
}

}  // namespace regrasp::gait
