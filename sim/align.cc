#include "sim/align.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/grasp/force_closure.h"
#include "sim/motions.h"
#include "sim/slide.h"

namespace regrasp {

using Eigen::Vector3d;

namespace {

/// Waypoints this close, over D, are one: the finger stays.
constexpr double kSamePoint = 1e-9;

bool Stays(const Contact& from, const Contact& to, double diameter) {
  return from.face == to.face && (from.p - to.p).norm() <= kSamePoint * diameter;
}

/// Where the spare finger touches while a finger goes over: the middle of the way, or the new face
/// where the finger turns at a border.
Contact StandIn(const Contact& from, const Contact& to) {
  if (from.face != to.face) return to;
  return {(from.p + to.p) / 2, to.n, to.face};
}

/// The fingers that move in this piece (places in its grasps), in groups that go over together.
std::vector<std::vector<std::size_t>> MovingGroups(const AlignPiece& piece, double diameter,
                                                   int size) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < piece.from.size(); ++i) {
    if (Stays(piece.from[i].contact, piece.to[i].contact, diameter)) continue;
    if (groups.empty() || static_cast<int>(groups.back().size()) >= size) groups.emplace_back();
    groups.back().push_back(i);
  }
  return groups;
}

bool CanGoOver(const AlignPiece& piece, const WrenchFrame& frame, double half_angle,
               int stand_ins) {
  Grasp grasp = ContactsOf(piece.from);
  for (const auto& group : MovingGroups(piece, 2 * frame.radius, stand_ins)) {
    if (stand_ins > 0) {
      for (const std::size_t i : group) grasp[i] = StandIn(grasp[i], piece.to[i].contact);
      if (!IsForceClosure(grasp, frame, half_angle)) return false;
    }
    for (const std::size_t i : group) grasp[i] = piece.to[i].contact;
    if (!IsForceClosure(grasp, frame, half_angle)) return false;
  }
  return true;
}

AlignPiece Between(const FingerGrasp& from, const FingerGrasp& to, double start, double end) {
  return {Interpolate(from, to, start), Interpolate(from, to, end)};
}

std::vector<AlignPiece> CutEvenly(const FingerGrasp& from, const FingerGrasp& to, int pieces) {
  std::vector<AlignPiece> cut;
  for (int i = 0; i < pieces; ++i) {
    cut.push_back(
        Between(from, to, static_cast<double>(i) / pieces, static_cast<double>(i + 1) / pieces));
  }
  return cut;
}

/// The fingers of `to` in the order of `from`.
FingerGrasp InOrderOf(const FingerGrasp& from, const FingerGrasp& to) {
  FingerGrasp ordered;
  for (const FingerContact& held : from) {
    const auto match = std::ranges::find(to, held.finger, &FingerContact::finger);
    ordered.push_back(match == to.end() ? held : *match);
  }
  return ordered;
}

std::vector<int> FindSpare(const Stage& stage) {
  std::vector<int> spare;
  for (std::size_t f = 0; f < stage.fingers().size(); ++f) {
    if (!stage.fingers()[f].holding) spare.push_back(static_cast<int>(f));
  }
  return spare;
}

void Imitate(Stage& stage, const AlignPiece& piece, const std::vector<int>& spare) {
  const double diameter = stage.settings().diameter_m;
  for (const auto& group : MovingGroups(piece, diameter, static_cast<int>(spare.size()))) {
    FingerGrasp stand_ins, targets;
    std::vector<int> fingers, substitutes;
    for (std::size_t k = 0; k < group.size(); ++k) {
      const FingerContact& from = piece.from[group[k]];
      const FingerContact& to = piece.to[group[k]];
      stand_ins.push_back({spare[k], StandIn(from.contact, to.contact)});
      targets.push_back({from.finger, to.contact});
      fingers.push_back(from.finger);
      substitutes.push_back(spare[k]);
    }
    SwitchFingers(stage, stand_ins, fingers);
    SwitchFingers(stage, targets, substitutes);
  }
}

