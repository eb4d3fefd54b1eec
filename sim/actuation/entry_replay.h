#pragma once

#include <vector>

#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_judge.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// Carries out the entries of a plan with a hand, one after another, the hold first, each judged.
class EntryReplay {
 public:
  /// All but settings and options outlive this object.
  EntryReplay(HandWorld& world, const object::Polyhedron& solid, const plan::Plan& plan,
              const HandControlSettings& control, const HandReplayOptions& options,
              const HandReplayObserver& observer);

  /// Carries out an entry, the one before being done, comes to rest and shakes the object there.
  StepReplay Carry(plan::EntryIndex index);

  /// A rest after an entry that passed: all that what comes depends on.
  struct Rested {
    HandWorld::State world;
    HandControl control;
    HandJudge judge;
    plan::HandState state;
    std::vector<FingerIndex> holding;
  };
  /// After an entry that passed.
  [[nodiscard]] Rested rested() const { return {rest_, control_, judge_, state_, holding_}; }
  /// Of the same hand, object and settings, and of a plan with the same entries until then.
  void GoOnFrom(const Rested& rest);

 private:
  struct Coming;  ///< a finger on its way down to a contact

  void Perform(plan::EntryIndex index);
  void Describe(StepReplay& step) const;
  /// What is seen, in the object's frame: pictures put it where hand and object are.
  [[nodiscard]] plan::Snapshot SnapshotNow() const;
  void Tick();
  /// @param on_tick  told the share of the time that is over.
  template <typename OnTick>
  void Run(double seconds, const OnTick& on_tick);
  void TakeHold();
  void Move(const plan::HandPath& path);
  void Switch(const plan::Switch& change);
  void HandOver(const Hold& from, const Hold& to);
  void Align(const plan::Align& align);
  /// @param at    where fingers are that slide no more.
  /// @param hold  before, and then `to`.
  void ChangeSliding(const plan::FingerGrasp& at, Hold& hold, const Hold& to);
  /// Fingers slide from a waypoint to the next, those whose contacts differ.
  /// @param hold  as in ChangeSliding.
  void Slide(const plan::FingerGrasp& from, const plan::FingerGrasp& to, const plan::HandPath& path,
             Hold& hold);
  void PlaceFingers(const plan::Switch& change);
  void Descend(const plan::HandState& end, std::vector<Coming>& coming);
  void ReleaseFingers(const plan::Switch& change);
  void Rest();
  /// Pushes and turns the object in twelve directions, each from the same rest.
  void Shake();

  HandWorld& world_;
  const plan::Plan& plan_;
  double shake_;      ///< newtons
  double radius_;     ///< half the object's diameter, metres
  double start_off_;  ///< what the object's points are off at first, at most
  const HandReplayObserver& observer_;
  HandJudge judge_;
  HandControl control_;
  plan::HandState state_;             ///< planned now
  std::vector<FingerIndex> holding_;  ///< since the last rest
  HandWorld::State rest_;             ///< the last one
  bool shaking_ = false;
};

}  // namespace regrasp::sim
