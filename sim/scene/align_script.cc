#include "sim/scene/align_script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "planner/criteria/clearance.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "sim/scene/align_path.h"

namespace regrasp {

namespace {

/// Contacts this close, over D, are one: the finger stays.
constexpr double kSamePoint = 1e-9;

/// Where on its finger's way a stand-in touches, as far as it can: in the middle, so that it is far
/// from both ends; at last at the target itself.
constexpr std::array kSupportShares = {0.5, 0.375, 0.625, 0.25, 0.75, 0.125, 0.875, 1.0};

/// Where a piece holds only at the full friction, this much of it is gone: what a mixture has to
/// spare falls about evenly with the length.
constexpr std::array kShorter = {0.5, 0.4, 0.6, 0.3, 0.7};

/// A piece is lengthened by halving the last share of the way so often.
constexpr int kRefinements = 4;

/// A sliding finger needs room all along its way; looked for at so many places of a piece.
constexpr int kRoomSamples = 4;

/// What is asked of a piece.
struct Demand {
  double half_angle;
  double clearance;  ///< 0: none
  bool may_turn;     ///< fingers may rest between the normals of two faces
};

struct Piece {
  double end = 0;
  std::vector<AlignMove> moves;
  bool slides = false;
};

class ScriptWriter {
 public:
  ScriptWriter(const Object& object, const Align& align, const AlignLimits& limits)
      : object_(object), limits_(limits), frame_(object.wrench_frame()), path_(align) {}

  AlignScript Write() {
    AlignScript script;
    double at = 0;
    while (at < path_.end()) {
      if (std::optional<Piece> piece = ChoosePiece(at)) {
        std::ranges::move(piece->moves, std::back_inserter(script.moves));
        (piece->slides ? script.shares.slid : script.shares.imitated) += Share(at, piece->end);
        at = piece->end;
        continue;
      }
      const double next = std::floor(at) + 1;
      if (limits_.spare.empty()) {
        script.moves.emplace_back(FingersRoll{path_.At(at), path_.At(next)});
      } else {
        AddSlides(at, next, script);
      }
      script.shares.best_effort += Share(at, next);
      at = next;
    }
    return script;
  }

 private:
  using Places = std::vector<std::size_t>;

  [[nodiscard]] double Share(double from, double to) const {
    const double all = path_.Travel(0, path_.end());
    return all > 0 ? path_.Travel(from, to) / all : (to - from) / path_.end();
  }

  [[nodiscard]] bool Holds(const Grasp& grasp, double half_angle) const {
    return IsForceClosure(grasp, frame_, half_angle);
  }
  [[nodiscard]] bool HoldsAt(double t) const {
    return Holds(ContactsOf(path_.At(t)), limits_.half_angle);
  }

  /// The contacts that differ between two grasps of the way.
  [[nodiscard]] Places FindMoving(const FingerGrasp& from, const FingerGrasp& to) const {
    Places moving;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const Contact &a = from[k].contact, &b = to[k].contact;
      const bool stays = a.face == b.face && (a.p - b.p).norm() <= kSamePoint * object_.diameter();
      if (!stays) moving.push_back(k);
    }
    return moving;
  }

  [[nodiscard]] bool CanRest(const Places& places, double t, const Demand& demand) const {
    const FingerGrasp grasp = path_.At(t);
    return std::ranges::all_of(places, [&](std::size_t k) {
      if (path_.IsTurning(k, t) && !demand.may_turn) return false;
      return demand.clearance == 0 ||
             ComputeClearance(object_, grasp[k].contact, demand.clearance) >= demand.clearance;
    });
  }

  /// Lets the contacts of `group` in `grasp` go over to where they are at `end`.
  [[nodiscard]] std::optional<FingerHandover> HandOver(double begin, double end,
                                                       const Places& group, const Demand& demand,
                                                       Grasp& grasp) const {
    const FingerGrasp to = path_.At(end);
    Grasp after = grasp;
    for (const std::size_t k : group) after[k] = to[k].contact;
    if (!Holds(after, demand.half_angle)) return std::nullopt;
    for (const double share : kSupportShares) {
      const double t = share < 1 ? begin + share * (end - begin) : end;
      const FingerGrasp between = path_.At(t);
      Grasp meanwhile = grasp;
      for (const std::size_t k : group) meanwhile[k] = between[k].contact;
      if (!Holds(meanwhile, demand.half_angle) || !CanRest(group, t, demand)) continue;
      FingerHandover move;
      for (std::size_t i = 0; i < group.size(); ++i) {
        move.stand_ins.push_back({limits_.spare[i], between[group[i]].contact});
        move.targets.push_back(to[group[i]]);
      }
      grasp = std::move(after);
      return move;
    }
    return std::nullopt;
  }

