#include "sim/actuation/draw_reset_states.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "planner/base/binomial.h"
#include "planner/base/in_blocks.h"
#include "planner/plan/reason.h"
#include "sim/replay/trials.h"
#include "sim/scene/engine_hooks.h"

namespace regrasp::sim {
namespace {

/// What one thread works with.
struct Worker {
  ResetStates states;
  DrawRest draw;
};

/// Hands each thread a worker that no other one has.
class Workers {
 public:
  void Put(std::unique_ptr<Worker> worker) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(worker));
  }
  std::unique_ptr<Worker> Take() {
    const std::scoped_lock lock(mutex_);
    auto worker = std::move(idle_.back());
    idle_.pop_back();
    return worker;
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> idle_;
};

/// A state, and the rests that were drawn for it before.
struct Found {
  ResetState state;
  std::map<plan::Reason, std::int64_t> fallen;
  std::int64_t unbalanced = 0;
};

/// No state was found; nothing more is to be done.
struct NoState {
  std::string message;
};

std::string CountText(const Found& tried) {
  std::string text = std::to_string(tried.unbalanced) +
                     " have no contact forces that the fingers give and that carry the weight";
  for (const auto& [reason, count] : tried.fallen) {
    text += ", " + std::to_string(count) + " " + std::string(plan::ReasonName(reason));
  }
  return text;
}

Found FindState(RandomStream random, int most_tried, Worker& worker) {
  Found found;
  for (int i = 0; i < most_tried; ++i) {
    const auto rest = worker.draw(random);
    if (!rest) throw NoState{"no random grasp that the hand reaches holds the object"};
    const auto squeeze = worker.states.SqueezeOf(rest->state, rest->grasp);
    if (!squeeze) {
      ++found.unbalanced;
      continue;
    }
    auto made = worker.states.Make(rest->state, rest->grasp, *squeeze);
    if (auto* state = std::get_if<ResetState>(&made)) {
      found.state = std::move(*state);
      return found;
    }
    ++found.fallen[std::get<plan::Reason>(made)];
  }
  throw NoState{"of " + std::to_string(most_tried) +
                " random grasps that the hand reaches it holds none: " + CountText(found)};
}

DrawnStates Collect(std::vector<Found> found, const HandWorld& world) {
  DrawnStates drawn;
  drawn.joint_names = world.joint_names();
  drawn.control_names = world.control_names();
  drawn.timestep_s = world.timestep();
  for (Found& one : found) {
    drawn.states.push_back(std::move(one.state));
    drawn.unbalanced += one.unbalanced;
    for (const auto& [reason, count] : one.fallen) drawn.fallen[reason] += count;
  }
  return drawn;
}

}  // namespace

std::int64_t DrawnStates::fallen_count() const {
  std::int64_t count = 0;
  for (const auto& [reason, times] : fallen) count += times;
  return count;
}

double DrawnStates::fallen_share() const {
  const auto fell = static_cast<double>(fallen_count());
  return fell / std::max(1.0, fell + static_cast<double>(states.size()));
}

ShareInterval DrawnStates::interval() const {
  const auto fell = static_cast<int>(fallen_count());
  return ComputeShareInterval(fell, fell + static_cast<int>(states.size()), kTrialConfidence);
}

DrawnStates DrawResetStates(const kinematics::HandFile& file, const object::Polyhedron& solid,
                            double scale, const ResetStateOptions& states,
                            const DrawnStatesOptions& options,
                            const std::function<DrawRest()>& make_draw) {
  const EngineHooks hooks;  // what others put back is in no order
  Workers workers;
  for (int i = 0; i < std::min(options.jobs, options.count); ++i) {
    workers.Put(std::unique_ptr<Worker>(new Worker{{file, solid, scale, states}, make_draw()}));
  }
  std::vector<Found> found(options.count);
  std::mutex telling;
  int done = 0;
  try {
    InBlocks(found.size(), 1, options.jobs, [&](std::size_t begin, std::size_t /*end*/) {
      auto worker = workers.Take();
      found[begin] = FindState(RandomStream(options.seed, RandomUse::kResetStates, begin),
                               options.most_tried, *worker);
      workers.Put(std::move(worker));
      const std::scoped_lock lock(telling);
      ++done;
      if (options.told) options.told(done);
    });
  } catch (const NoState& none) {
    DrawnStates nothing;
    nothing.message = none.message;
    return nothing;
  }
  return Collect(std::move(found), workers.Take()->states.world());
}

}  // namespace regrasp::sim
