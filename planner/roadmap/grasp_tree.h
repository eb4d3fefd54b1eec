#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {

/// One number for a grasp of four contact points, smaller than 2¹⁶ each.
[[nodiscard]] constexpr std::uint64_t GraspKey(const Quadruple& ascending) {
  std::uint64_t key = 0;
  for (const int contact : ascending) key = key << 16 | static_cast<std::uint64_t>(contact);
  return key;
}

/// Says whether a sequence may pass a grasp of four contact points: a GraspMemory that is asked by
/// quadruples, and that makes an end in time.
class GraspOracle : public criteria::GraspMemory {
 public:
  /// @param object    outlives this object.
  /// @param contacts  at most ContactSet::kMostNumbers.
  /// @throws std::invalid_argument  there are more contacts.
  GraspOracle(const object::Object& object, std::span<const grasp::Contact> contacts,
              const criteria::GraspCriteria& criteria, const hand::Hand& hand = {},
              Deadline deadline = {});

  /// @throws TimeUp  the deadline came.
  [[nodiscard]] bool Admits(const Quadruple& ascending);

 private:
  Deadline deadline_;
};

/// Which contacts may take the place of which.
struct Replacements {
  std::vector<std::vector<int>> lists;
  std::vector<int> list_of;  ///< by contact: which list may replace it
  /// Grasps that this may lead to; empty: all.
  std::function<bool(const Quadruple&)> allows = {};

  /// Any of `contacts` for any of `count` contacts.
  [[nodiscard]] static Replacements AnyOf(std::vector<int> contacts, int count);
};

/// The grasps that finger switches reach from one grasp, best first, each tested when its turn
/// comes and not before.
///
/// A grasp is the better, the less remote its contacts are in sum. As the sum is over contacts, the
/// neighbours of a grasp come in order by themselves when every list of replacements is in order of
/// remoteness: a grasp in the tree keeps four places in the lists, and not thousands of neighbours
/// in a queue.
class GraspTree {
 public:
  /// @param oracle      outlives this object. `root` is taken as it is.
  /// @param remoteness  by contact, >= 0.
  GraspTree(const Quadruple& root, Replacements replacements, std::vector<double> remoteness,
            GraspOracle& oracle);

  /// Tests the next grasp. @returns whether it was one to reach; then last() is it.
  bool Step();
  [[nodiscard]] bool exhausted() const { return queue_.empty(); }

  [[nodiscard]] const Quadruple& last() const { return reached_.back().grasp; }
  [[nodiscard]] bool Has(const Quadruple& grasp) const {
    return numbers_.contains(GraspKey(grasp));
  }
  /// Grasps reached, the root included.
  [[nodiscard]] std::size_t size() const { return reached_.size(); }

  /// From the root to a reached grasp, both included.
  [[nodiscard]] std::vector<Quadruple> PathTo(const Quadruple& grasp) const;

 private:
  struct Reached {
    Quadruple grasp;
    int parent;
  };
  /// The next replacement of one contact of a reached grasp.
  struct QueueEntry {
    double remoteness;  ///< of the grasp that would be
    int from;
    int slot;
    int position;  ///< in the list
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

/// How two grasps are joined, or why not.
struct Junction {
  std::vector<Quadruple> path;  ///< empty where there is none
  bool exhausted = false;       ///< there is none: all that one side reaches was seen
  std::size_t from_size = 0;    ///< grasps that were reached from either side
  std::size_t to_size = 0;
};

/// Joins two grasps by a tree from each, grown in turn, each towards the other's root: a best-first
/// search from both ends (Pohl 1971).
/// @param distance    between two contacts, >= 0.
/// @param most_steps  replacements looked at before it gives up.
[[nodiscard]] Junction JoinGrasps(const Quadruple& from, const Quadruple& to,
                                  const Replacements& replacements,
                                  const std::function<double(int, int)>& distance,
                                  std::int64_t most_steps, GraspOracle& oracle);

}  // namespace regrasp::roadmap