  /// All moving contacts go over, in this order, as many at once as there are spare fingers.
  [[nodiscard]] std::optional<std::vector<AlignMove>> HandOverInOrder(double begin, double end,
                                                                      const Places& order,
                                                                      const Demand& demand) const {
    std::vector<AlignMove> moves;
    Grasp grasp = ContactsOf(path_.At(begin));
    for (std::size_t first = 0; first < order.size(); first += limits_.spare.size()) {
      const std::size_t last = std::min(first + limits_.spare.size(), order.size());
      const Places group(order.begin() + first, order.begin() + last);
      std::optional<FingerHandover> move = HandOver(begin, end, group, demand, grasp);
      if (!move) return std::nullopt;
      moves.emplace_back(*std::move(move));
    }
    return moves;
  }

  [[nodiscard]] std::optional<Piece> TryPiece(double begin, double end,
                                              const Demand& demand) const {
    Places order = FindMoving(path_.At(begin), path_.At(end));
    std::optional<std::vector<AlignMove>> moves;
    for (std::size_t turn = 0; turn < std::max<std::size_t>(order.size(), 1) && !moves; ++turn) {
      moves = HandOverInOrder(begin, end, order, demand);
      if (!order.empty()) std::ranges::rotate(order, order.begin() + 1);
    }
    if (!moves || !CanRest(order, end, demand)) return std::nullopt;
    return Piece{end, *std::move(moves)};
  }

  /// How far the way from `begin` on is force closure, in steps of a share of the way.
  [[nodiscard]] int FindReach(double begin) const {
    int reach = static_cast<int>(std::floor(begin * kSharesOfPath));
    while (reach < path_.end() * kSharesOfPath && HoldsAt(Place(reach + 1))) ++reach;
    return reach;
  }

  [[nodiscard]] static double Place(int steps) {
    return static_cast<double>(steps) / kSharesOfPath;
  }

  /// The longest piece that is found from `begin` up to a number of steps.
  [[nodiscard]] std::optional<Piece> FindLongest(double begin, int reach,
                                                 const Demand& demand) const {
    const int first = static_cast<int>(std::floor(begin * kSharesOfPath)) + 1;
    for (int steps = reach; steps >= first; --steps) {
      std::optional<Piece> piece = TryPiece(begin, Place(steps), demand);
      if (!piece) continue;
      if (steps < reach) Lengthen(begin, Place(steps + 1), demand, *piece);
      return piece;
    }
    for (double end = (begin + Place(first)) / 2; end - begin >= kShortestAlignPiece;
         end = (begin + end) / 2) {
      if (std::optional<Piece> piece = TryPiece(begin, end, demand)) return piece;
    }
    return std::nullopt;
  }

  void Lengthen(double begin, double limit, const Demand& demand, Piece& piece) const {
    for (int i = 0; i < kRefinements; ++i) {
      const double end = (piece.end + limit) / 2;
      if (std::optional<Piece> longer = TryPiece(begin, end, demand)) {
        piece = *std::move(longer);
      } else {
        limit = end;
      }
    }
  }

  /// The finger `k` may slide: the other contacts hold the object without it, with something to
  /// spare.
  [[nodiscard]] bool OthersHold(const Grasp& grasp, std::size_t k) const {
    Grasp others = grasp;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const double half_angle = std::atan(kSlideFriction * std::tan(limits_.half_angle));
    return QualityAtLeast(others, frame_, half_angle, kSlideQuality);
  }

  /// An order in which the contacts `left` of `grasps.back()` can slide to where they are in `to`;
  /// the grasps on the way are added.
  [[nodiscard]] bool OrderSlides(const FingerGrasp& to, const Places& left,
                                 std::vector<FingerGrasp>& grasps) const {
    if (left.empty()) return true;
    for (const std::size_t k : left) {
      if (!OthersHold(ContactsOf(grasps.back()), k)) continue;
      Places rest = left;
      std::erase(rest, k);
      grasps.push_back(grasps.back());
      grasps.back()[k] = to[k];
      if (OrderSlides(to, rest, grasps)) return true;
      grasps.pop_back();
    }
    return false;
  }

  [[nodiscard]] bool HasRoom(const Places& moving, double begin, double end) const {
    for (int i = 1; i <= kRoomSamples; ++i) {
      const double t = i < kRoomSamples ? begin + (end - begin) * i / kRoomSamples : end;
      const bool rests = i == kRoomSamples;
      if (!CanRest(moving, t, {limits_.half_angle, limits_.clearance, !rests})) return false;
    }
    return true;
  }

  [[nodiscard]] bool IsTurning(double t) const {
    for (std::size_t k = 0; k < path_.At(t).size(); ++k) {
      if (path_.IsTurning(k, t)) return true;
    }
    return false;
  }

  [[nodiscard]] std::optional<Piece> TrySlide(double begin, double end) const {
    if (IsTurning(begin) || IsTurning(end)) return std::nullopt;
    const FingerGrasp to = path_.At(end);
    const Places moving = FindMoving(path_.At(begin), to);
    if (moving.empty() || !HasRoom(moving, begin, end)) return std::nullopt;
    FingersSlide slide{{path_.At(begin)}};
    if (!OrderSlides(to, moving, slide.grasps)) return std::nullopt;
    Piece piece{end, {}, true};
    piece.moves.emplace_back(std::move(slide));
    return piece;
  }

