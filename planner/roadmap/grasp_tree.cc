#include "planner/roadmap/grasp_tree.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace regrasp::roadmap {

GraspOracle::GraspOracle(const object::Object& object, std::span<const grasp::Contact> contacts,
                         const criteria::GraspCriteria& criteria, const hand::Hand& hand,
                         Deadline deadline)
    : GraspMemory(object, criteria, hand), deadline_(std::move(deadline)) {
  Append(contacts);
}

bool GraspOracle::Admits(const Quadruple& ascending) {
  deadline_.Check();
  // Two fingers cannot hold one contact.
  if (std::ranges::adjacent_find(ascending) != ascending.end()) return false;
  criteria::ContactSet set;
  for (const int contact : ascending) set.Insert(contact);
  return GraspMemory::Admits(set);
}

namespace {

/// Replace one contact of a grasp; nullopt if the grasp has the new contact already.
std::optional<Quadruple> Replaced(Quadruple grasp, int slot, int contact) {
  if (std::find(grasp.begin(), grasp.end(), contact) != grasp.end()) return std::nullopt;
  grasp[slot] = contact;
  std::sort(grasp.begin(), grasp.end());
  return grasp;
}

/// Return the remoteness of all contacts that a tree can reach: the distance to the nearest contact
/// of a grasp.
std::vector<double> RemotenessFrom(const Quadruple& grasp, const Quadruple& root,
                                   const Replacements& replacements,
                                   const std::function<double(int, int)>& distance) {
  std::vector<double> remoteness(replacements.list_of.size(), 0);
  const auto set = [&](int contact) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int other : grasp) nearest = std::min(nearest, distance(contact, other));
    remoteness[contact] = nearest;
  };
  for (const std::vector<int>& list : replacements.lists)
    std::for_each(list.begin(), list.end(), set);
  std::for_each(root.begin(), root.end(), set);
  return remoteness;
}

}  // namespace

Replacements Replacements::AnyOf(std::vector<int> contacts, int count) {
  return {{std::move(contacts)}, std::vector<int>(count, 0), {}};
}

bool GraspTree::QueueEntry::operator<(const QueueEntry& other) const {
  // The greatest entry is on top of the queue: the least remote one, then the earliest.
  return std::tie(other.remoteness, other.from, other.slot, other.position) <
         std::tie(remoteness, from, slot, position);
}

GraspTree::GraspTree(const Quadruple& root, Replacements replacements,
                     std::vector<double> remoteness, GraspOracle& oracle)
    : replacements_(std::move(replacements)), remoteness_(std::move(remoteness)), oracle_(oracle) {
  for (std::vector<int>& list : replacements_.lists) {
    std::stable_sort(list.begin(), list.end(),
                     [&](int a, int b) { return remoteness_[a] < remoteness_[b]; });
  }
  Reach(root, -1);
}

void GraspTree::Reach(const Quadruple& grasp, int parent) {
  const int number = static_cast<int>(reached_.size());
  reached_.push_back({grasp, parent});
  numbers_.emplace(GraspKey(grasp), number);
  for (int slot = 0; slot < 4; ++slot) Push(number, slot, 0);
}

void GraspTree::Push(int from, int slot, int position) {
  const Quadruple& grasp = reached_[from].grasp;
  const std::vector<int>& list = replacements_.lists[replacements_.list_of[grasp[slot]]];
  if (position == static_cast<int>(list.size())) return;
  double remoteness = remoteness_[list[position]];
  for (int other = 0; other < 4; ++other) {
    if (other != slot) remoteness += remoteness_[grasp[other]];
  }
  queue_.push({remoteness, from, slot, position});
}

bool GraspTree::Step() {
  assert(!exhausted());
  const QueueEntry entry = queue_.top();
  queue_.pop();
  const Quadruple from = reached_[entry.from].grasp;
  const int contact = replacements_.lists[replacements_.list_of[from[entry.slot]]][entry.position];
  Push(entry.from, entry.slot, entry.position + 1);
  const std::optional<Quadruple> grasp = Replaced(from, entry.slot, contact);
  if (!grasp || Has(*grasp) || !oracle_.CanMeet(from[entry.slot], contact)) return false;
  if (replacements_.allows && !replacements_.allows(*grasp)) return false;
  if (!oracle_.Admits(*grasp)) return false;
  Reach(*grasp, entry.from);
  return true;
}

std::vector<Quadruple> GraspTree::PathTo(const Quadruple& grasp) const {
  std::vector<Quadruple> path;
  for (int i = numbers_.at(GraspKey(grasp)); i >= 0; i = reached_[i].parent) {
    path.push_back(reached_[i].grasp);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

Junction JoinGrasps(const Quadruple& from, const Quadruple& to, const Replacements& replacements,
                    const std::function<double(int, int)>& distance, std::int64_t most_steps,
                    GraspOracle& oracle) {
  if (from == to) return {{from}, false, 1, 1};
  std::array trees = {
      GraspTree(from, replacements, RemotenessFrom(to, from, replacements, distance), oracle),
      GraspTree(to, replacements, RemotenessFrom(from, to, replacements, distance), oracle)};
  Junction junction;
  int turn = 0;
  for (std::int64_t step = 0; step < most_steps; ++step, turn = 1 - turn) {
    if (trees[turn].exhausted()) break;
    if (!trees[turn].Step() || !trees[1 - turn].Has(trees[turn].last())) continue;
    const Quadruple meeting = trees[turn].last();
    junction.path = trees[0].PathTo(meeting);
    const std::vector<Quadruple> rest = trees[1].PathTo(meeting);
    junction.path.insert(junction.path.end(), rest.rbegin() + 1, rest.rend());
    break;
  }
  junction.exhausted = trees[0].exhausted() || trees[1].exhausted();
  junction.from_size = trees[0].size();
  junction.to_size = trees[1].size();
  return junction;
}

}  // namespace regrasp::roadmap
