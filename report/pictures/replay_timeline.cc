#include "report/pictures/replay_timeline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "planner/base/number.h"
#include "planner/object/rotation.h"

namespace regrasp::report {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using render::ViewerContact;
using render::ViewerContactState;
using render::ViewerSample;

// Durations of the phases of an entry without a hand, seconds, and samples per second.
constexpr double kTravelTime = 1.4, kHandOverTime = 0.8, kSlideTime = 1.4, kLeaveTime = 0.6;
constexpr double kPauseTime = 0.5;
constexpr double kSampleRate = 20;
/// Share of the travel in which the finger approaches along the normal.
constexpr double kApproachShare = 0.35;
/// Distance of a finger in the air from its contact, and least distance from the centroid in
/// between, in object diameters.
constexpr double kHoverHeight = 0.3, kTravelRadius = 0.75;

/// Time between two planned states, and the pause after an entry that was not recorded, seconds.
constexpr double kPlannedInterval = 0.04, kPlannedPause = 0.4;

bool Holds(const ViewerContact& contact) { return contact.state == ViewerContactState::kHolding; }

bool IsInContact(const plan::FingerState& finger) {
  return finger.role != plan::FingerRole::kFree && finger.role != plan::FingerRole::kReleased;
}

const plan::FingerState* Find(const std::vector<plan::FingerState>& states, FingerIndex finger) {
  const auto found = std::ranges::find(states, finger, &plan::FingerState::finger);
  return found == states.end() || !IsInContact(*found) ? nullptr : &*found;
}

std::vector<ViewerContact> ContactsIn(const std::vector<plan::FingerState>& states,
                                      const std::vector<FingerIndex>& fingers) {
  std::vector<ViewerContact> contacts;
  for (const FingerIndex finger : fingers) {
    ViewerContact& contact = contacts.emplace_back();
    const plan::FingerState* state = Find(states, finger);
    if (state == nullptr || !state->contact_W.allFinite() || !state->force_W.allFinite()) continue;
    contact = {ViewerContactState::kHolding, state->contact_W, state->normal_W.normalized(),
               state->force_W};
  }
  return contacts;
}

/// Return the contacts after a rigid motion.
std::vector<ViewerContact> Moved(const Isometry3d& motion, std::vector<ViewerContact> contacts) {
  for (ViewerContact& contact : contacts) {
    contact.point = motion * contact.point;
    contact.inward = motion.linear() * contact.inward;
    contact.force = motion.linear() * contact.force;
  }
  return contacts;
}

double Smooth(double share) { return share * share * (3 - 2 * share); }

Vector3d Between(const Vector3d& a, const Vector3d& b, double share) {
  return (1 - share) * a + share * b;
}

Vector3d DirectionBetween(const Vector3d& a, const Vector3d& b, double share) {
  const auto turn = Eigen::Quaterniond::FromTwoVectors(a, b);
  return Eigen::Quaterniond::Identity().slerp(share, turn) * a;
}

/// Return the point of a path at a share of its length.
Vector3d Along(const std::vector<Vector3d>& path, double share) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  double left = share * length;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double leg = (path[i] - path[i - 1]).norm();
    if (left <= leg && leg > 0) return Between(path[i - 1], path[i], left / leg);
    left -= leg;
  }
  return path.back();
}

/// Builds the samples of a plan without a hand, phase by phase.
class PointTimeline {
 public:
  PointTimeline(const std::vector<FingerIndex>& fingers, const Vector3d& centroid_m,
                double diameter_m)
      : fingers_(fingers), centroid_m_(centroid_m), diameter_m_(diameter_m) {
    now_.contacts.resize(fingers.size());
  }

  void AddEntry(const plan::Snapshot& snapshot) {
    const std::vector<ViewerContact> after = ContactsIn(snapshot.fingers, fingers_);
    if (timeline_.samples.empty()) now_.X_WO = snapshot.X_WO;
    Travel(after);
    HandOver(snapshot, after);
    Leave(after);
    Add(kPauseTime);
    timeline_.ends.push_back(now_.time_s);
  }

  [[nodiscard]] ReplayTimeline Take() { return std::move(timeline_); }

 private:
  /// Add the present state, `seconds` after the last sample.
  void Add(double seconds) {
    if (!timeline_.samples.empty()) now_.time_s += seconds;
    timeline_.samples.push_back(now_);
  }

  template <typename Set>
  void Run(double seconds, const Set& set) {
    const int count = static_cast<int>(std::ceil(seconds * kSampleRate));
    for (int i = 1; i <= count; ++i) {
      set(static_cast<double>(i) / count);
      Add(seconds / count);
    }
  }

  [[nodiscard]] Vector3d Hover(const ViewerContact& contact) const {
    return contact.point - kHoverHeight * diameter_m_ * contact.inward;
  }