  /// The longest slide from `begin` on that is found.
  [[nodiscard]] std::optional<Piece> FindSlide(double begin, int reach) const {
    const int first = static_cast<int>(std::floor(begin * kSharesOfPath)) + 1;
    const int waypoint = (static_cast<int>(std::floor(begin)) + 1) * kSharesOfPath;
    for (int steps = std::min(reach, waypoint); steps >= first; --steps) {
      if (std::optional<Piece> piece = TrySlide(begin, Place(steps))) return piece;
    }
    return std::nullopt;
  }

  /// The first place after `begin`, up to `reach`, from which fingers can slide; `reach` if none.
  [[nodiscard]] int FindNextSlide(double begin, int reach) const {
    const int first = static_cast<int>(std::floor(begin * kSharesOfPath)) + 1;
    for (int steps = first; steps < reach; ++steps) {
      if (TrySlide(Place(steps), Place(steps + 1))) return steps;
    }
    return reach;
  }

  [[nodiscard]] std::optional<Piece> ChoosePiece(double begin) const {
    int reach = FindReach(begin);
    if (limits_.slide || limits_.spare.empty()) {
      if (std::optional<Piece> slide = FindSlide(begin, reach)) return slide;
    }
    if (limits_.spare.empty()) return std::nullopt;
    if (limits_.slide) reach = FindNextSlide(begin, reach);
    return ChooseGoingOver(begin, reach);
  }

  [[nodiscard]] std::optional<Piece> ChooseGoingOver(double begin, int reach) const {
    const double full = limits_.half_angle;
    std::optional<Piece> longest = FindLongest(begin, reach, {full, limits_.clearance, false});
    if (longest) return MakeEasier(begin, reach, *std::move(longest));
    for (const Demand& demand : {Demand{full, limits_.least_clearance, false},
                                 {full, limits_.least_clearance, true},
                                 {full, 0, true}}) {
      longest = FindLongest(begin, reach, demand);
      if (longest) break;
    }
    return longest;
  }

  /// A shorter piece in place of the longest one, whose mixtures may be at the very limit.
  [[nodiscard]] Piece MakeEasier(double begin, int reach, Piece longest) const {
    const double length = longest.end - begin;
    for (const double share : kEasyFriction) {
      const double easy = std::atan(share * std::tan(limits_.half_angle));
      std::optional<Piece> easier = FindLongest(begin, reach, {easy, limits_.clearance, false});
      if (easier && 2 * (easier->end - begin) >= length) return *std::move(easier);
    }
    for (const double share : kShorter) {
      if (share * length < kShortestAlignPiece) break;
      const Demand demand{limits_.half_angle, limits_.clearance, false};
      std::optional<Piece> shorter = TryPiece(begin, begin + share * length, demand);
      if (shorter) return *std::move(shorter);
    }
    return longest;
  }

  [[nodiscard]] bool CanSlide(double begin, double end) const {
    const FingerGrasp to = path_.At(end);
    Grasp grasp = ContactsOf(path_.At(begin));
    return std::ranges::all_of(FindMoving(path_.At(begin), to), [&](std::size_t k) {
      grasp[k] = to[k].contact;
      return Holds(grasp, limits_.half_angle);
    });
  }

  /// By bisection: a piece is as long as the way done before it allows.
  [[nodiscard]] std::optional<std::vector<double>> CutSlides(double begin, double end) const {
    std::vector<double> cuts;
    double done = 0, length = 1;
    const auto at = [&](double share) { return share < 1 ? begin + share * (end - begin) : end; };
    while (done < 1) {
      if (CanSlide(at(done), at(done + length))) {
        done += length;
        cuts.push_back(at(done));
        while (length < 1 && std::fmod(done, 2 * length) == 0 && done + 2 * length <= 1) {
          length *= 2;
        }
      } else {
        length /= 2;
        if (length < kShortestAlignPiece) return std::nullopt;
      }
    }
    return cuts;
  }

  void AddSlides(double begin, double end, AlignScript& script) const {
    std::optional<std::vector<double>> cuts = CutSlides(begin, end);
    if (!cuts) {
      cuts.emplace();
      for (int i = 1; i < kHopelessPieces; ++i) {
        cuts->push_back(begin + (end - begin) * i / kHopelessPieces);
      }
      cuts->push_back(end);
    }
    FingersSlide slide{{path_.At(begin)}};
    for (const double cut : *cuts) slide.grasps.push_back(path_.At(cut));
    script.moves.emplace_back(std::move(slide));
  }

  const Object& object_;
  const AlignLimits& limits_;
  WrenchFrame frame_;
  AlignPath path_;
};

}  // namespace

AlignScript WriteAlignScript(const Object& object, const Align& align, const AlignLimits& limits) {
  if (align.waypoints.empty()) return {};
  return ScriptWriter(object, align, limits).Write();
}

}  // namespace regrasp
