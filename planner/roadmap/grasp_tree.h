#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {

/// Return a unique number of a grasp of four contact points below 2¹⁶.
[[nodiscard]] constexpr std::uint64_t GraspKey(const Quadruple& ascending) {
  std::uint64_t key = 0;
  for (const int contact : ascending) key = key << 16 | static_cast<std::uint64_t>(contact);
  return key;
}

/// Evaluator of grasps of four contact points: a GraspMemory for quadruples with a deadline.
class GraspOracle : public criteria::GraspMemory {
 public:
  /// @param object    grasped object; outlives this object.
  /// @param contacts  contact points, at most ContactSet::kMostNumbers.
  /// @throws std::invalid_argument  if there are more contacts.
  GraspOracle(const object::Object& object, std::span<const grasp::Contact> contacts,
              const criteria::GraspCriteria& criteria, const hand::Hand& hand = {},
              Deadline deadline = {});

  /// Return whether a sequence may contain a grasp.
  /// @throws TimeUp  if the deadline passes.
  [[nodiscard]] bool Admits(const Quadruple& ascending);

 private:
  Deadline deadline_;
};

/// Allowed replacements of contacts by other contacts.
struct Replacements {
  std::vector<std::vector<int>> lists;
  std::vector<int> list_of;  ///< index of the list of replacements, by contact
  /// Filter of the resulting grasps; empty: all.
  std::function<bool(const Quadruple&)> allows = {};

  /// Allow any of `contacts` as replacement of any of `count` contacts.
  [[nodiscard]] static Replacements AnyOf(std::vector<int> contacts, int count);
};

/// Tree of the grasps that finger switches reach from a root, best first. Each grasp is evaluated
/// only when it is its turn.
///
/// A grasp is better if the sum of its contacts' remoteness is smaller. Because the sum is over
/// contacts, neighbours of a grasp are generated in order if every list of replacements is sorted
/// by remoteness. A grasp in the tree therefore requires only four positions in the lists, instead
/// of thousands of neighbours in a queue.
class GraspTree {
 public:
  /// @param root        first grasp, which is not evaluated.
  /// @param remoteness  remoteness by contact, at least 0.
  /// @param oracle      evaluator; outlives this object.
  GraspTree(const Quadruple& root, Replacements replacements, std::vector<double> remoteness,
            GraspOracle& oracle);

  /// Evaluate the next grasp.
  /// @returns whether it is reached; if so, it is last().
  bool Step();
  [[nodiscard]] bool exhausted() const { return queue_.empty(); }

  [[nodiscard]] const Quadruple& last() const { return reached_.back().grasp; }
  [[nodiscard]] bool Has(const Quadruple& grasp) const {
    return numbers_.contains(GraspKey(grasp));
  }
  /// Return the number of reached grasps, the root included.
  [[nodiscard]] std::size_t size() const { return reached_.size(); }

  /// Return the path from the root to a reached grasp, both included.
  [[nodiscard]] std::vector<Quadruple> PathTo(const Quadruple& grasp) const;

 private:
  struct Reached {
    Quadruple grasp;
    int parent;
  };
  /// Next replacement of one contact of a reached grasp.
  struct QueueEntry {
    double remoteness;  ///< remoteness of the resulting grasp
    int from;
    int slot;
    int position;  ///< index in the list
    bool operator<(const QueueEntry& other) const;
  };

  void Reach(const Quadruple& grasp, int parent);
  void Push(int from, int slot, int position);

  Replacements replacements_;
  std::vector<double> remoteness_;
  GraspOracle& oracle_;
  std::vector<Reached> reached_;
  std::unordered_map<std::uint64_t, int> numbers_;
  std::priority_queue<QueueEntry> queue_;
};

/// Result of JoinGrasps.
struct Junction {
  std::vector<Quadruple> path;  ///< empty if none is found
  bool exhausted = false;  ///< whether one side was searched completely, so that there is no path
  std::size_t from_size = 0;  ///< number of reached grasps from `from`
  std::size_t to_size = 0;
};

/// Connect two grasps by trees that grow alternately, each towards the other root.
/// This is a bidirectional best-first search (Pohl 1971).
/// @param distance    distance between two contacts, at least 0.
/// @param most_steps  largest number of evaluated replacements.
[[nodiscard]] Junction JoinGrasps(const Quadruple& from, const Quadruple& to,
                                  const Replacements& replacements,
                                  const std::function<double(int, int)>& distance,
                                  std::int64_t most_steps, GraspOracle& oracle);

}  // namespace regrasp::roadmap