  /// Move fingers in the air to above their contacts, and along the normals to them.
  void Travel(const std::vector<ViewerContact>& after) {
    std::vector<std::size_t> placed;
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (!Holds(after[i]) || Holds(now_.contacts[i])) continue;
      placed.push_back(i);
      ViewerContact& contact = now_.contacts[i];
      if (contact.state == ViewerContactState::kHidden) {
        contact = {ViewerContactState::kFree, Hover(after[i]), after[i].inward, Vector3d::Zero()};
      }
    }
    if (timeline_.samples.empty()) Add(0);
    if (placed.empty()) return;
    const std::vector<ViewerContact> before = now_.contacts;
    Run(kTravelTime, [&](double share) {
      for (const std::size_t i : placed) now_.contacts[i] = InTheAir(before[i], after[i], share);
    });
  }

  [[nodiscard]] ViewerContact InTheAir(const ViewerContact& from, const ViewerContact& to,
                                       double share) const {
    const Vector3d above = Hover(to);
    if (share > 1 - kApproachShare) {
      const double near = Smooth((share - 1 + kApproachShare) / kApproachShare);
      return {ViewerContactState::kFree, Between(above, to.point, near), to.inward,
              Vector3d::Zero()};
    }
    const double along = Smooth(share / (1 - kApproachShare));
    const Vector3d centre = now_.X_WO * centroid_m_;
    const Vector3d a = from.point - centre;
    const Vector3d b = above - centre;
    ViewerContact contact{ViewerContactState::kFree, Between(from.point, above, along),
                          DirectionBetween(from.inward, to.inward, along), Vector3d::Zero()};
    if (a.norm() > 0 && b.norm() > 0) {
      const double turn = std::atan2(a.cross(b).norm(), a.dot(b));
      const double outside = kTravelRadius * diameter_m_ * std::min(1.0, turn);
      const double bulge = 4 * along * (1 - along);
      const double radius = (1 - along) * a.norm() + along * b.norm();
      contact.point = centre + DirectionBetween(a, b, along).normalized() *
                                   std::max(radius, radius + bulge * (outside - radius));
    }
    return contact;
  }

  void HandOver(const plan::Snapshot& snapshot, const std::vector<ViewerContact>& after) {
    const ViewerSample before = now_;
    const bool slides = std::ranges::any_of(
        snapshot.fingers, [](const plan::FingerState& state) { return state.path_W.size() > 1; });
    Run(slides ? kSlideTime : kHandOverTime, [&](double share) {
      const double s = Smooth(share);
      now_.X_WO = object::PoseBetween(before.X_WO, snapshot.X_WO, s);
      for (std::size_t i = 0; i < after.size(); ++i) {
        const ViewerContact& from = before.contacts[i];
        ViewerContact& contact = now_.contacts[i];
        if (Holds(after[i])) {
          const plan::FingerState* state = Find(snapshot.fingers, fingers_[i]);
          const bool on_path = state->path_W.size() > 1;
          contact = {ViewerContactState::kHolding,
                     on_path ? Along(state->path_W, s) : Between(from.point, after[i].point, s),
                     DirectionBetween(from.inward, after[i].inward, s),
                     Between(from.force, after[i].force, s)};
        } else if (Holds(from)) {
          contact.force = (1 - s) * from.force;
        }
      }
    });
  }

  void Leave(const std::vector<ViewerContact>& after) {
    std::vector<std::size_t> released;
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (Holds(now_.contacts[i]) && !Holds(after[i])) released.push_back(i);
    }
    if (released.empty()) return;
    const std::vector<ViewerContact> before = now_.contacts;
    Run(kLeaveTime, [&](double share) {
      for (const std::size_t i : released) {
        now_.contacts[i] = {ViewerContactState::kFree,
                            Between(before[i].point, Hover(before[i]), Smooth(share)),
                            before[i].inward, Vector3d::Zero()};
      }
    });
  }

  const std::vector<FingerIndex>& fingers_;
  Vector3d centroid_m_;
  double diameter_m_;
  ViewerSample now_;
  ReplayTimeline timeline_;
};

/// Builds the samples of a plan for a hand, entry by entry.
class HandTimeline {
 public:
  HandTimeline(const std::vector<FingerIndex>& fingers, const HandPicture& hand)
      : fingers_(fingers), hand_(hand) {}

  void AddRecorded(std::span<const HandSample> samples) {
    for (const HandSample& sample : samples) {
      if (!start_s_) start_s_ = sample.time_s;
      const double time_s = std::max(now_s_, sample.time_s - *start_s_);
      Add(time_s, sample.state, Moved(hand_.X_WP(), ContactsIn(sample.fingers, fingers_)));
    }
    timeline_.ends.push_back(now_s_);
    last_ = samples.back().state;
  }

