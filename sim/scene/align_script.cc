#include "sim/scene/align_script.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/object/rotation.h"

namespace regrasp::sim {

namespace {

/// Return the fingers of `to` in the order of `from`.
plan::FingerGrasp InOrderOf(const plan::FingerGrasp& from, const plan::FingerGrasp& to) {
  plan::FingerGrasp ordered;
  for (const plan::FingerContact& held : from) {
    const plan::FingerContact* match = plan::FindFinger(to, held.finger);
    ordered.push_back(match == nullptr ? held : *match);
  }
  return ordered;
}

}  // namespace

plan::FingerGrasp Interpolate(const plan::FingerGrasp& from, const plan::FingerGrasp& to,
                              double share) {
  if (share >= 1) return to;
  plan::FingerGrasp between = to;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const grasp::Contact& a = from[i].contact;
    grasp::Contact& c = between[i].contact;
    c.p = (1 - share) * a.p + share * c.p;
    if (a.face == c.face) continue;
    const Eigen::Quaterniond turn = object::AligningRotation(a.n, c.n);
    c.n = (Eigen::Quaterniond::Identity().slerp(share, turn) * a.n).normalized();
    c.face = a.face;
  }
  return between;
}

AlignPath::AlignPath(const plan::Align& align) {
  assert(!align.waypoints.empty());
  for (const plan::FingerGrasp& waypoint : align.waypoints) {
    waypoints_.push_back(InOrderOf(align.waypoints.front(), waypoint));
  }
}

plan::FingerGrasp AlignPath::At(double t) const {
  const int from = std::clamp(static_cast<int>(std::floor(t)), 0, end());
  if (from == end()) return waypoints_.back();
  return Interpolate(waypoints_[from], waypoints_[from + 1], t - from);
}

double AlignPath::Travel(double from, double to) const {
  double travel = 0;
  while (from < to) {
    const double next = std::min(std::floor(from) + 1, to);
    const plan::FingerGrasp a = At(from), b = At(next);
    for (std::size_t k = 0; k < a.size(); ++k) {
      travel += (b[k].contact.p - a[k].contact.p).norm();
    }
    from = next;
  }
  return travel;
}

bool AlignPath::IsTurning(std::size_t k, double t) const {
  const int from = static_cast<int>(std::floor(t));
  if (from < 0 || from >= end() || t == from) return false;
  return waypoints_[from][k].contact.face != waypoints_[from + 1][k].contact.face;
}

namespace {

/// Distance over D within which contacts are equal, and the finger does not move.
constexpr double kSamePoint = 1e-9;

/// Positions of a support finger on its finger's path, in order of preference: the middle, far from
/// both ends, first; the target itself last.
constexpr std::array kSupportShares = {0.5, 0.375, 0.625, 0.25, 0.75, 0.125, 0.875, 1.0};

/// Shares of a segment that is valid only at full friction. The margin of an intermediate grasp
/// decreases about linearly with the length.
constexpr std::array kShorter = {0.5, 0.4, 0.6, 0.3, 0.7};

/// Number of bisections by which a segment is extended within the last share of the path.
constexpr int kRefinements = 4;

/// Number of points of a segment at which a sliding finger's clearance is tested.
constexpr int kAlignClearanceSamples = 4;

/// Requirements on a segment.
struct Demand {
  double friction_angle;
  double clearance;  ///< 0: none
  bool may_turn;     ///< whether fingers may stop between the normals of two faces
};

struct Segment {
  double end = 0;
  std::vector<AlignMove> moves;
  bool slides = false;
};

class ScriptWriter {
 public:
  ScriptWriter(const object::Object& object, const plan::Align& align, const AlignLimits& limits)
      : object_(object), limits_(limits), frame_(object.wrench_frame()), path_(align) {}

