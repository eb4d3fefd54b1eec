#include "planner/gait/fewer_moves.h"

#include <utility>

#include "planner/gait/move_path.h"

namespace regrasp::gait {
namespace {

bool IsSameKeyframe(const Keyframe& a, const Keyframe& b) {
  return a.pose.matrix() == b.pose.matrix() && a.postures == b.postures;
}

}  // namespace

Gait WithFewerMoves(const HandSetup& setup, const Gait& gait) {
  using enum Stretch::Kind;
  Gait fewer{gait.initial, gait.start, {}};
  for (std::size_t i = 0; i < gait.stretches.size(); ++i) {
    if (gait.stretches[i].kind != kMove) {
      fewer.stretches.push_back(gait.stretches[i]);
      continue;
    }
    Stretch move = gait.stretches[i];
    for (; i + 1 < gait.stretches.size() && gait.stretches[i + 1].kind == kMove; ++i) {
      const std::vector<Keyframe>& more = gait.stretches[i + 1].path;
      move.path.insert(move.path.end(), more.begin() + 1, more.end());
    }
    if (setup.rolled_on == nullptr) {
      if (IsSameKeyframe(move.path.front(), move.path.back())) continue;
      auto straight = FindMove(setup, HoldingAtEnd(fewer), move.path.front(), move.path.back());
      if (straight) move.path = *std::move(straight);
    }
    fewer.stretches.push_back(std::move(move));
  }
  return fewer;
}

}  // namespace regrasp::gait
