#include "planner/tree/transition.h"

#include <algorithm>

namespace regrasp::tree {

namespace {

/// Factor by which a move must reduce the required friction angle above its useful minimum; smaller
/// gains are not worth a test.
constexpr double kWorthwhile = 0.98;

/// Initial size of moves over the diameter. It grows after a move that was kept, and shrinks after
/// one that was not.
constexpr double kFirstReach = 0.3;
constexpr double kFarther = 1.5;
constexpr double kNearer = 0.85;
constexpr double kLeastReach = 1e-3;

/// Number of bisection steps for a lower level after a move.
constexpr int kTransitionHalvings = 4;

/// Largest initial required friction angle of the later grasp, radians.
constexpr double kHighest = 1.2;

class Descent {
 public:
  Descent(const grasp::Grasp& before, int leaving, const grasp::Contact& placed,
          const sampling::SurfaceSampler& source, RandomStream& random, SearchSpace& space)
      : leaving_(leaving),
        source_(source),
        random_(random),
        space_(space),
        held_(before),
        placed_(placed),
        path_{before},
        lowest_(space.criteria().AsksMore() ? 0 : space.friction_angle()) {}

  std::optional<Transition> Find() {
    if (!space_.HoldsAt(After(held_, placed_), kHighest)) return std::nullopt;
    level_ = kHighest;
    Lower(held_, placed_);
    double reach = kFirstReach;
    while (reach > kLeastReach && !space_.IsSpent()) {
      if (level_ <= space_.friction_angle()) {
        if (auto found = Finish()) return found;
      }
      reach *= Move(reach * space_.object().diameter()) ? kFarther : kNearer;
      reach = std::min(reach, kFirstReach);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] grasp::Grasp After(const grasp::Grasp& held, const grasp::Contact& placed) const {
    grasp::Grasp after = held;
    after[leaving_] = placed;
    return after;
  }

  bool Move(double reach) {
    grasp::Grasp held;
    for (const grasp::Contact& contact : held_)
      held.push_back(source_.DrawNear(contact, reach, random_));
    const grasp::Contact placed = source_.DrawNear(placed_, reach, random_);
    const double aim = lowest_ + kWorthwhile * (level_ - lowest_);
    if (!space_.HoldsAt(After(held, placed), aim) || !space_.IsAdmitted(held)) return false;
    const auto is_valid = [this](const grasp::Contact& contact) {
      return source_.IsValid(contact);
    };
    if (!is_valid(placed) || !std::ranges::all_of(held, is_valid)) return false;
    level_ = aim;
    Lower(held, placed);
    held_ = held;
    placed_ = placed;
    path_.push_back(held);
    return true;
  }

  /// Lower the level to approximately the required friction angle of the later grasp.
  void Lower(const grasp::Grasp& held, const grasp::Contact& placed) {
    const grasp::Grasp after = After(held, placed);
    double below = lowest_;
    if (below > 0 && space_.HoldsAt(after, below)) {
      level_ = below;
      return;
    }
    for (int i = 0; i < kTransitionHalvings; ++i) {
      const double middle = (below + level_) / 2;
      (space_.HoldsAt(after, middle) ? level_ : below) = middle;
    }
  }

  std::optional<Transition> Finish() {
    const grasp::Grasp after = After(held_, placed_);
    const bool together = std::all_of(
        held_.begin(), held_.end(),
        [&](const grasp::Contact& contact) { return space_.CanMeet(contact, placed_); });
    if (!together || !space_.IsAdmitted(after)) return std::nullopt;
    return Transition{path_, after};
  }

  int leaving_;
  const sampling::SurfaceSampler& source_;
  RandomStream& random_;
  SearchSpace& space_;
  grasp::Grasp held_;
  grasp::Contact placed_;
  std::vector<grasp::Grasp> path_;
  /// Lower bound on the level. Levels below the space's friction angle help only if more than force
  /// closure is required.
  double lowest_;
  double level_ = 0;
};

}  // namespace

std::optional<Transition> FindTransition(const grasp::Grasp& before, int leaving,
                                         const grasp::Contact& placed,
                                         const sampling::SurfaceSampler& source,
                                         RandomStream& random, SearchSpace& space) {
  return Descent(before, leaving, placed, source, random, space).Find();
}

}  // namespace regrasp::tree
