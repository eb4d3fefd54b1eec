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

bool CanGoOver(const AlignPiece& piece, const WrenchFrame& frame, double half_angle, GoOver how) {
  Grasp grasp = ContactsOf(piece.from);
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    const Contact& to = piece.to[i].contact;
    if (Stays(grasp[i], to, 2 * frame.radius)) continue;
    if (how == GoOver::kByStandIn) {
      grasp[i] = StandIn(grasp[i], to);
      if (!IsForceClosure(grasp, frame, half_angle)) return false;
    }
    grasp[i] = to;
    if (!IsForceClosure(grasp, frame, half_angle)) return false;
  }
  return true;
}

std::vector<AlignPiece> CutEvenly(const FingerGrasp& from, const FingerGrasp& to, int pieces) {
  std::vector<AlignPiece> cut;
  for (int i = 0; i < pieces; ++i) {
    cut.push_back({Interpolate(from, to, static_cast<double>(i) / pieces),
                   Interpolate(from, to, static_cast<double>(i + 1) / pieces)});
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

std::optional<int> FindSpare(const Stage& stage) {
  for (std::size_t f = 0; f < stage.fingers().size(); ++f) {
    if (!stage.fingers()[f].holding) return static_cast<int>(f);
  }
  return std::nullopt;
}

void Imitate(Stage& stage, const AlignPiece& piece, int spare) {
  const double diameter = stage.settings().diameter_m;
  for (std::size_t i = 0; i < piece.from.size(); ++i) {
    const Contact& from = piece.from[i].contact;
    const Contact& to = piece.to[i].contact;
    if (Stays(from, to, diameter)) continue;
    const int finger = piece.from[i].finger;
    SwitchFingers(stage, {{spare, StandIn(from, to)}}, {finger});
    SwitchFingers(stage, {{finger, to}}, {spare});
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
                                                GoOver how) {
  for (int pieces = 1; pieces <= kMostPieces; pieces *= 2) {
    std::vector<AlignPiece> cut = CutEvenly(from, to, pieces);
    const bool serves = std::ranges::all_of(
        cut, [&](const AlignPiece& piece) { return CanGoOver(piece, frame, half_angle, how); });
    if (serves) return cut;
  }
  return std::nullopt;
}

AlignMode PerformAlign(Stage& stage, const Align& align_B) {
  AlignMode mode = AlignMode::kImitated;
  if (align_B.waypoints.empty()) return mode;
  const std::optional<int> spare = FindSpare(stage);
  const auto cut = [&](const FingerGrasp& from, const FingerGrasp& to, GoOver how) {
    return CutAlign(from, to, stage.frame_B(), stage.half_angle(), how);
  };
  FingerGrasp from = align_B.waypoints.front();
  for (std::size_t j = 1; j < align_B.waypoints.size(); ++j) {
    const FingerGrasp to = InOrderOf(from, align_B.waypoints[j]);
    const auto pieces = spare ? cut(from, to, GoOver::kByStandIn) : std::nullopt;
    if (pieces) {
      for (const AlignPiece& piece : *pieces) Imitate(stage, piece, *spare);
    } else {
      mode = AlignMode::kSlid;
      const auto slides = cut(from, to, GoOver::kBySliding);
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
