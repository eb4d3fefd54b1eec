#pragma once

#include <functional>
#include <vector>

#include "sim/actuation/execution_monitor.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_engine.h"
#include "sim/actuation/hand_replay.h"

namespace regrasp::sim {

/// Callbacks during the execution of steps; all may be empty.
struct EntryObserver {
  /// Called after every time step, except in disturbance tests.
  std::function<void()> on_time_step = {};
  /// Called in the static grasp after every step, before its disturbance test.
  std::function<void(plan::EntryIndex)> on_rest = {};
};

/// Executes the steps of a plan with a hand in order, initial grasp first, and monitors each.
class EntryReplay {
 public:
  /// All arguments but settings, grasp forces, options and observer must outlive this object.
  /// @param grasp_forces  grasp force of the static grasp after each entry, newtons.
  EntryReplay(HandEngine& world, const object::Polyhedron& solid, const plan::Plan& plan,
              const HandControlSettings& control, std::vector<double> grasp_forces,
              const HandReplayOptions& options, EntryObserver observer);

  /// Execute the next step, wait for the static grasp, and disturb it.
  StepReplay Carry(plan::EntryIndex index);
  /// Return whether no further step can be executed.
  [[nodiscard]] bool has_ended() const { return has_ended_; }

  /// Complete state in the static grasp after a step that passed.
  struct Rested {
    HandEngine::State world;
    HandControl control;
    ExecutionMonitor monitor;
    plan::HandState state;
    std::vector<FingerIndex> holding;
  };
  /// Return the state after a step that passed.
  [[nodiscard]] Rested rested() const { return {rest_, control_, monitor_, state_, holding_}; }
  /// Continue from the state of a plan with the same steps, hand, object and settings.
  void GoOnFrom(const Rested& rest);

 private:
  struct Coming;  ///< a finger that approaches a contact

  void Perform(plan::EntryIndex index);
  /// Return the present holding fingers with a grasp force.
  [[nodiscard]] Hold HeldWith(double grasp_force) const { return {holding_, grasp_force}; }
  void Describe(StepReplay& step) const;
  /// Return the largest distance of a contact of the step's snapshot from its place in the plan.
  [[nodiscard]] double ContactDeviation(const StepReplay& step) const;
  /// Return the state in the object's frame, for images.
  [[nodiscard]] plan::Snapshot SnapshotNow() const;
  void Tick();
  /// End the step after a violation. With HandReplayOptions::to_end, end it if the object is lost.
  void EndIfFailed() const;
  /// @param on_tick  callback with the elapsed share of the time.
  template <typename OnTick>
  void Run(double seconds, const OnTick& on_tick);
  void TakeHold();
  void Move(const plan::HandPath& path);
  void Switch(const plan::Switch& change);
  void HandOver(const Hold& from, const Hold& to);
  void Align(const plan::Align& align);
  /// @param at    contacts of the fingers that stop.
  /// @param hold  present holding fingers; afterwards `to`.
  void ChangeSliding(const plan::FingerGrasp& at, Hold& hold, const Hold& to);
  /// Slide fingers from a waypoint to the next: those whose contacts differ.
  /// @param hold  as in ChangeSliding.
  void Slide(const plan::FingerGrasp& from, const plan::FingerGrasp& to, const plan::HandPath& path,
             Hold& hold);
  [[nodiscard]] std::vector<Coming> ComingTo(const plan::FingerGrasp& grasp) const;
  void PlaceFingers(const plan::Switch& change);
  void Descend(const plan::HandState& end, std::vector<Coming>& coming);
  void ReleaseFingers(const plan::Switch& change);
  void Rest();
  /// Keep all controls constant for a while, and return to the static grasp.
  void Freeze();
  /// Apply disturbances in twelve directions, each from the same static grasp.
  void ApplyDisturbances();

  HandEngine& world_;
  const plan::Plan& plan_;
  std::vector<double> grasp_forces_;  ///< grasp force of the static grasp after each entry, newtons
  double disturbance_ratio_;          ///< disturbance force over grasp force
  double freeze_s_;                   ///< HandReplayOptions::freeze_s
  double radius_;                     ///< half the object's diameter, metres
  double start_off_;                  ///< upper bound on the initial offset of the object's points
  EntryObserver observer_;
  ExecutionMonitor monitor_;
  HandControl control_;
  plan::HandState state_;             ///< present planned state
  double grasp_force_before_ = 0;     ///< grasp force before the present entry, newtons
  double grasp_force_ = 0;            ///< grasp force after it
  std::vector<FingerIndex> holding_;  ///< holding fingers of the last static grasp
  HandEngine::State rest_;            ///< last static grasp
  bool to_end_;
  bool has_ended_ = false;
  bool disturbing_ = false;
};

}  // namespace regrasp::sim
