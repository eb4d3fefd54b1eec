#include "planner/tree/grasp_path.h"

#include <algorithm>
#include <cassert>

namespace regrasp::tree {

FaceAlign Reversed(FaceAlign align) {
  for (auto& [from, to] : align.contacts) std::swap(from, to);
  std::reverse(align.between.begin(), align.between.end());
  std::reverse(align.proof.begin(), align.proof.end());
  for (motion::MotionSegments& pieces : align.proof) {
    std::reverse(pieces.begin(), pieces.end());
    for (motion::MotionSegment& piece : pieces) {
      std::swap(piece.start, piece.end);
      std::swap(piece.from, piece.to);
      piece.from = 1 - piece.from;
      piece.to = 1 - piece.to;
    }
  }
  return align;
}

GraspPath Reversed(const GraspPath& path) {
  GraspPath reversed{path.end(), {}};
  for (auto step = path.steps.rbegin(); step != path.steps.rend(); ++step) {
    const auto before = std::next(step);
    PathStep back{before == path.steps.rend() ? path.start : before->to, std::nullopt};
    if (step->align) back.align = Reversed(*step->align);
    reversed.steps.push_back(std::move(back));
  }
  return reversed;
}

void Append(const GraspPath& more, GraspPath& path) {
  assert(more.start == path.end());
  path.steps.insert(path.steps.end(), more.steps.begin(), more.steps.end());
}

}  // namespace regrasp::tree