/// The finger that the others balance best goes first.
void Slide(Stage& stage, const AlignPiece& piece) {
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < piece.from.size(); ++i) {
    const double diameter = stage.settings().diameter_m;
    if (!Stays(piece.from[i].contact, piece.to[i].contact, diameter)) waiting.push_back(i);
  }
  while (!waiting.empty()) {
    const auto next = std::ranges::max_element(waiting, {}, [&](std::size_t i) {
      return SlideMargin(stage, piece.from[i].finger, piece.from[i].contact, piece.to[i].contact);
    });
    SlideFinger(stage, piece.from[*next].finger, piece.from[*next].contact,
                piece.to[*next].contact);
    waiting.erase(next);
  }
}

/// What the frame of the step shows: who moved, and from where.
void TellRoles(Stage& stage, const FingerGrasp& start, const FingerGrasp& end) {
  for (StageFinger& finger : stage.fingers()) {
    finger.role = finger.holding ? FingerRole::kHolding : FingerRole::kFree;
  }
  for (std::size_t i = 0; i < start.size(); ++i) {
    StageFinger& finger = stage.fingers()[start[i].finger];
    finger.previous_B = start[i].contact.p;
    if (Stays(start[i].contact, end[i].contact, stage.settings().diameter_m)) continue;
    finger.role = FingerRole::kMoved;
  }
}

}  // namespace

FingerGrasp Interpolate(const FingerGrasp& from, const FingerGrasp& to, double share) {
  if (share >= 1) return to;
  FingerGrasp between = to;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Contact& a = from[i].contact;
    Contact& c = between[i].contact;
    c.p = (1 - share) * a.p + share * c.p;
    if (a.face == c.face) continue;
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(a.n, c.n);
    c.n = (Eigen::Quaterniond::Identity().slerp(share, turn) * a.n).normalized();
    c.face = a.face;
  }
  return between;
}

std::optional<std::vector<AlignPiece>> CutAlign(const FingerGrasp& from, const FingerGrasp& to,
                                                const WrenchFrame& frame, double half_angle,
                                                int stand_ins) {
  std::vector<AlignPiece> cut;
  double done = 0, length = 1;
  while (done < 1) {
    AlignPiece piece = Between(from, to, done, done + length);
    if (CanGoOver(piece, frame, half_angle, stand_ins)) {
      cut.push_back(std::move(piece));
      done += length;
      // As in a bisection: the next piece is as long as the way done allows.
      while (length < 1 && std::fmod(done, 2 * length) == 0 && done + 2 * length <= 1) length *= 2;
    } else {
      length /= 2;
      if (length < kShortestPiece) return std::nullopt;
    }
  }
  return cut;
}

AlignMode PerformAlign(Stage& stage, const Align& align_B) {
  AlignMode mode = AlignMode::kImitated;
  if (align_B.waypoints.empty()) return mode;
  const std::vector<int> spare = FindSpare(stage);
  const auto cut = [&](const FingerGrasp& from, const FingerGrasp& to, int stand_ins) {
    return CutAlign(from, to, stage.frame_B(), stage.half_angle(), stand_ins);
  };
  FingerGrasp from = align_B.waypoints.front();
  for (std::size_t j = 1; j < align_B.waypoints.size(); ++j) {
    const FingerGrasp to = InOrderOf(from, align_B.waypoints[j]);
    const auto pieces =
        spare.empty() ? std::nullopt : cut(from, to, static_cast<int>(spare.size()));
    if (pieces) {
      for (const AlignPiece& piece : *pieces) Imitate(stage, piece, spare);
    } else {
      mode = AlignMode::kSlid;
      const auto slides = cut(from, to, 0);
      for (const AlignPiece& piece : slides.value_or(CutEvenly(from, to, kHopelessPieces))) {
        Slide(stage, piece);
      }
    }
    from = to;
  }
  TellRoles(stage, align_B.waypoints.front(), from);
  return mode;
}

}  // namespace regrasp