  AlignScript Write() {
    AlignScript script;
    double at = 0;
    while (at < path_.end()) {
      if (std::optional<Segment> segment = ChooseSegment(at)) {
        std::ranges::move(segment->moves, std::back_inserter(script.moves));
        (segment->slides ? script.shares.slid : script.shares.imitated) += Share(at, segment->end);
        at = segment->end;
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

  [[nodiscard]] bool Holds(const grasp::Grasp& grasp, double friction_angle) const {
    return grasp::IsForceClosure(grasp, frame_, friction_angle);
  }
  [[nodiscard]] bool HoldsAt(double t) const {
    return Holds(plan::ContactsOf(path_.At(t)), limits_.friction_angle);
  }

  /// Return the contacts that differ between two grasps of the path.
  [[nodiscard]] Places FindMoving(const plan::FingerGrasp& from,
                                  const plan::FingerGrasp& to) const {
    Places moving;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const grasp::Contact &a = from[k].contact, &b = to[k].contact;
      const bool stays = a.face == b.face && (a.p - b.p).norm() <= kSamePoint * object_.diameter();
      if (!stays) moving.push_back(k);
    }
    return moving;
  }

  [[nodiscard]] bool CanRest(const Places& places, double t, const Demand& demand) const {
    const plan::FingerGrasp grasp = path_.At(t);
    return std::ranges::all_of(places, [&](std::size_t k) {
      if (path_.IsTurning(k, t) && !demand.may_turn) return false;
      return demand.clearance == 0 ||
             criteria::ComputeClearance(object_, grasp[k].contact, demand.clearance) >=
                 demand.clearance;
    });
  }

  /// Hand the contacts of `group` in `grasp` over to their positions at `end`.
  [[nodiscard]] std::optional<FingerHandover> HandOver(double begin, double end,
                                                       const Places& group, const Demand& demand,
                                                       grasp::Grasp& grasp) const {
    const plan::FingerGrasp to = path_.At(end);
    grasp::Grasp after = grasp;
    for (const std::size_t k : group) after[k] = to[k].contact;
    if (!Holds(after, demand.friction_angle)) return std::nullopt;
    for (const double share : kSupportShares) {
      const double t = share < 1 ? begin + share * (end - begin) : end;
      const plan::FingerGrasp between = path_.At(t);
      grasp::Grasp meanwhile = grasp;
      for (const std::size_t k : group) meanwhile[k] = between[k].contact;
      if (!Holds(meanwhile, demand.friction_angle) || !CanRest(group, t, demand)) continue;
      FingerHandover move;
      for (std::size_t i = 0; i < group.size(); ++i) {
        move.support_fingers.push_back({limits_.spare[i], between[group[i]].contact});
        move.targets.push_back(to[group[i]]);
      }
      grasp = std::move(after);
      return move;
    }
    return std::nullopt;
  }

  /// Hand over all moving contacts in this order, as many at once as there are free fingers.
  [[nodiscard]] std::optional<std::vector<AlignMove>> HandOverInOrder(double begin, double end,
                                                                      const Places& order,
                                                                      const Demand& demand) const {
    std::vector<AlignMove> moves;
    grasp::Grasp grasp = plan::ContactsOf(path_.At(begin));
    for (std::size_t first = 0; first < order.size(); first += limits_.spare.size()) {
      const std::size_t last = std::min(first + limits_.spare.size(), order.size());
      const Places group(order.begin() + first, order.begin() + last);
      std::optional<FingerHandover> move = HandOver(begin, end, group, demand, grasp);
      if (!move) return std::nullopt;
      moves.emplace_back(*std::move(move));
    }
    return moves;
  }

  [[nodiscard]] std::optional<Segment> TrySegment(double begin, double end,
                                                  const Demand& demand) const {
    Places order = FindMoving(path_.At(begin), path_.At(end));
    std::optional<std::vector<AlignMove>> moves;
    for (std::size_t turn = 0; turn < std::max<std::size_t>(order.size(), 1) && !moves; ++turn) {
      moves = HandOverInOrder(begin, end, order, demand);
      if (!order.empty()) std::ranges::rotate(order, order.begin() + 1);
    }
    if (!moves || !CanRest(order, end, demand)) return std::nullopt;
    return Segment{end, *std::move(moves)};
  }

  /// Return how far the path from `begin` is force closure, in steps of a share of the path.
  [[nodiscard]] int FindReach(double begin) const {
    int reach = static_cast<int>(std::floor(begin * kSharesOfPath));
    while (reach < path_.end() * kSharesOfPath && HoldsAt(Place(reach + 1))) ++reach;
    return reach;
  }

  [[nodiscard]] static double Place(int steps) {
    return static_cast<double>(steps) / kSharesOfPath;
  }

  /// Return the longest valid segment from `begin` up to a number of steps.
  [[nodiscard]] std::optional<Segment> FindLongest(double begin, int reach,
                                                   const Demand& demand) const {
    const int first = static_cast<int>(std::floor(begin * kSharesOfPath)) + 1;
    for (int steps = reach; steps >= first; --steps) {
      std::optional<Segment> segment = TrySegment(begin, Place(steps), demand);
      if (!segment) continue;
      if (steps < reach) Lengthen(begin, Place(steps + 1), demand, *segment);
      return segment;
    }
    for (double end = (begin + Place(first)) / 2; end - begin >= kShortestAlignSegment;
         end = (begin + end) / 2) {
      if (std::optional<Segment> segment = TrySegment(begin, end, demand)) return segment;
    }
    return std::nullopt;
  }

  void Lengthen(double begin, double limit, const Demand& demand, Segment& segment) const {
    for (int i = 0; i < kRefinements; ++i) {
      const double end = (segment.end + limit) / 2;
      if (std::optional<Segment> longer = TrySegment(begin, end, demand)) {
        segment = *std::move(longer);
      } else {
        limit = end;
      }
    }
  }

  /// Return whether finger `k` may slide.
  /// The other contacts must hold the object without it, with a margin.
  [[nodiscard]] bool OthersHold(const grasp::Grasp& grasp, std::size_t k) const {
    grasp::Grasp others = grasp;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const double friction_angle = std::atan(kSlideFriction * std::tan(limits_.friction_angle));
    return grasp::QualityAtLeast(others, frame_, friction_angle, kSlideQuality);
  }

  /// Find an order in which the contacts `left` can slide to their positions in `to`.
  /// They start at `grasps.back()`. Appends the grasps in between.
  [[nodiscard]] bool OrderSlides(const plan::FingerGrasp& to, const Places& left,
                                 std::vector<plan::FingerGrasp>& grasps) const {
    if (left.empty()) return true;
    for (const std::size_t k : left) {
      if (!OthersHold(plan::ContactsOf(grasps.back()), k)) continue;
      Places rest = left;
      std::erase(rest, k);
      grasps.push_back(grasps.back());
      grasps.back()[k] = to[k];
      if (OrderSlides(to, rest, grasps)) return true;
      grasps.pop_back();
    }
    return false;
  }

  [[nodiscard]] bool HasClearance(const Places& moving, double begin, double end) const {
    for (int i = 1; i <= kAlignClearanceSamples; ++i) {
      const double t =
          i < kAlignClearanceSamples ? begin + (end - begin) * i / kAlignClearanceSamples : end;
      const bool rests = i == kAlignClearanceSamples;
      if (!CanRest(moving, t, {limits_.friction_angle, limits_.clearance, !rests})) return false;
    }
    return true;
  }

  [[nodiscard]] bool IsTurning(double t) const {
    for (std::size_t k = 0; k < path_.At(t).size(); ++k) {
      if (path_.IsTurning(k, t)) return true;
    }
    return false;
  }

  [[nodiscard]] std::optional<Segment> TrySlide(double begin, double end) const {
    if (IsTurning(begin) || IsTurning(end)) return std::nullopt;
    const plan::FingerGrasp to = path_.At(end);
    const Places moving = FindMoving(path_.At(begin), to);
    if (moving.empty() || !HasClearance(moving, begin, end)) return std::nullopt;
    FingersSlide slide{{path_.At(begin)}};
    if (!OrderSlides(to, moving, slide.grasps)) return std::nullopt;
    Segment segment{end, {}, true};
    segment.moves.emplace_back(std::move(slide));
    return segment;
  }

  /// Return the longest valid slide from `begin`.
  [[nodiscard]] std::optional<Segment> FindSlide(double begin, int reach) const {
    const int first = static_cast<int>(std::floor(begin * kSharesOfPath)) + 1;
    const int waypoint = (static_cast<int>(std::floor(begin)) + 1) * kSharesOfPath;
    for (int steps = std::min(reach, waypoint); steps >= first; --steps) {
      if (std::optional<Segment> segment = TrySlide(begin, Place(steps))) return segment;
    }
    return std::nullopt;
  }

  /// Return the first point after `begin` from which fingers can slide; `reach` if there is none.
  [[nodiscard]] int FindNextSlide(double begin, int reach) const {
    const int first = static_cast<int>(std::floor(begin * kSharesOfPath)) + 1;
    for (int steps = first; steps < reach; ++steps) {
      if (TrySlide(Place(steps), Place(steps + 1))) return steps;
    }
    return reach;
  }

  [[nodiscard]] std::optional<Segment> ChooseSegment(double begin) const {
    int reach = FindReach(begin);
    if (limits_.slide || limits_.spare.empty()) {
      if (std::optional<Segment> slide = FindSlide(begin, reach)) return slide;
    }
    if (limits_.spare.empty()) return std::nullopt;
    if (limits_.slide) reach = FindNextSlide(begin, reach);
    return ChooseHandover(begin, reach);
  }

  [[nodiscard]] std::optional<Segment> ChooseHandover(double begin, int reach) const {
    const double full = limits_.friction_angle;
    std::optional<Segment> longest = FindLongest(begin, reach, {full, limits_.clearance, false});
    if (longest) return MakeEasier(begin, reach, *std::move(longest));
    for (const Demand& demand : {Demand{full, limits_.least_clearance, false},
                                 {full, limits_.least_clearance, true},
                                 {full, 0, true}}) {
      longest = FindLongest(begin, reach, demand);
      if (longest) break;
    }
    return longest;
  }

  /// Return a shorter segment instead of the longest one.
  /// The intermediate grasps of the longest one may be at the limit.
  [[nodiscard]] Segment MakeEasier(double begin, int reach, Segment longest) const {
    const double length = longest.end - begin;
    for (const double share : kEasyFriction) {
      const double easy = std::atan(share * std::tan(limits_.friction_angle));
      std::optional<Segment> easier = FindLongest(begin, reach, {easy, limits_.clearance, false});
      if (easier && 2 * (easier->end - begin) >= length) return *std::move(easier);
    }
    for (const double share : kShorter) {
      if (share * length < kShortestAlignSegment) break;
      const Demand demand{limits_.friction_angle, limits_.clearance, false};
      std::optional<Segment> shorter = TrySegment(begin, begin + share * length, demand);
      if (shorter) return *std::move(shorter);
    }
    return longest;
  }

  [[nodiscard]] bool CanSlide(double begin, double end) const {
    const plan::FingerGrasp to = path_.At(end);
    grasp::Grasp grasp = plan::ContactsOf(path_.At(begin));
    return std::ranges::all_of(FindMoving(path_.At(begin), to), [&](std::size_t k) {
      grasp[k] = to[k].contact;
      return Holds(grasp, limits_.friction_angle);
    });
  }

  /// Divide the path into slides by bisection; a segment is as long as its predecessor allows.
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
        if (length < kShortestAlignSegment) return std::nullopt;
      }
    }
    return cuts;
  }

  void AddSlides(double begin, double end, AlignScript& script) const {
    std::optional<std::vector<double>> cuts = CutSlides(begin, end);
    if (!cuts) {
      cuts.emplace();
      for (int i = 1; i < kHopelessSegments; ++i) {
        cuts->push_back(begin + (end - begin) * i / kHopelessSegments);
      }
      cuts->push_back(end);
    }
    FingersSlide slide{{path_.At(begin)}};
    for (const double cut : *cuts) slide.grasps.push_back(path_.At(cut));
    script.moves.emplace_back(std::move(slide));
  }

  const object::Object& object_;
  const AlignLimits& limits_;
  object::WrenchFrame frame_;
  AlignPath path_;
};

}  // namespace

AlignScript WriteAlignScript(const object::Object& object, const plan::Align& align,
                             const AlignLimits& limits) {
  if (align.waypoints.empty()) return {};
  return ScriptWriter(object, align, limits).Write();
}

}  // namespace regrasp::sim