  /// @param before, after  placed snapshots of the static grasps; `after` can be that of a failure.
  void AddPlanned(const ShownEntry& entry, const plan::Snapshot& before,
                  const plan::Snapshot& after) {
    const std::vector<plan::HandState> states = StatesUpTo(entry);
    const auto in_object = [&](const plan::Snapshot& snapshot) {
      return Moved(snapshot.X_WO.inverse(), ContactsIn(snapshot.fingers, fingers_));
    };
    const std::vector<ViewerContact> from = in_object(before);
    const std::vector<ViewerContact> to = in_object(after);
    for (std::size_t k = 0; k < states.size(); ++k) {
      const double share = states.size() < 2 ? 1 : static_cast<double>(k) / (states.size() - 1);
      std::vector<ViewerContact> contacts = share < 0.5 ? from : to;
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (!Holds(from[i]) || !Holds(to[i])) continue;
        contacts[i].point = Between(from[i].point, to[i].point, share);
        contacts[i].inward = DirectionBetween(from[i].inward, to[i].inward, share);
      }
      const Isometry3d pose = hand_.X_WP() * states[k].pose;
      Add(now_s_ + (timeline_.samples.empty() ? 0 : kPlannedInterval), states[k],
          Moved(pose, contacts));
    }
    timeline_.samples.push_back(timeline_.samples.back());
    now_s_ += kPlannedPause;
    timeline_.samples.back().time_s = now_s_;
    timeline_.ends.push_back(now_s_);
    last_ = states.back();
    start_s_.reset();
  }

  [[nodiscard]] ReplayTimeline Take() { return std::move(timeline_); }

 private:
  void Add(double time_s, const plan::HandState& state, std::vector<ViewerContact> contacts) {
    now_s_ = time_s;
    ViewerSample& sample = timeline_.samples.emplace_back();
    sample.time_s = time_s;
    sample.X_WO = hand_.X_WP() * state.pose;
    for (const std::vector<double>& finger : state.joints) {
      sample.joints.insert(sample.joints.end(), finger.begin(), finger.end());
    }
    sample.contacts = std::move(contacts);
  }

  /// Return the planned states of an entry, up to the failing instant if there is one.
  [[nodiscard]] std::vector<plan::HandState> StatesUpTo(const ShownEntry& entry) const {
    std::vector<plan::HandState> states = hand_.StatesAlong(entry.step->check.index);
    const plan::Fault& fault = entry.step->fault();
    if (!fault.hand || !hand_.Fits(fault.hand->state)) return states;
    const plan::HandState& failing = fault.hand->state;
    const auto nearest = std::ranges::min_element(states, {}, [&](const plan::HandState& state) {
      return HandPicture::Distance(state, failing);
    });
    states.erase(nearest, states.end());
    states.push_back(failing);
    return states;
  }

  const std::vector<FingerIndex>& fingers_;
  const HandPicture& hand_;
  double now_s_ = 0;
  std::optional<double> start_s_;
  plan::HandState last_;
  ReplayTimeline timeline_;
};

}  // namespace

std::vector<FingerIndex> FingersOf(const std::vector<ShownEntry>& entries) {
  std::set<FingerIndex> fingers;
  for (const ShownEntry& entry : entries) {
    for (const plan::FingerState& state : entry.snapshot.fingers) {
      if (static_cast<int>(fingers.size()) < plan::kMostDrawnFingers) fingers.insert(state.finger);
    }
  }
  return {fingers.begin(), fingers.end()};
}

ReplayTimeline MakeTimeline(const object::Object& object, const Report& report,
                            const std::vector<ShownEntry>& entries,
                            const std::vector<FingerIndex>& fingers, const HandPicture* hand,
                            const std::vector<HandSample>& samples) {
  if (hand != nullptr) return MakeHandTimeline(entries, fingers, *hand, samples);
  return MakePointTimeline(entries, fingers, report.scale * object.mass_properties().centroid,
                           report.scale * object.diameter());
}

ReplayTimeline MakePointTimeline(const std::vector<ShownEntry>& entries,
                                 const std::vector<FingerIndex>& fingers,
                                 const Vector3d& centroid_m, double diameter_m) {
  PointTimeline timeline(fingers, centroid_m, diameter_m);
  for (const ShownEntry& entry : entries) timeline.AddEntry(entry.snapshot);
  return timeline.Take();
}

ReplayTimeline MakeHandTimeline(const std::vector<ShownEntry>& entries,
                                const std::vector<FingerIndex>& fingers, const HandPicture& hand,
                                const std::vector<HandSample>& samples) {
  HandTimeline timeline(fingers, hand);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto recorded =
        std::ranges::equal_range(samples, entries[i].step->check.index, {}, &HandSample::entry);
    if (!recorded.empty()) {
      timeline.AddRecorded({recorded.begin(), recorded.end()});
    } else {
      timeline.AddPlanned(entries[i], entries[i == 0 ? 0 : i - 1].snapshot, entries[i].snapshot);
    }
  }
  ReplayTimeline made = timeline.Take();
  made.simulated_time = !samples.empty();
  return made;
}

}  // namespace regrasp::report
